// Runs a fuzz target without libFuzzer: replay <folder of inputs> <mutations> <last
// input>. Every input of the folder once, then so many changed ones, the same ones each
// time. What it was at when it ended is in the file <last input>.
#include "base/files.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

namespace
{
std::vector<std::string> read_inputs(const std::string &folder)
{
  std::vector<std::string> paths, inputs;
  for (const auto &entry : std::filesystem::directory_iterator(folder))
    paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  for (const std::string &path : paths)
    inputs.push_back(mesoslip::read_file(path));
  return inputs;
}

/** Single bytes, bits and runs overwritten, pieces moved, another end; a few of these. */
std::string changed(std::string input, std::mt19937 &generator)
{
  constexpr std::size_t longest = 4096;
  const auto byte               = [&]() { return static_cast<char>(generator()); };
  for (unsigned long n = 1 + generator() % 6; n > 0 && !input.empty(); --n)
    {
      const std::size_t at   = generator() % input.size(),
                        from = generator() % input.size();
      const std::size_t most =
        std::min<std::size_t>(generator() % 256, input.size() - at);
      switch (generator() % 8)
        {
        case 0: // another end
          input.resize(at);
          for (unsigned long k = generator() % 64; k > 0; --k)
            input += byte();
          break;
        case 1:
          std::fill_n(input.begin() + static_cast<long>(at), most, byte());
          break;
        case 2:
          input.replace(at, most, input.substr(from, most));
          break;
        case 3:
          input[at] = static_cast<char>(input[at] ^ (1 << generator() % 8));
          break;
        default:
          input[at] = byte();
        }
    }
  return input.substr(0, longest);
}
} // namespace

int main(const int argc, char **argv)
{
  if (argc != 4)
    {
      std::cerr << "replay <folder of inputs> <mutations> <last input>\n";
      return EXIT_FAILURE;
    }
  const auto run = [&](const std::string &input) {
    mesoslip::write_file(argv[3], input);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(input.data()),
                           input.size());
  };
  const std::vector<std::string> inputs = read_inputs(argv[1]);
  for (const std::string &input : inputs)
    run(input);
  std::mt19937 generator(1);
  const unsigned long n = inputs.empty() ? 0 : std::stoul(argv[2]);
  for (unsigned long k = 0; k < n; ++k)
    run(changed(inputs[k % inputs.size()], generator));
  std::cout << inputs.size() << " inputs and " << n << " changed ones\n";
  return n > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
