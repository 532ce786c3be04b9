#include "sliding/sweep/border_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace mesoslip;

namespace
{
/** A map over pressure (logarithmic) and friction. */
SweepParameters map_over(const std::vector<double> &pressures,
                         const std::vector<double> &frictions)
{
  SweepParameters parameters;
  parameters.axes.resize(2);
  parameters.axes[0].name        = "pressure";
  parameters.axes[0].values      = pressures;
  parameters.axes[0].logarithmic = true;
  parameters.axes[1].name        = "friction";
  parameters.axes[1].values      = frictions;
  parameters.complex_modes       = true;
  return parameters;
}

using Growth = std::function<FastestGrowth(double pressure, double friction)>;

/** The border, after at most @p most trials of an edge. */
std::vector<BorderPoint> border_of(const SweepParameters &parameters,
                                   const Growth &growth,
                                   const unsigned int most)
{
  const auto of = [&](const std::vector<std::vector<double>> &points) {
    std::vector<FastestGrowth> found;
    for (const std::vector<double> &point : points)
      found.push_back(growth(point[0], point[1]));
    return found;
  };
  BorderSearch search(parameters, of(parameters.all_points()));
  unsigned int rounds = 0;
  for (auto wanted = search.wanted(); !wanted.empty(); wanted = search.wanted())
    {
      search.take(of(wanted));
      ++rounds;
    }
  EXPECT_LE(rounds, most);
  return search.border();
}
} // namespace

TEST(BorderSearch, FindsTheBorderBehindAKinkWithFewTrials)
{
  // The fastest mode below the border is another one, which hardly changes.
  const double begins = 0.0987654;
  const auto growth   = [&](double, const double friction) {
    return FastestGrowth(
        std::max(-136., 1e4 * (friction - begins) + 2e3 * std::pow(friction - begins, 2)));
  };
  for (const double tolerance : {1e-2, 1e-4})
    {
      SweepParameters parameters  = map_over({1e6, 2e6}, {0.05, 0.4});
      parameters.border_tolerance = tolerance;
      const auto border           = border_of(parameters, growth, 8);
      ASSERT_EQ(border.size(), 2u);
      for (const BorderPoint &point : border)
        {
          EXPECT_EQ(point.axis, 1u);
          EXPECT_NEAR(point.values[1] / begins, 1., tolerance);
        }
      EXPECT_EQ(border[0].values[0], 1e6);
      EXPECT_EQ(border[1].values[0], 2e6);
    }
}

TEST(BorderSearch, FollowsACurveAlongBothAxes)
{
  // Grows where p mu^2 > 4e4 Pa; modes that decay are not found.
  const auto growth = [](const double pressure, const double friction) {
    const double excess = pressure * friction * friction - 4e4;
    return FastestGrowth(excess > 0. ? 0.1 * excess
                                     : -std::numeric_limits<double>::infinity());
  };
  const auto border = border_of(map_over({1e5, 1e6, 1e7}, {0.1, 0.25, 0.5}), growth, 12);
  // Between 0.1 and 0.25 and so on of 1e6 and 1e7 Pa, and along the pressure.
  ASSERT_EQ(border.size(), 4u);
  for (const BorderPoint &point : border)
    {
      const double friction = std::sqrt(4e4 / point.values[0]),
                   pressure = 4e4 / (point.values[1] * point.values[1]);
      EXPECT_NEAR(point.axis == 1 ? point.values[1] / friction
                                  : point.values[0] / pressure,
                  1., 1e-2);
    }
}

TEST(BorderSearch, EndsAtABorderOfZero)
{
  // Without damping every friction makes a mode grow.
  const auto growth = [](double, const double friction) {
    return FastestGrowth(friction > 0. ? 1e4 * friction : -1e-9);
  };
  const auto border = border_of(map_over({1e6}, {0., 0.05}), growth, 20);
  ASSERT_EQ(border.size(), 1u);
  EXPECT_NEAR(border[0].values[1], 0., 0.05 * 1e-4);
}

TEST(BorderSearch, GivesUpWhereModesMayBeMissing)
{
  const auto unknown = [](double, const double friction) {
    return friction > 0.1 && friction < 0.4 ? FastestGrowth()
                                            : FastestGrowth(friction - 0.2);
  };
  EXPECT_TRUE(border_of(map_over({1e6, 2e6}, {0.05, 0.4}), unknown, 1).empty());
  const auto everywhere = [](double, double) { return FastestGrowth(1.); };
  EXPECT_TRUE(border_of(map_over({1e6, 2e6}, {0.05, 0.4}), everywhere, 0).empty());
}
