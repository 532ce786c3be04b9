#include "homogenization/loads/load_statistics.h"
#include "homogenization/loads/local_fields.h"
#include "homogenization/loads/mixed_load.h"
#include "material/stiffness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace mesoslip;

namespace
{
constexpr double none = std::numeric_limits<double>::quiet_NaN();
} // namespace

TEST(Loads, MixedLoadsOfAnIsotropicSolid)
{
  const double E = 70e9, nu = 0.3;
  const auto D = isotropic_stiffness<3>(E, nu);
  // Uniaxial stress, then with one lateral strain held: E / (1 - nu^2).
  const VoigtVector<3> cold = VoigtVector<3>::Zero();
  const auto free           = solve_mixed_load<3>(
    D, cold,
    {"free", {none, none, none, none, none, none}, {1e6, none, 0., none, none, none}});
  EXPECT_NEAR(free.strain[0], 1e6 / E, 1e-14 * 1e6 / E);
  EXPECT_NEAR(free.strain[1], -nu * 1e6 / E, 1e-14 * 1e6 / E);
  EXPECT_EQ(free.stress[1], 0.);
  const auto held = solve_mixed_load<3>(
    D, cold,
    {"held", {none, 0., none, none, none, none}, {1e6, none, none, none, none, 2e6}});
  EXPECT_NEAR(held.strain[0], 1e6 * (1. - nu * nu) / E, 1e-14 * 1e6 / E);
  EXPECT_NEAR(held.stress[1], nu * 1e6, 1e-8);
  EXPECT_NEAR(held.strain[5], 2e6 * 2. * (1. + nu) / E, 1e-14 * 1e6 / E);
  EXPECT_EQ(held.strain[1], 0.);
  // 50 K at zero strain, and free.
  VoigtVector<3> beta = cold;
  beta.head<3>().setConstant(E * 1e-5 / (1. - 2. * nu));
  const auto warm = solve_mixed_load<3>(
    D, beta, {"warm", std::vector<double>(6, 0.), std::vector<double>(6, none), 50.});
  EXPECT_NEAR(warm.stress[0], -50. * beta[0], 1e-9 * beta[0]);
  const auto wider = solve_mixed_load<3>(
    D, beta, {"wider", std::vector<double>(6, none), std::vector<double>(6, none), 50.});
  EXPECT_NEAR(wider.strain[2], 50e-5, 1e-15);
  EXPECT_EQ(wider.stress[2], 0.);
}

TEST(Loads, MomentsOfPartsAreThoseOfTheWhole)
{
  Moments whole, parts[2];
  double sum = 0., volume = 0.;
  std::vector<double> values, weights;
  for (int k = 0; k < 50; ++k)
    {
      values.push_back(1e8 + std::sin(3. * k));
      weights.push_back(1. + 0.5 * std::cos(k));
      const Moments cell =
        moments_of_cell(values.back(), weights.back(), {{1. * k, 0., 0.}});
      whole.add(cell);
      parts[k % 3 == 0 ? 0 : 1].add(cell);
      sum += weights.back() * values.back();
      volume += weights.back();
    }
  double squares = 0.;
  for (std::size_t k = 0; k < values.size(); ++k)
    squares += weights[k] * std::pow(values[k] - sum / volume, 2);
  parts[0].add(parts[1]);
  for (const Moments &m : {whole, parts[0]})
    {
      EXPECT_NEAR(m.mean, sum / volume, 1e-7);
      EXPECT_NEAR(m.standard_deviation(), std::sqrt(squares / volume), 1e-7);
      EXPECT_EQ(m.maximum, *std::max_element(values.begin(), values.end()));
      EXPECT_EQ(m.minimum, *std::min_element(values.begin(), values.end()));
      EXPECT_EQ(m.volume, whole.volume);
    }
}

TEST(Loads, PlacesOfEqualExtremesDoNotHangOnRoundOff)
{
  // Two equal maxima but for the solver's error, met in either order.
  const Moments left  = moments_of_cell(5. - 1e-9, 1., {{0.1, 0.7, 0.}}),
                right = moments_of_cell(5., 1., {{0.9, 0.2, 0.}}),
                low   = moments_of_cell(3., 1., {{0., 0., 0.}});
  Moments one, other;
  for (const Moments &cell : {left, low, right})
    one.add(cell);
  for (const Moments &cell : {right, low, left})
    other.add(cell);
  EXPECT_EQ(one.maximum, 5.);
  EXPECT_EQ(other.maximum, 5.);
  EXPECT_EQ(one.maximum_at, left.maximum_at);
  EXPECT_EQ(other.maximum_at, left.maximum_at);
  EXPECT_EQ(one.minimum_at, low.minimum_at);
}

TEST(Loads, BinsCoverAllValues)
{
  Moments m = moments_of_cell(-1., 1., {});
  m.add(moments_of_cell(3., 1., {}));
  const Bins bins(m, 4);
  EXPECT_EQ(bins(-1.), 0U);
  EXPECT_EQ(bins(0.5), 1U);
  EXPECT_EQ(bins(3.), 3U);
  EXPECT_EQ(bins.edges(), (std::vector<double>{-1., 0., 1., 2., 3.}));
  // A field that is the same everywhere but for round-off lies in the middle.
  const Bins constant(moments_of_cell(2e8, 1., {}), 5);
  EXPECT_EQ(constant(2e8), 2U);
  EXPECT_EQ(constant(2e8 + 1e-4), 2U);
  const Bins zero(moments_of_cell(0., 1., {}), 3);
  EXPECT_EQ(zero(0.), 1U);
  EXPECT_EQ(zero.edges().front(), -1.);
}

TEST(Loads, InvariantsOfPlaneStrain)
{
  const double E = 70e9, nu = 0.3;
  const LoadedPhase<2> phase{0, isotropic_stiffness<2>(E, nu),
                             VoigtVector<2>(E * nu / (1. + nu) / (1. - 2. * nu),
                                            E * nu / (1. + nu) / (1. - 2. * nu), 0.)};
  const LocalFields<2> fields({phase});
  std::vector<double> values(fields.quantities().size());
  fields.evaluate(0, VoigtVector<2>(1e-3, 0., 0.), 0., values.data());
  const double mu = E / 2. / (1. + nu), zz = values[6];
  EXPECT_EQ(fields.quantities()[6].name, "stress_zz");
  EXPECT_NEAR(zz, nu * (values[3] + values[4]), 1e-6);
  // Uniaxial strain: von Mises 2 mu eps, principal stresses xx, yy = zz.
  EXPECT_NEAR(values[LocalFields<2>::von_mises()], 2. * mu * 1e-3, 1e-6);
  EXPECT_NEAR(values[8], (values[3] + 2. * zz) / 3., 1e-6);
  EXPECT_NEAR(values[LocalFields<2>::largest_principal()], values[3], 1e-6);
  EXPECT_NEAR(values[11], zz, 1e-6);
  // A stiffness in the plane alone has no sigma_zz.
  const LocalFields<2> plane({{0, phase.stiffness, {}}});
  EXPECT_FALSE(plane.has_invariants());
  EXPECT_EQ(plane.quantities().size(), 6U);
}
