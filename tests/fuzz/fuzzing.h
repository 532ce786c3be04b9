#ifndef mesoslip_tests_fuzz_fuzzing_h
#define mesoslip_tests_fuzz_fuzzing_h

#include "base/errors.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace mesoslip_tests
{
/** A file in memory (on a tmpfs where there is one) that takes the bytes of each
 * execution. */
class InputFile
{
public:
  explicit InputFile(const std::string &name)
    : folder((std::filesystem::is_directory("/dev/shm") ? "/dev/shm/mesoslip_fuzz."
                                                        : "/tmp/mesoslip_fuzz.") +
             std::to_string(getpid()))
    , path(folder + "/" + name)
  {
    std::filesystem::create_directory(folder);
  }
  ~InputFile()
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }

  const std::string &fill(const std::uint8_t *data, const std::size_t size)
  {
    std::FILE *file = std::fopen(path.c_str(), "wb");
    if (file == nullptr || std::fwrite(data, 1, size, file) != size ||
        std::fclose(file) != 0)
      std::abort();
    return path;
  }

  const std::string &fill(const std::string &bytes)
  {
    return fill(reinterpret_cast<const std::uint8_t *>(bytes.data()), bytes.size());
  }

  const std::string folder, path;
};

/** A reader may accept its input or throw a UserError with a sentence; anything else is a
 * finding. */
template <typename Reader>
void accepted_or_refused(const Reader &reader)
{
  try
    {
      reader();
    }
  catch (const mesoslip::UserError &error)
    {
      const std::string sentence = error.what();
      if (sentence.empty() || sentence.size() > 100000)
        std::abort();
    }
}
} // namespace mesoslip_tests

#endif
