#include "io/grid_table.h"

#include "base/errors.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
std::vector<double> ascending(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t place_in(const std::vector<double> &axis, const double value)
{
  return static_cast<std::size_t>(std::lower_bound(axis.begin(), axis.end(), value) -
                                  axis.begin());
}

/** "slip rate" from "slip rate [m/s]". */
std::string quantity_of(const std::string &heading)
{
  return heading.substr(0, heading.find(" ["));
}

/** "slip rate = 2 m/s" from "slip rate [m/s]". */
std::string pair_text(const std::string &heading, const double value)
{
  const std::string unit = heading.substr(heading.find('[') + 1);
  return quantity_of(heading) + " = " + to_text(value) + " " +
         unit.substr(0, unit.size() - 1);
}
} // namespace

GridTable grid_table(const CsvTable &table,
                     const std::string &first,
                     const std::string &second,
                     const std::string &value)
{
  const std::vector<double> along_first = table.numbers(first),
                            found       = table.numbers(value);
  const bool by_second                  = table.has_column(second);
  const std::vector<double> along_second =
    by_second ? table.numbers(second) : std::vector<double>(table.n_rows(), 0.);
  if (table.n_rows() == 0)
    throw UserError(table.file() + " has no row; give at least one " +
                    quantity_of(first) + " with its " + quantity_of(value));
  GridTable grid{ascending(along_first), ascending(along_second), {}};
  const std::size_t m = grid.second.size();
  std::vector<std::size_t> places;
  for (std::size_t row = 0; row < table.n_rows(); ++row)
    places.push_back(place_in(grid.first, along_first[row]) * m +
                     place_in(grid.second, along_second[row]));
  if (grid.first.size() * m > places.size())
    {
      std::sort(places.begin(), places.end());
      places.erase(std::unique(places.begin(), places.end()), places.end());
      std::size_t k = 0;
      while (k < places.size() && places[k] == k)
        ++k;
      throw UserError(
        table.file() + " has no row with " + pair_text(first, grid.first[k / m]) +
        " and " + pair_text(second, grid.second[k % m]) + "; each " + quantity_of(first) +
        " needs a " + quantity_of(value) + " for each " + quantity_of(second));
    }
  grid.values.assign(grid.first.size() * m, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < table.n_rows(); ++row)
    {
      double &entry = grid.values[places[row]];
      if (!std::isnan(entry))
        table.fail(row, "there is a row with this " + quantity_of(first) +
                          (by_second ? " and " + quantity_of(second) : std::string()) +
                          " before; remove one");
      entry = found[row];
    }
  return grid;
}
} // namespace mesoslip
