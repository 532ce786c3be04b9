#include "base/text.h"
#include "io/grid_table.h"
#include "sliding/friction/coefficient_law_parameters.h"

#include <string>
#include <vector>

namespace mesoslip
{
FrictionTable::Points read_friction_table(const std::string &path)
{
  const char *const rate = "slip rate [m/s]", *const pressure = "pressure [Pa]",
                    *const coefficient = "coefficient [-]";
  const CsvTable table                 = CsvTable::read(path);
  for (const char *const heading : {rate, coefficient, pressure})
    if (heading != pressure || table.has_column(pressure))
      {
        const std::vector<double> numbers = table.numbers(heading);
        for (std::size_t row = 0; row < numbers.size(); ++row)
          if (numbers[row] < 0.)
            table.fail(row, std::string(heading) + " is " + to_text(numbers[row]) +
                              "; it must not be negative");
      }
  const GridTable grid = grid_table(table, rate, pressure, coefficient);
  FrictionTable::Points points;
  points.slip_rate   = grid.first;
  points.pressure    = grid.second;
  points.coefficient = grid.values;
  return points;
}
} // namespace mesoslip
