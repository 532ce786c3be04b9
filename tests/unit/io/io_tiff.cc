// TIFF: one bit a pixel, stacks of ImageJ in one page, and files that have fewer pages than they tell of.
#include "io_testing.h"

#include "base/files.h"
#include "io/image.h"
#include "io/tiff_image.h"
#include "io/voxel_file.h"

#include <filesystem>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
std::string little_endian(const std::size_t value, const unsigned int n)
{
  std::string bytes;
  for (unsigned int k = 0; k < n; ++k)
    bytes += static_cast<char>(value >> 8 * k);
  return bytes;
}

/** What a TIFF of 3 x 2 pixels has beside its numbers. */
struct TiffText
{
  unsigned int bits       = 8;  ///< of a pixel
  unsigned int meaning    = 1;  ///< 0: 0 is white
  std::string description = ""; ///< of the first page
  unsigned int next_page  = 0;  ///< where it begins
  unsigned int missing    = 0;  ///< bytes that its strip says to be shorter
};

/** A page whose description and then @p data follow it. */
std::string tiff_of(const std::string &data, const TiffText &text = {})
{
  const std::string description = text.description + std::string(4, '\0');
  const std::size_t begin = 134, n_row = text.bits == 1 ? 1 : 3 * text.bits / 8;
  std::string bytes =
    "II*" + std::string(1, '\0') + little_endian(8, 4) + little_endian(10, 2);
  const auto add = [&](const unsigned int tag, const unsigned int type,
                       const std::size_t n, const std::size_t value) {
    bytes += little_endian(tag, 2) + little_endian(type, 2) + little_endian(n, 4) +
             little_endian(value, 4);
  };
  add(256, 4, 1, 3);
  add(257, 4, 1, 2);
  add(258, 3, 1, text.bits);
  add(259, 3, 1, 1);
  add(262, 3, 1, text.meaning);
  add(270, 2, description.size(), begin);
  add(273, 4, 1, begin + description.size());
  add(277, 3, 1, 1);
  add(278, 4, 1, 2);
  add(279, 4, 1, 2 * n_row - text.missing);
  return bytes + little_endian(text.next_page, 4) + description + data;
}

const std::string two_images = "\1\2\3\4\5\6\7\10\11\12\13\14";
} // namespace

TEST(Tiff, StacksOfImageJAreInOnePage)
{
  const TemporaryFolder folder;
  const std::string path = folder / "stack.tif";
  for (const std::string text :
       {"ImageJ=1.53t\nimages=2\nslices=2\n", "{\"shape\": [2, 2, 3]}"})
    {
      write_file(path, tiff_of(two_images, {8, 1, text}));
      VoxelSource source;
      source.path     = path;
      const auto file = VoxelFile::open(source);
      EXPECT_EQ(file->shape(), (std::vector<std::size_t>{2, 2, 3}));
      EXPECT_EQ(file->plane(0), (std::vector<double>{1, 2, 3, 4, 5, 6}));
      EXPECT_EQ(file->plane(1), (std::vector<double>{7, 8, 9, 10, 11, 12}));
    }
  write_file(path, tiff_of(two_images, {16, 1, "images=1"}));
  EXPECT_EQ(tiff_pages(path), 1u);
  EXPECT_EQ(read_tiff(path).values[1], 3 + 256 * 4);
}

TEST(Tiff, OneBitIsWhiteOrBlack)
{
  const TemporaryFolder folder;
  const std::string path = folder / "mask.tif";
  for (const unsigned int black : {0, 1})
    {
      write_file(path, tiff_of("\xa0\x40", {1, black}));
      const double a = black, b = 1 - a;
      EXPECT_EQ(read_tiff(path).values, (std::vector<double>{a, b, a, b, a, b}));
      EXPECT_EQ(read_image(path).values[0], b) << "a picture begins at the bottom";
    }
}

TEST(Tiff, ShortStripsAreDamage)
{
  const TemporaryFolder folder;
  const std::string path = folder / "short.tif";
  for (const unsigned int missing : {1, 3, 6})
    {
      write_file(path, tiff_of(two_images, {8, 1, "", 0, missing}));
      expect_error("page 1 of this TIFF is damaged", [&]() { read_tiff(path); });
    }
}

TEST(Tiff, PicturesOfAStackHaveTheSameNumbers)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "stack");
  write_file(folder / "stack/s0.tif", tiff_of(two_images, {16, 1}));
  write_file(folder / "stack/s1.tif", tiff_of(two_images, {8, 1}));
  VoxelSource source;
  source.path     = folder / "stack";
  const auto file = VoxelFile::open(source);
  file->plane(0);
  const std::string refusal = user_error([&]() { file->plane(1); });
  expect_contains(refusal, "s1.tif has 8 bits a pixel");
  expect_contains(refusal, "s0.tif has 16 bits a pixel");
}

TEST(Tiff, MissingPagesAreNamed)
{
  const TemporaryFolder folder;
  const auto message = [&](const std::string &bytes) {
    write_file(folder / "a.tif", bytes);
    return user_error([&]() { tiff_pages(folder / "a.tif"); });
  };
  expect_contains(message(tiff_of(two_images, {8, 1, "images=3"})),
                  "tells of 3 images in its description, but has 1 page");
  expect_contains(message(tiff_of(two_images, {8, 1, "SizeZ=\"6\""})),
                  "tells of 6 images");
  expect_contains(message(tiff_of(two_images, {8, 1, "channels=2"})), "2 channels");
  expect_contains(message(tiff_of(two_images, {8, 1, "", 100000})),
                  "behind page 1 another one is missing");

  // In a folder each file has one picture.
  std::filesystem::create_directory(folder / "stack");
  for (const char *name : {"stack/1.tif", "stack/2.tif"})
    write_file(folder / name, tiff_of(two_images, {8, 1, "images=2"}));
  VoxelSource source;
  source.path = folder / "stack";
  expect_error("1.tif has 2 pages", [&]() { VoxelFile::open(source); });
  expect_error("a.tif has 2 pages", [&]() {
    write_file(folder / "a.tif", tiff_of(two_images, {8, 1, "images=2"}));
    read_image(folder / "a.tif");
  });
}
