// Checkpoints: the frame around the state. The first byte chooses whether the checksum is
// put right, so that the fuzzer gets behind it.
#include "fuzzing.h"

#include "io/checkpoint.h"

#include <boost/crc.hpp>

#include <cstring>
#include <vector>

using namespace mesoslip;
using namespace mesoslip_tests;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  static InputFile file("checkpoint");
  if (size == 0)
    return 0;
  std::vector<std::uint8_t> bytes(data + 1, data + size);
  constexpr std::size_t crc_at = 20, payload_at = 96;
  if (data[0] % 2 == 1 && bytes.size() >= payload_at)
    {
      boost::crc_32_type crc;
      crc.process_bytes(bytes.data() + payload_at, bytes.size() - payload_at);
      const std::uint32_t sum = crc.checksum();
      std::memcpy(bytes.data() + crc_at, &sum, sizeof(sum));
    }
  const std::string &path = file.fill(bytes.data(), bytes.size());
  accepted_or_refused([&]() {
    CheckpointHeader header;
    header.kind = "contact_dynamics";
    if (read_checkpoint(path, header).size() != bytes.size() - payload_at)
      std::abort();
  });
  return 0;
}
