#include "base/errors.h"
#include "base/text.h"
#include "io/table.h"
#include "sliding/friction/slip_law_parameters.h"

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

/** @throws UserError if fewer rows, each in its @p place, than the axes have points */
void require_all(const FrictionTable::Points &points,
                 std::vector<std::size_t> place,
                 const std::string &path)
{
  const std::size_t m = points.pressure.size();
  if (points.slip_rate.size() * m <= place.size())
    return;
  std::sort(place.begin(), place.end());
  place.erase(std::unique(place.begin(), place.end()), place.end());
  std::size_t k = 0;
  while (k < place.size() && place[k] == k)
    ++k;
  throw UserError(path + " has no row with a slip rate of " +
                  to_text(points.slip_rate[k / m]) + " m/s and a pressure of " +
                  to_text(points.pressure[k % m]) +
                  " Pa; each slip rate needs a coefficient for each pressure");
}
} // namespace

FrictionTable::Points read_friction_table(const std::string &path)
{
  const CsvTable table               = CsvTable::read(path);
  const std::vector<double> rate     = table.numbers("slip rate [m/s]"),
                            value    = table.numbers("coefficient [-]");
  const bool by_pressure             = table.has_column("pressure [Pa]");
  const std::vector<double> pressing = by_pressure
                                         ? table.numbers("pressure [Pa]")
                                         : std::vector<double>(table.n_rows(), 0.);
  if (table.n_rows() == 0)
    throw UserError(path +
                    " has no row; give at least one slip rate with its coefficient");
  FrictionTable::Points points;
  points.slip_rate    = ascending(rate);
  points.pressure     = ascending(pressing);
  const std::size_t m = points.pressure.size();
  std::vector<std::size_t> place;
  for (std::size_t row = 0; row < table.n_rows(); ++row)
    place.push_back(place_in(points.slip_rate, rate[row]) * m +
                    place_in(points.pressure, pressing[row]));
  require_all(points, place, path);
  points.coefficient.assign(place.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < table.n_rows(); ++row)
    {
      for (const auto &[name, number] :
           {std::pair("slip rate", rate[row]), std::pair("coefficient", value[row]),
            std::pair("pressure", pressing[row])})
        if (number < 0.)
          table.fail(row, std::string("the ") + name + " is " + to_text(number) +
                            "; it must not be negative");
      double &entry = points.coefficient[place[row]];
      if (!std::isnan(entry))
        table.fail(row, "there is a row with this slip rate" +
                          std::string(by_pressure ? " and pressure" : "") +
                          " before; remove one");
      entry = value[row];
    }
  return points;
}
} // namespace mesoslip
