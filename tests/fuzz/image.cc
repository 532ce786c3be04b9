// PNG and text images, and the phase maps made of them. After a first byte C the
// checksums of a PNG's chunks are put right, so that the fuzzer gets behind them.
#include "fuzzing.h"

#include "io/image.h"
#include "morphology/image_map.h"

#include <boost/crc.hpp>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
/** Signature, then chunks of length, name, data, CRC-32 of name and data; big-endian. */
void correct_checksums(std::string &png)
{
  std::size_t at = 8;
  while (at + 12 <= png.size())
    {
      std::size_t length = 0;
      for (unsigned int i = 0; i < 4; ++i)
        length = 256 * length + static_cast<unsigned char>(png[at + i]);
      if (length > png.size() - at - 12)
        return;
      boost::crc_32_type crc;
      crc.process_bytes(png.data() + at + 4, length + 4);
      for (unsigned int i = 0; i < 4; ++i)
        png[at + 8 + length + i] = static_cast<char>(crc.checksum() >> (24 - 8 * i));
      at += length + 12;
    }
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static InputFile file("image.png");
  std::string bytes(data, data + size);
  if (!bytes.empty() && bytes[0] == 'C')
    {
      bytes.erase(0, 1);
      correct_checksums(bytes);
    }
  const std::string &path = file.fill(bytes);
  accepted_or_refused([&]() {
    const Image image = read_image(path);
    const UniformGrid<2> grid{{{image.width, image.height}}, {{1., 1.}}};
    if (image.values.size() < 10000)
      map_from_image(grid, image, {{}, 2, false}, path);
  });
  return 0;
}
