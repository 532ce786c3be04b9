// Random placement of fibres.
#include "microstructure_testing.h"

#include "morphology/random_fibres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
/** Whether the cells of all fibres are @p gap cells apart in x or in y, pair by pair. */
bool all_apart(const UniformGrid<2> &grid,
               const std::vector<Rectangle> &fibres,
               const unsigned int gap)
{
  std::vector<CellBox> boxes;
  for (const Rectangle &fibre : fibres)
    boxes.push_back(covered_cells(grid, fibre));
  const auto apart = [gap](const unsigned int end, const unsigned int begin) {
    return end + gap <= begin;
  };
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const CellBox &a = boxes[i], &b = boxes[j];
          !apart(a.x_end, b.x_begin) && !apart(b.x_end, a.x_begin) &&
          !apart(a.y_end, b.y_begin) && !apart(b.y_end, a.y_begin))
        return false;
  return true;
}

std::size_t n_fibre_cells(const PhaseMap<2> &map)
{
  return static_cast<std::size_t>(std::count(map.id.begin(), map.id.end(), 1));
}

} // namespace

TEST(RandomNumbers, FollowTheStandardTwister)
{
  // The standard prescribes the 10000th number of the default seed.
  RandomNumbers random(5489u);
  for (unsigned int i = 0; i < 9999; ++i)
    random.unit();
  EXPECT_EQ(random.unit(), static_cast<double>(9981545732273789042u >> 11) * 0x1p-53);
}

TEST(RandomFibres, PaperMeetsTheFractionExactly)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    {
      FibrePlacement rules;
      rules.seed        = seed;
      const auto result = place_random_fibres(paper_grid, rules);
      EXPECT_TRUE(result.target_reached);
      EXPECT_EQ(n_fibre_cells(result.map), 8960u) << "seed " << seed;
      EXPECT_DOUBLE_EQ(result.actual_fraction, 0.1);
      EXPECT_NEAR(result.nominal_fraction, 0.1, 1e-12);
      EXPECT_TRUE(all_apart(paper_grid, result.fibres, 0)) << "seed " << seed;
      for (std::size_t i = 0; i + 1 < result.fibres.size(); ++i)
        {
          const CellBox box = covered_cells(paper_grid, result.fibres[i]);
          EXPECT_EQ(box.x_end - box.x_begin, 1u);
          EXPECT_GE(box.y_end - box.y_begin, 12u);
          EXPECT_LE(box.y_end - box.y_begin, 36u);
        }
      // 8960 cells in fibres of 24 on average, deviation 7.2 a fibre.
      EXPECT_NEAR(static_cast<double>(result.fibres.size()), 8960. / 24., 30.);
    }
}

TEST(RandomFibres, SeedsAreReproducible)
{
  // From an independent implementation (Python) of twister, placement and digest.
  FibrePlacement rules;
  EXPECT_EQ(morphology_digest(place_random_fibres(paper_grid, rules).map),
            11980823772313234077u);
  rules.seed = 2;
  EXPECT_EQ(morphology_digest(place_random_fibres(paper_grid, rules).map),
            17439792134809980317u);
}

TEST(RandomFibres, HeightsAreUniform)
{
  FibrePlacement rules;
  rules.fraction_rule = FractionRule::nominal;
  rules.allow_overlap = true;
  rules.area_fraction = 0.9;
  const auto result   = place_random_fibres(make_grid(1120, 320, 1e-4), rules);
  std::vector<unsigned int> count(37, 0);
  for (const Rectangle &fibre : result.fibres)
    ++count.at(static_cast<std::size_t>(std::lround(fibre.height / 1e-4)));
  double chi_squared    = 0.;
  const double expected = static_cast<double>(result.fibres.size()) / 25.;
  for (unsigned int n = 12; n <= 36; ++n)
    chi_squared += std::pow(count[n] - expected, 2) / expected;
  EXPECT_LT(chi_squared, 52.6); // 24 degrees of freedom, 0.07 %
}

TEST(RandomFibres, IndependentPlacementCoversByTheExponential)
{
  FibrePlacement rules;
  rules.fraction_rule = FractionRule::nominal;
  rules.allow_overlap = true;
  rules.cut_by_border = true;
  rules.area_fraction = 0.5;
  const auto result   = place_random_fibres(paper_grid, rules);
  EXPECT_TRUE(result.target_reached);
  EXPECT_GE(result.nominal_fraction, 0.5 - 1e-9);
  EXPECT_LT(result.nominal_fraction, 0.5 + 36. / 89600.);
  // Boolean model: 1 - exp(-0.5) = 0.393.
  EXPECT_NEAR(result.actual_fraction, 1. - std::exp(-0.5), 0.01);
  EXPECT_EQ(result.reached_fraction(FractionRule::nominal), result.nominal_fraction);
}

TEST(RandomFibres, OverlapWithActualFraction)
{
  FibrePlacement rules;
  rules.allow_overlap = true;
  rules.area_fraction = 0.4;
  const auto result   = place_random_fibres(paper_grid, rules);
  EXPECT_EQ(n_fibre_cells(result.map), 35840u);
  EXPECT_GT(result.nominal_fraction, 0.45);
  EXPECT_FALSE(all_apart(paper_grid, result.fibres, 0));
}

TEST(RandomFibres, RespectsTheGap)
{
  FibrePlacement rules;
  rules.minimum_gap = 0.15e-3; // two cells
  const auto result = place_random_fibres(paper_grid, rules);
  EXPECT_TRUE(result.target_reached);
  EXPECT_TRUE(all_apart(paper_grid, result.fibres, 2));
  rules.minimum_gap = 0.1e-3;
  EXPECT_FALSE(all_apart(paper_grid, place_random_fibres(paper_grid, rules).fibres, 2));
}

TEST(RandomFibres, BorderRule)
{
  FibrePlacement rules;
  rules.area_fraction   = 0.3;
  const auto sticks_out = [](const Rectangle &fibre) {
    return fibre.y_bottom < -1e-9 || fibre.y_bottom + fibre.height > 0.016 + 1e-9;
  };
  const auto inside = place_random_fibres(paper_grid, rules);
  EXPECT_EQ(std::count_if(inside.fibres.begin(), inside.fibres.end(), sticks_out), 0);
  rules.cut_by_border = true;
  const auto cut      = place_random_fibres(paper_grid, rules);
  EXPECT_GT(std::count_if(cut.fibres.begin(), cut.fibres.end(), sticks_out), 20);
  EXPECT_EQ(n_fibre_cells(cut.map), 26880u);
  // Whatever is cut, the list draws the same morphology.
  EXPECT_EQ(draw_rectangles(paper_grid, cut.fibres).id, cut.map.id);
}

TEST(RandomFibres, UnalignedFibres)
{
  FibrePlacement rules;
  rules.align_to_grid = false;
  rules.width         = 0.25e-3; // two or three columns
  const auto result   = place_random_fibres(paper_grid, rules);
  EXPECT_TRUE(result.target_reached);
  EXPECT_NEAR(result.actual_fraction, 0.1, 1.6 / 89600.);
  EXPECT_TRUE(all_apart(paper_grid, result.fibres, 0));
  EXPECT_EQ(draw_rectangles(paper_grid, result.fibres).id, result.map.id);
  unsigned int wide = 0;
  for (const Rectangle &fibre : result.fibres)
    {
      const CellBox box = covered_cells(paper_grid, fibre);
      EXPECT_TRUE(box.x_end - box.x_begin == 2 || box.x_end - box.x_begin == 3);
      wide += box.x_end - box.x_begin == 3;
    }
  const double share =
    static_cast<double>(wide) / static_cast<double>(result.fibres.size());
  EXPECT_NEAR(share, 0.5, 0.15);
}

TEST(RandomFibres, LastFibreTrimmedOrNot)
{
  FibrePlacement rules;
  rules.width = rules.min_height = rules.max_height = 0.4e-3; // 16 cells
  rules.area_fraction                               = 0.1;    // of 200: 20 cells
  const auto trimmed = place_random_fibres(small_grid, rules);
  EXPECT_EQ(n_fibre_cells(trimmed.map), 20u);
  EXPECT_NEAR(trimmed.fibres.back().height, 0.1e-3, 1e-12);
  rules.trim_last = false;
  EXPECT_EQ(n_fibre_cells(place_random_fibres(small_grid, rules).map), 16u);
  rules.area_fraction = 0.13; // 26 cells: a second one is closer than none
  const auto whole    = place_random_fibres(small_grid, rules);
  EXPECT_TRUE(whole.target_reached);
  EXPECT_EQ(n_fibre_cells(whole.map), 32u);
}

TEST(RandomFibres, UnreachableTargetStopsAndSaysHowFar)
{
  FibrePlacement rules;
  rules.min_height = rules.max_height = 0.7e-3; // one fits above another nowhere
  rules.area_fraction                 = 0.9;
  const auto result                   = place_random_fibres(small_grid, rules);
  EXPECT_FALSE(result.target_reached);
  // Every column took its fibre: none was overlooked.
  EXPECT_EQ(result.fibres.size(), 20u);
  EXPECT_DOUBLE_EQ(result.actual_fraction, 0.7);

  rules.minimum_gap = 1.; // more than the box
  EXPECT_EQ(place_random_fibres(small_grid, rules).fibres.size(), 1u);
  rules.minimum_gap = 0.;
  rules.min_height = rules.max_height = 1.1e-3; // taller than the box
  EXPECT_TRUE(place_random_fibres(small_grid, rules).fibres.empty());
}

TEST(RandomFibres, DensePackingFillsWhatIsLeft)
{
  // Far beyond what random draws reach: every place left is found.
  FibrePlacement rules;
  rules.min_height    = 0.1e-3;
  rules.area_fraction = 0.999;
  const auto result   = place_random_fibres(paper_grid, rules);
  EXPECT_TRUE(result.target_reached);
  EXPECT_EQ(n_fibre_cells(result.map), 89510u);
  EXPECT_TRUE(all_apart(paper_grid, result.fibres, 0));
}
