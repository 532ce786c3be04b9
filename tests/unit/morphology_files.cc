// Lists of rectangles, images and statistics of morphologies.
#include "io_testing.h"

#include "io/files.h"
#include "microstructure/image_map.h"
#include "microstructure/random_fibres.h"
#include "microstructure/statistics.h"

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

TEST(ImageMap, TextOfAnyEditor)
{
  const TemporaryFolder folder;
  const std::string path = folder / "phases.txt";
  write_file(path, "\xef\xbb\xbf"
                   "0 0 1\r1 0 0\r\n");
  EXPECT_EQ(picture(read_phase_map(make_grid(3, 2, 1e-4), path, {}, 2)),
            (std::vector<std::string>{"..#", "#.."}));
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
  EXPECT_DOUBLE_EQ(s[0].mean_chord_y, 0.5 * 8. / 4.);
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
