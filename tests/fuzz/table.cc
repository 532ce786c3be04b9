// CSV: tables in general and the lists of rectangles.
#include "fuzzing.h"

#include "io/table.h"
#include "morphology/rectangles.h"

using namespace mesoslip;
using namespace mesoslip_tests;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static InputFile file("table.csv");
  static const UniformGrid<2> grid = {{{40, 20}}, {{1e-4, 1e-4}}, {{0., 0.}}};
  const std::string &path          = file.fill(data, size);
  accepted_or_refused([&]() {
    const CsvTable table = CsvTable::read(path);
    for (const std::string &heading : table.columns())
      accepted_or_refused([&]() { table.numbers(heading); });
  });
  accepted_or_refused([&]() { draw_rectangles(grid, read_rectangles(path, grid)); });
  return 0;
}
