// PNG and text images.
#include "io_testing.h"

#include "base/files.h"
#include "io/image.h"

#include <boost/crc.hpp>

#include <cstdint>
#include <png.h>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
void write_png(const std::string &path,
               const png_uint_32 format,
               const std::vector<png_byte> &pixels)
{
  png_image png = {};
  png.version   = PNG_IMAGE_VERSION;
  png.width     = 3;
  png.height    = 2;
  png.format    = format;
  ASSERT_NE(png_image_write_to_file(&png, path.c_str(), 0, pixels.data(), 0, nullptr), 0);
}

std::string big_endian(const std::uint32_t value)
{
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> shift);
  return bytes;
}

/** Length, name, content, checksum of name and content. */
std::string png_chunk(const std::string &name, const std::string &content)
{
  boost::crc_32_type crc;
  crc.process_bytes((name + content).data(), name.size() + content.size());
  return big_endian(static_cast<std::uint32_t>(content.size())) + name + content +
         big_endian(static_cast<std::uint32_t>(crc.checksum()));
}

/** A row of bytes as a PNG: a stored block of zlib, after @p chunks. */
std::string png_of_row(const char bits,
                       const char colour_type,
                       const std::string &chunks,
                       const std::string &row)
{
  const std::string data = std::string(1, '\0') + row; // no filter
  std::uint32_t a = 1, b = 0;                          // Adler's checksum
  for (const unsigned char byte : data)
    {
      a = (a + byte) % 65521;
      b = (b + a) % 65521;
    }
  const auto n     = static_cast<char>(data.size());
  const auto width = static_cast<std::uint32_t>(
    8 * row.size() / static_cast<unsigned char>(bits) / (colour_type == 2 ? 3 : 1));
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", big_endian(width) + big_endian(1) +
                             std::string({bits, colour_type, 0, 0, 0})) +
         chunks +
         png_chunk("IDAT", std::string("\x78\x01\x01", 3) +
                             std::string({n, 0, static_cast<char>(~n), '\xff'}) + data +
                             big_endian((b << 16) + a)) +
         png_chunk("IEND", "");
}
} // namespace

// Gamma 1 made 110 of 40, and gamma 0.22 made one value of 0, 1 and 2.
TEST(Images, ValuesAreThoseInTheFile)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.png";
  const auto values      = [&](const std::string &png) {
    write_file(path, png);
    return read_image(path).values;
  };
  const std::string srgb         = png_chunk("sRGB", std::string(1, '\0')),
                    row          = "\x01\x02\x28\xc8",
                    chromaticity = png_chunk(
                      "cHRM", big_endian(31270) + big_endian(32900) + big_endian(64000) +
                                big_endian(33000) + big_endian(30000) +
                                big_endian(60000) + big_endian(15000) + big_endian(6000));
  std::vector<std::string> chunks = {"", srgb, chromaticity};
  for (const std::uint32_t gamma : {100000u, 22000u, 35000u, 45455u, 250000u})
    chunks.push_back(png_chunk("gAMA", big_endian(gamma)));
  for (const std::string &chunk : chunks)
    {
      EXPECT_EQ(values(png_of_row(8, 0, chunk, row)), (std::vector<int>{1, 2, 40, 200}));
      EXPECT_EQ(values(png_of_row(8, 2, chunk, "\x01\x02\x28")),
                (std::vector<int>{0x010228}));
      const std::string palette = png_chunk("PLTE", "\x01\x02\x28\x07\x07\x07");
      EXPECT_EQ(values(png_of_row(8, 3, chunk + palette, std::string("\1\0", 2))),
                (std::vector<int>{0x070707, 0x010228}));
      EXPECT_TRUE(read_image(path).coloured);
      // 16 bits: 0 to 65535; 2 bits: four levels from 0 to 255.
      EXPECT_EQ(values(png_of_row(16, 0, chunk, std::string("\0\0\x01\x02\xff\xff", 6))),
                (std::vector<int>{0, 258, 65535}));
      EXPECT_EQ(values(png_of_row(2, 0, chunk, "\x1b")),
                (std::vector<int>{0, 85, 170, 255}));
    }
  // A palette of greys is grey.
  const std::string greys = png_chunk("PLTE", "\x09\x09\x09\x07\x07\x07");
  EXPECT_EQ(values(png_of_row(8, 3, greys, std::string("\1\0", 2))),
            (std::vector<int>{7, 9}));
  EXPECT_FALSE(read_image(path).coloured);
}

TEST(Images, BeginAtTheBottom)
{
  const TemporaryFolder folder;
  write_png(folder / "g.png", PNG_FORMAT_GRAY, {0, 128, 255, 7, 7, 255});
  Image image = read_image(folder / "g.png");
  EXPECT_EQ(image.width, 3u);
  EXPECT_EQ(image.height, 2u);
  EXPECT_EQ(image.values, (std::vector<int>{7, 7, 255, 0, 128, 255}));

  write_png(folder / "c.png", PNG_FORMAT_RGB,
            {255, 0, 0, 0, 0, 255, 1, 1, 1, 255, 0, 0, 255, 0, 0, 0, 1, 0});
  image = read_image(folder / "c.png");
  EXPECT_EQ(image.values, (std::vector<int>{0xff0000, 0xff0000, 0x000100, 0xff0000,
                                            0x0000ff, 0x010101}));

  write_png(folder / "a.png", PNG_FORMAT_GA,
            {0, 255, 128, 255, 255, 255, 7, 255, 7, 255, 9, 255});
  image = read_image(folder / "a.png");
  EXPECT_EQ(image.values, (std::vector<int>{7, 7, 9, 0, 128, 255}));

  write_file(folder / "t.txt", "# phases\n1 2 3\n\n4,5, -6 # bottom\n");
  image = read_image(folder / "t.txt");
  EXPECT_EQ(image.values, (std::vector<int>{4, 5, -6, 1, 2, 3}));

  // As numpy.savetxt() and numpy.save() write them.
  write_file(folder / "t.txt", "0.000000000000000000e+00 1.000000000000000000e+00\n"
                               "-5.000000000000000000e+00 3.000000000000000000e+00\n");
  EXPECT_EQ(read_image(folder / "t.txt").values, (std::vector<int>{-5, 3, 0, 1}));
  for (const std::string order : {"False", "True"})
    {
      std::string head =
        "{'descr': '|u1', 'fortran_order': " + order + ", 'shape': (2, 3)}";
      head.resize(118, ' ');
      write_file(folder / "a.npy", std::string("\x93NUMPY\1\0\x76\0", 10) + head +
                                     (order == "True" ? "\1\4\2\5\3\6" : "\1\2\3\4\5\6"));
      image = read_image(folder / "a.npy");
      EXPECT_EQ(image.width, 3u);
      EXPECT_EQ(image.values, (std::vector<int>{4, 5, 6, 1, 2, 3}));
    }
}

TEST(Images, NameWhatIsWrong)
{
  const TemporaryFolder folder;
  const std::string path = folder / "i.txt";
  const auto message     = [&](const std::string &text) {
    write_file(path, text);
    return user_error([&]() { read_image(path); });
  };
  expect_contains(message("1 2\n1 2 3\n"),
                  "i.txt:2: 3 values, but the rows before have 2");
  expect_contains(message("1 2\n1 x\n"), "i.txt:2: value 2 is 'x'");
  expect_contains(message("1 2.5\n"), "i.txt:1: value 2 is '2.5'");
  expect_contains(message("1 99999999999\n"), "a whole number too large");
  expect_contains(message("# nothing\n"), "is empty");
  write_png(folder / "g.png", PNG_FORMAT_GRAY, {0, 128, 255, 7, 7, 255});
  write_png(folder / "a.png", PNG_FORMAT_GA,
            {0, 255, 9, 255, 9, 255, 7, 255, 7, 255, 9, 254});
  expect_error("has transparent pixels", [&] { read_image(folder / "a.png"); });
  const std::string png = read_file(folder / "g.png");
  expect_contains(message(png.substr(0, png.size() / 2)), "i.txt");
  expect_contains(message(png.substr(1)), "neither a PNG");
  expect_error("is a folder", [&] { read_image(folder.path); });
  expect_contains(message("0011\n1100\n"), "i.txt:1: value 1 is '0011', a number that");
  expect_contains(message(png_of_row(16, 2, "", "abcdef")), "colours of 16 bits");
  // One colour or grey may be called transparent.
  const std::string grey_seven = png_chunk("tRNS", std::string("\0\7", 2));
  expect_contains(message(png_of_row(8, 0, grey_seven, "\x09\x07")),
                  "has transparent pixels");
  EXPECT_NE(message("\xff\xd8\xff\xe0 JFIF")
              .find("is a JPEG, which blurs the edges of "
                    "phases; save it as PNG"),
            std::string::npos);
  expect_contains(message(std::string("II*\0\x08", 5)), "cannot be opened as a TIFF");
  expect_contains(message("P2\n2 1\n255\n0 255\n"), "is a PGM; save it as PNG");
  std::string damaged = png_of_row(8, 0, "", "\x01\x02");
  damaged[damaged.size() - 20] ^= 1; // in the pixels or their checksum
  expect_contains(message(damaged), "damaged or truncated");
}
