// Placement of fibres, lists of rectangles, images and statistics of morphologies.
#include "microstructure/image_map.h"
#include "microstructure/random_fibres.h"
#include "microstructure/random_numbers.h"
#include "microstructure/statistics.h"

#include "io/files.h"
#include "unit/io_testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
UniformGrid<2> make_grid(const unsigned int n_x, const unsigned int n_y, const double h)
{
  UniformGrid<2> grid;
  grid.cells   = {{n_x, n_y}};
  grid.spacing = {{h, h}};
  return grid;
}

const UniformGrid<2> paper_grid = make_grid(560, 160, 1e-4);

/** A 20 x 10 grid of 0.1 mm: 2 mm by 1 mm. */
const UniformGrid<2> small_grid = make_grid(20, 10, 1e-4);

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

/** '#' for phase 1, '.' for phase 0, top row first. */
std::vector<std::string> picture(const PhaseMap<2> &map)
{
  std::vector<std::string> rows;
  for (unsigned int y = map.grid.cells[1]; y-- > 0;)
    {
      rows.emplace_back();
      for (unsigned int x = 0; x < map.grid.cells[0]; ++x)
        rows.back() += ".#23456789"[map.id[y * map.grid.cells[0] + x]];
    }
  return rows;
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
  FibrePlacement rules;
  EXPECT_EQ(morphology_digest(place_random_fibres(paper_grid, rules).map), 0u);
  rules.seed = 2;
  EXPECT_EQ(morphology_digest(place_random_fibres(paper_grid, rules).map), 0u);
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
  EXPECT_EQ(phase_statistics(result.map, 2)[1].n_regions, result.fibres.size());
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

TEST(Rectangles, CentreRule)
{
  const auto covered = [](const double x, const double width) {
    const CellBox box = covered_cells(small_grid, {x * 1e-4, 0., width * 1e-4, 1e-4});
    return std::make_pair(box.x_begin, box.x_end);
  };
  using Columns = std::pair<unsigned int, unsigned int>;
  EXPECT_EQ(covered(3., 2.), Columns(3, 5));
  EXPECT_EQ(covered(3.4, 2.), Columns(3, 5));
  EXPECT_EQ(covered(3.6, 2.), Columns(4, 6));
  // Half-open: of a fibre from centre to centre the left cell counts, in spite of
  // round-off.
  EXPECT_EQ(covered(3.5, 2.), Columns(3, 5));
  EXPECT_EQ(covered(3.5 + 1e-9, 2. - 2e-9), Columns(3, 5));
  EXPECT_EQ(covered(3.5 - 1e-9, 2. + 2e-9), Columns(3, 5));
  EXPECT_EQ(covered(-2., 3.), Columns(0, 1));
  EXPECT_EQ(covered(19., 5.), Columns(19, 20));
  EXPECT_TRUE(covered_cells(small_grid, {3.6e-4, 0., 0.8e-4, 1e-4}).empty());
}

TEST(Rectangles, EveryAlignedEdgeIsExact)
{
  for (unsigned int i = 0; i < 559; ++i)
    for (const double scale : {1e-4, 0.1e-3})
      {
        const CellBox box = covered_cells(paper_grid, {i * scale, 0., scale, 1.6e-2});
        ASSERT_EQ(box.x_begin, i);
        ASSERT_EQ(box.x_end, i + 1);
        ASSERT_EQ(box.y_end, 160u);
      }
}

TEST(Rectangles, ReadFromCsv)
{
  TemporaryFolder folder;
  const std::string file = folder / "r.csv";
  write_file(file, "# a comment\nx_left_mm,y_bottom_mm,width_mm,height_mm,phase\n"
                   "0.1,0,0.2,0.3,1\n\n0.2,0.1,0.2,0.1,2\n-0.5,0.9,0.6,5,1\n");
  const auto map  = draw_rectangles(small_grid, read_rectangles(file, &small_grid));
  const auto rows = picture(map);
  EXPECT_EQ(rows[0], "#...................");
  EXPECT_EQ(rows[1], "....................");
  EXPECT_EQ(rows[7], ".##.................");
  EXPECT_EQ(rows[8], ".#22................");
  EXPECT_EQ(rows[9], ".##.................");
}

TEST(Rectangles, WriteAndReadAgain)
{
  TemporaryFolder folder;
  const auto placed = place_random_fibres(paper_grid, FibrePlacement());
  write_rectangles(folder / "r.csv", placed.fibres);
  const auto read = read_rectangles(folder / "r.csv", &paper_grid);
  EXPECT_EQ(read.size(), placed.fibres.size());
  EXPECT_EQ(draw_rectangles(paper_grid, read).id, placed.map.id);
}

TEST(Rectangles, ErrorsNameFileAndLine)
{
  TemporaryFolder folder;
  const std::string file  = folder / "r.csv";
  const std::string start = "x_left_mm,y_bottom_mm,width_mm,height_mm\n0,0,1,1\n";
  const auto error        = [&](const std::string &text) {
    write_file(file, text);
    return user_error([&] { read_rectangles(file, &small_grid); });
  };
  expect_contains(error(start + "0,0,-1,1\n"), file + ":3: width_mm");
  expect_contains(error(start + "0,0,1,0\n"), file + ":3: height_mm");
  expect_contains(error(start + "3,0,1,1\n"), file + ":3: the rectangle lies outside");
  expect_contains(error(start + "0,-2,1,1\n"), file + ":3: the rectangle lies outside");
  expect_contains(error(start + "0.06,0,0.08,1\n"), file + ":3: ");
  expect_contains(error(start + "0.06,0,0.08,1\n"), "no cell centre");
  expect_contains(error(start + "0,0,nan,1\n"), file + ":3");
  expect_contains(error(start + "0,0,1\n"), file + ":3");
  expect_contains(error(start + "0,0,a,1\n"), file + ":3");
  expect_contains(error("x_left_mm,y_bottom_mm,width_mm\n0,0,1\n"), "height_mm");
  expect_contains(error("x_left_mm,y_bottom_mm,width_mm,height_mm,colour\n"), "colour");
  const std::string phases = "x_left_mm,y_bottom_mm,width_mm,height_mm,phase\n";
  expect_contains(error(phases + "0,0,1,1,1.5\n"), file + ":2: phase");
  expect_contains(user_error([&] { read_rectangles(folder / "none.csv"); }), "none.csv");
  expect_contains(user_error([&] {
                    draw_rectangles(small_grid, {{0., 0., 1e-3, 1e-3}, {1., 0., 1., 1.}});
                  }),
                  "number 2");
}

TEST(ImageMap, PicturesStandUpright)
{
  TemporaryFolder folder;
  write_file(folder / "a.txt", "0 7 0\n7 7 0\n");
  const auto map = read_phase_map(make_grid(3, 2, 1.), folder / "a.txt", {}, 2);
  EXPECT_EQ(picture(map), (std::vector<std::string>{".#.", "##."}));
  // The values may be named in any order.
  const auto other = read_phase_map(make_grid(3, 2, 1.), folder / "a.txt", {7, 0}, 2);
  EXPECT_EQ(picture(other), (std::vector<std::string>{"#.#", "..#"}));
}

TEST(ImageMap, WholeMultiples)
{
  Image image;
  image.width  = 2;
  image.height = 1;
  image.values = {10, 20};
  // Each pixel a block of cells.
  EXPECT_EQ(picture(map_from_image(make_grid(6, 2, 1.), image, {}, 2, "image")),
            (std::vector<std::string>{"...###", "...###"}));
  // The pixel at the centre of each cell: number 1 of 0, 1, 2, number 4 of 3, 4, 5.
  image.width  = 6;
  image.values = {9, 10, 9, 9, 20, 9};
  EXPECT_EQ(picture(map_from_image(make_grid(2, 1, 1.), image, {20, 10, 9}, 3, "image")),
            (std::vector<std::string>{"#."}));
}

TEST(ImageMap, Errors)
{
  Image image;
  image.width      = 3;
  image.height     = 1;
  image.values     = {1, 2, 3};
  const auto error = [&](const UniformGrid<2> &grid, const std::vector<long> &values,
                         const unsigned int n_phases) {
    return user_error([&] { map_from_image(grid, image, values, n_phases, "a.png"); });
  };
  const std::string sizes = error(make_grid(4, 1, 1.), {}, 3);
  expect_contains(sizes, "a.png: ");
  expect_contains(sizes, "3 x 1 pixels");
  expect_contains(sizes, "4 x 1 cells");
  expect_contains(error(make_grid(3, 1, 1.), {}, 2), "3 different values");
  expect_contains(error(make_grid(3, 1, 1.), {1, 2}, 2), "value 3");
}

TEST(Statistics, OfASmallMap)
{
  // .##..
  // .#..#
  // ##..#
  const PhaseMap<2> map{make_grid(5, 3, 0.5),
                        {1, 1, 0, 0, 1, /**/ 0, 1, 0, 0, 1, /**/ 0, 1, 1, 0, 0}};
  const auto s = phase_statistics(map, 3);
  EXPECT_EQ(s[1].n_cells, 7u);
  EXPECT_DOUBLE_EQ(s[1].area_fraction, 7. / 15.);
  EXPECT_EQ(s[1].n_regions, 2u);
  EXPECT_EQ(s[0].n_regions, 2u);
  EXPECT_DOUBLE_EQ(s[1].mean_chord_x, 0.5 * 7. / 5.);
  EXPECT_DOUBLE_EQ(s[1].mean_chord_y, 0.5 * 7. / 4.);
  EXPECT_EQ(s[2].n_cells, 0u);
  EXPECT_EQ(s[2].mean_chord_x, 0.);
  EXPECT_EQ(area_fractions(map, 2), (std::vector<double>{8. / 15., 7. / 15.}));
  const auto along_x = two_point_probability(map, 1, 0, 2);
  EXPECT_DOUBLE_EQ(along_x[0], 7. / 15.);
  EXPECT_DOUBLE_EQ(along_x[1], 2. / 12.);
  EXPECT_DOUBLE_EQ(along_x[2], 0. / 9.);
  EXPECT_DOUBLE_EQ(two_point_probability(map, 1, 1, 1)[1], 3. / 10.);
}

TEST(CellBox, RefinedMap)
{
  const PhaseMap<2> map{make_grid(2, 1, 1.), {0, 1}};
  EXPECT_EQ(picture(refined_map(map, make_grid(4, 3, 0.5))),
            (std::vector<std::string>{"..##", "..##", "..##"}));
}
