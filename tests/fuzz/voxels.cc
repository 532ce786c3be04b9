// Files of voxels: NumPy arrays after a first byte N, TIFF after any other one.
#include "fuzzing.h"

#include "io/voxel_file.h"

using namespace mesoslip;
using namespace mesoslip_tests;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static InputFile numpy("voxels.npy"), tiff("voxels.tif");
  if (size == 0)
    return 0;
  VoxelSource source;
  source.path = (data[0] == 'N' ? numpy : tiff).fill(data + 1, size - 1);
  accepted_or_refused([&]() {
    const auto file                      = VoxelFile::open(source);
    const std::vector<std::size_t> shape = file->shape();
    for (std::size_t z = 0; z < shape[0] && z < 4; ++z)
      if (file->plane(z).size() != shape[1] * shape[2])
        std::abort();
  });
  return 0;
}
