// Lists of rectangles, images and statistics of morphologies.
#include "microstructure_testing.h"

#include "base/files.h"
#include "morphology/image_map.h"

#include <algorithm>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
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
  const auto map  = draw_rectangles(small_grid, read_rectangles(file, small_grid));
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
  const auto read = read_rectangles(folder / "r.csv", paper_grid);
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
    return user_error([&] { read_rectangles(file, small_grid); });
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
  expect_error("none.csv", [&] { read_rectangles(folder / "none.csv", small_grid); });
}

namespace
{
/** The map of an image whose pixels may be oblong. */
PhaseMap<2> map_of(const UniformGrid<2> &grid,
                   const Image &image,
                   const std::vector<long> &values,
                   const unsigned int n_phases)
{
  return map_from_image(grid, image, {values, n_phases, true}, "image").map;
}

Image make_image(const unsigned int width, const std::vector<int> &values)
{
  Image image;
  image.width  = width;
  image.height = static_cast<unsigned int>(values.size() / width);
  image.values = values;
  return image;
}

ImageMap read_picture(const UniformGrid<2> &grid,
                      const std::string &file,
                      const ImageReading &reading)
{
  return map_from_image(grid, read_image(file), reading, file);
}
} // namespace

TEST(ImageMap, PicturesStandUpright)
{
  TemporaryFolder folder;
  write_file(folder / "a.txt", "0 7 0\n7 7 0\n");
  const auto map =
    read_picture(make_grid(3, 2, 1.), folder / "a.txt", {{}, 2, false}).map;
  EXPECT_EQ(picture(map), (std::vector<std::string>{".#.", "##."}));
  // The values may be named in any order.
  const auto other =
    read_picture(make_grid(3, 2, 1.), folder / "a.txt", {{7, 0}, 2, false}).map;
  EXPECT_EQ(picture(other), (std::vector<std::string>{"#.#", "..#"}));
}

TEST(ImageMap, TextOfAnyEditor)
{
  const TemporaryFolder folder;
  const std::string path = folder / "phases.txt";
  write_file(path, "\xef\xbb\xbf"
                   "0 0 1\r1 0 0\r\n");
  EXPECT_EQ(picture(read_picture(make_grid(3, 2, 1e-4), path, {{}, 2, false}).map),
            (std::vector<std::string>{"..#", "#.."}));
}

TEST(ImageMap, WholeMultiples)
{
  // Each pixel a block of cells.
  EXPECT_EQ(picture(map_of(make_grid(6, 2, 1.), make_image(2, {10, 20}), {}, 2)),
            (std::vector<std::string>{"...###", "...###"}));
  // The majority of the pixels of each cell; of three, one has it against two others.
  EXPECT_EQ(picture(map_of(make_grid(2, 1, 1.), make_image(6, {9, 10, 10, 20, 9, 20}),
                           {20, 10, 9}, 3)),
            (std::vector<std::string>{"#."}));
  const auto rows = map_of(make_grid(1, 2, 1.), make_image(1, {1, 1, 2, 2, 1, 2}), {}, 2);
  EXPECT_EQ(picture(rows), (std::vector<std::string>{"#", "."}));
}

TEST(ImageMap, TiesKeepTheFractions)
{
  // Columns one pixel wide in cells two pixels wide: every tenth of 80 is phase 1.
  for (const int first : {0, 1, 4, 9})
    {
      std::vector<int> values;
      for (int i = 0; i < 80 * 40; ++i)
        values.push_back(i % 10 == first ? 1 : 0);
      const auto map = map_of(make_grid(40, 20, 1.), make_image(80, values), {}, 2);
      EXPECT_DOUBLE_EQ(area_fractions(map, 2)[1], 0.1) << first;
    }
  // A chessboard of pixels: all cells tie, half of them are of each phase.
  std::vector<int> board;
  for (int i = 0; i < 16 * 12; ++i)
    board.push_back((i / 16 + i % 16) % 2);
  EXPECT_DOUBLE_EQ(
    area_fractions(map_of(make_grid(8, 6, 1.), make_image(16, board), {}, 2), 2)[1], 0.5);
}

TEST(ImageMap, CoarseningIsUnbiasedForRandomPixels)
{
  // Independent pixels, 30 % of phase 1: of 2 x 2 pixels, 3 or 4 are 1 with probability
  // 0.0837 and 2 with 0.2646, where ties fill up what is missing: 0.3 exactly.
  const unsigned int seed = 20240607;
  RandomNumbers random(seed);
  std::vector<int> values;
  for (unsigned int i = 0; i < 400 * 400; ++i)
    values.push_back(random.unit() < 0.3 ? 1 : 0);
  const Image image = make_image(400, values);
  const double of_pixels =
    static_cast<double>(std::count(values.begin(), values.end(), 1)) / 160000.;
  const auto map = map_of(make_grid(200, 200, 1.), image, {}, 2);
  EXPECT_NEAR(area_fractions(map, 2)[1], of_pixels, 5. / 40000.) << "seed " << seed;
  // Each corner of the picture does so as well, not the whole alone.
  PhaseMap<2> corner{make_grid(200, 50, 1.), {map.id.begin(), map.id.begin() + 200 * 50}};
  EXPECT_NEAR(
    area_fractions(corner, 2)[1],
    static_cast<double>(std::count(values.begin(), values.begin() + 400 * 100, 1)) /
      40000.,
    5. / 10000.)
    << "seed " << seed;
}

TEST(ImageMap, TellsWhatBecameOfWhat)
{
  Image image      = make_image(2, {0xff0000, 0x0000ff, 0xff0000, 0xff0000});
  image.coloured   = true;
  const auto found = map_from_image(make_grid(2, 2, 1.), image, {{}, 2, false}, "a.png");
  EXPECT_EQ(found.phases[0].value, "#0000ff (255)");
  EXPECT_EQ(found.phases[1].value, "#ff0000 (16711680)");
  EXPECT_EQ(found.phases[1].n_pixels, 3u);
  EXPECT_EQ(found.phases[1].fraction, 0.75);
  EXPECT_EQ(found.pixels, (std::array<unsigned int, 2>{{2, 2}}));
}

TEST(ImageMap, ThresholdsSortGreyValues)
{
  Image image       = make_image(6, {0, 89, 90, 91, 160, 255});
  const auto grid   = make_grid(6, 1, 1.);
  const auto sorted = [&]() {
    return map_from_image(grid, image, {{}, 3, true, {90., 160.}}, "a.png");
  };
  const ImageMap found = sorted();
  EXPECT_EQ(found.map.id, (std::vector<std::uint8_t>{0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(found.phases[0].value, "below 90");
  EXPECT_EQ(found.phases[1].value, "from 90 to below 160");
  EXPECT_EQ(found.phases[2].value, "from 160 on");
  EXPECT_EQ(found.phases[2].n_pixels, 2u);
  image.coloured = true;
  expect_error("Thresholds are for grey values", [&] { sorted(); });
}

TEST(ImageMap, Errors)
{
  const Image image = make_image(3, {1, 2, 3});
  const auto error  = [&](const UniformGrid<2> &grid, const Image &shown,
                         const ImageReading &reading) {
    return user_error([&] { map_from_image(grid, shown, reading, "a.png"); });
  };
  const std::string sizes = error(make_grid(4, 1, 1.), image, {{}, 3, true});
  expect_contains(sizes, "a.png: ");
  expect_contains(sizes, "3 x 1 pixels");
  expect_contains(sizes, "4 x 1 cells");
  expect_contains(sizes, "Grid/Cells = 3, 1");
  const UniformGrid<2> grid = make_grid(3, 1, 1.);
  expect_contains(error(grid, image, {{}, 2, false}), "3 different values");
  expect_contains(error(grid, image, {{1, 2}, 2, false}),
                  "the values 1, 2, 3, and 3 belongs");
  const Image grey = make_image(9, {1, 2, 3, 4, 5, 6, 7, 8, 9});
  expect_contains(error(make_grid(9, 1, 1.), grey, {{1, 2}, 2, false}),
                  "9 different values, and 3 belongs to no phase; use an image without");
  expect_contains(
    error(grid, image, {{}, 4, false}),
    "3 different values and there are 4 phases; say with "
    "Microstructure/Image values which value is which phase (the image has 1 "
    "to 3)");
  // Swapped numbers of cells refine one side and coarsen the other; swapped or wrong
  // lengths stretch the pixels.
  const Image wide = make_image(8, std::vector<int>(32, 1));
  expect_contains(error(make_grid(4, 8, 1.), wide, {{}, 1, true}),
                  "one side would be refined and the other coarsened");
  UniformGrid<2> stretched = make_grid(8, 4, 1.);
  stretched.spacing[1]     = 2.;
  expect_contains(error(stretched, wide, {{}, 1, false}),
                  "its 8 x 4 pixels would be 1 m wide and 2 m high in the body");
  EXPECT_NO_THROW(map_from_image(stretched, wide, {{}, 1, true}, "a.png"));
  stretched.spacing[1] = 1.009; // typed with three digits
  EXPECT_NO_THROW(map_from_image(stretched, wide, {{}, 1, false}, "a.png"));
}

TEST(ImageMap, DigitsWithoutBlanks)
{
  TemporaryFolder folder;
  const auto read = [&](const std::string &text, const unsigned int n_cells) {
    write_file(folder / "a.txt", text);
    read_picture(make_grid(n_cells, 4, 1.), folder / "a.txt", {{}, 2, true});
  };
  const auto error = [&](const std::string &text, const unsigned int n_cells) {
    return user_error([&] { read(text, n_cells); });
  };
  expect_contains(
    error("0011\n0011\n1100\n1100\n", 4),
    "a.txt:1: value 1 is '0011', a number that begins with 0; if every digit "
    "is a pixel, put blanks between them");
  expect_contains(
    error("1100\n1100\n1111\n1111\n", 4),
    "every row is one number of 4 digits, and the grid has 4 cells along x");
  expect_contains(error("1,,2,1\n1,1,2,1\n", 3),
                  "a.txt:1: a value is missing before ','");
  EXPECT_NO_THROW(read("1, 2, 2, 1,\n1, 2, 2, 1,\n", 4)); // as some programs end lines
  // Layers: numbers of one digit, or of different ones, or no such number of cells.
  EXPECT_NO_THROW(read("1\n2\n2\n1\n", 4));
  EXPECT_NO_THROW(read("9\n10\n10\n9\n", 4));
  EXPECT_NO_THROW(read("10\n20\n20\n10\n", 3));
}

TEST(CellBox, RefinedMap)
{
  const PhaseMap<2> map{make_grid(2, 1, 1.), {0, 1}};
  EXPECT_EQ(picture(refined_map(map, make_grid(4, 3, 0.5))),
            (std::vector<std::string>{"..##", "..##", "..##"}));
}
