// Runs a fuzz target without libFuzzer: replay <folder of inputs> <mutations> <last
// input>. Every input of the folder once, then so many changed ones, the same ones each
// time. What it was at when it ended is in the file <last input>.
#include "base/files.h"
#include "byte_edits.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>
#include <vector>

using namespace mesoslip_tests;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

namespace
{
const std::uint8_t *bytes_of(const std::string &text)
{
  return reinterpret_cast<const std::uint8_t *>(text.data());
}

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

std::string random_bytes(const std::size_t n, std::mt19937 &generator)
{
  std::string bytes(n, '\0');
  for (char &c : bytes)
    c = static_cast<char>(generator());
  return bytes;
}

/** A few edits, or another end. */
std::string changed(const std::string &input, std::mt19937 &generator)
{
  constexpr std::size_t longest = 4096;
  if (generator() % 2 == 0)
    return input.substr(0, generator() % (input.size() + 1)) +
           random_bytes(generator() % 64, generator);
  const std::string random = random_bytes(4 + generator() % 28, generator);
  Choices choices(bytes_of(random), random.size());
  return edit_bytes(input, choices).substr(0, longest);
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
    LLVMFuzzerTestOneInput(bytes_of(input), input.size());
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
