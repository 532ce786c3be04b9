#include "sliding/sweep/sweep_output.h"

#include "exchange/datasets.h"
#include "io/table.h"

#include <cstdint>
#include <set>

namespace mesoslip
{
namespace
{
/** SI symbols of the numbers in summary.json, which stores none; numbers not listed are
 * pure. */
std::string unit_of_number(std::string name, const unsigned int dim)
{
  const std::string of_modes = "complex_modes.";
  if (name.rfind(of_modes, 0) == 0)
    name = name.substr(of_modes.size());
  if (name.rfind("supports.", 0) == 0)
    name = name.substr(name.rfind('.') + 1) + " of a support";
  static const std::map<std::string, std::string> per_thickness = {
    {"friction_energy", "J"},
    {"global_interface_friction_load", "W"},
    {"platen_mass of a support", "kg"}};
  if (const auto found = per_thickness.find(name); found != per_thickness.end())
    return found->second + (dim == 2 ? "/m" : "");
  static const std::map<std::string, std::string> units = {
    {"time_step", "s"},
    {"critical_time_step", "s"},
    {"rayleigh_beta", "s"},
    {"rayleigh_alpha", "1/s"},
    {"simulated_time", "s"},
    {"pressure", "Pa"},
    {"flat_velocity", "m/s"},
    {"regularization_time", "s"},
    {"window_begin", "s"},
    {"window_end", "s"},
    {"steady_from", "s"},
    {"mean_contact_duration", "s"},
    {"main_frequency", "Hz"},
    {"reference_velocity_amplitude", "m/s"},
    {"pressure of a support", "Pa"},
    {"mass of a support", "kg/m^2"},
    {"largest_growth_rate", "1/s"},
    {"largest_growth_rate_counted", "1/s"},
    {"least_growth_rate", "1/s"},
    {"frequency_of_largest_growth", "Hz"},
    {"lowest_frequency", "Hz"},
    {"highest_frequency", "Hz"},
    {"nothing_grows_above", "Hz"},
    {"normal_stiffness", "Pa/m"},
    {"shear_impedance", "Pa s/m"},
    {"steepest_friction_fall", "Pa s/m"},
    {"bytes_of_factors", "B"}};
  const auto found = units.find(name);
  return found != units.end() ? found->second : "-";
}

/** Names of texts that differ between points and are not redundant with numbers. */
std::vector<std::string> names_of_texts(const SweepMap &map)
{
  std::map<std::string, std::set<std::string>> values;
  for (const SweepResult &result : map.results)
    if (result.status == SweepStatus::done || result.status == SweepStatus::skipped)
      for (const auto &[name, text] : result.texts)
        values[name].insert(text);
  std::vector<std::string> names;
  for (const auto &[name, texts] : values)
    if (name == "regime" ||
        (texts.size() > 1 && name.find("warning") == std::string::npos &&
         name != "limit_cycle"))
      names.push_back(name);
  return names;
}

std::string text_of(const SweepStatus status)
{
  return status == SweepStatus::done      ? "done"
         : status == SweepStatus::skipped ? "skipped"
         : status == SweepStatus::failed  ? "failed"
                                          : "not computed";
}

/** The number @p name of a point; NaN if it has none. */
double number_of(const SweepResult &result, const std::string &name)
{
  const auto found = result.numbers.find(name);
  return found != result.numbers.end() ? found->second
                                       : std::numeric_limits<double>::quiet_NaN();
}

std::string text_of(const SweepResult &result, const std::string &name)
{
  const auto found = result.texts.find(name);
  return found != result.texts.end() ? found->second : "";
}
} // namespace

std::vector<std::string> names_of_numbers(const SweepMap &map)
{
  std::set<std::string> names;
  for (const SweepResult &result : map.results)
    for (const auto &number : result.numbers)
      names.insert(number.first);
  return {names.begin(), names.end()};
}

namespace
{
/** Writes the group /border. */
void write_border(Hdf5File &file, const SweepMap &map)
{
  const std::size_t n = map.border->size();
  file.create_group("/border");
  std::vector<std::string> along;
  for (const BorderPoint &point : *map.border)
    along.push_back(map.parameters.axes[point.axis].name);
  file.write("/border/along", {n}, along);
  for (std::size_t a = 0; a < map.parameters.axes.size(); ++a)
    {
      std::vector<double> values;
      for (const BorderPoint &point : *map.border)
        values.push_back(point.values[a]);
      write_dataset(file, "/border/" + map.parameters.axes[a].name, {n}, values,
                    map.units[a]);
    }
  file.write_attribute("/border", "tolerance", map.parameters.border_tolerance);
}

/** Headings of the columns of the axes. */
std::vector<std::string> columns_of_axes(const SweepMap &map)
{
  std::vector<std::string> columns;
  for (std::size_t a = 0; a < map.parameters.axes.size(); ++a)
    columns.push_back(map.parameters.axes[a].name + " [" + map.units[a] + "]");
  return columns;
}
} // namespace

void write_border_table(const std::string &path, const SweepMap &map)
{
  std::vector<std::string> columns = columns_of_axes(map);
  columns.emplace_back("along");
  TableWriter table(path, columns);
  for (const BorderPoint &point : *map.border)
    {
      std::vector<std::string> row;
      for (const double value : point.values)
        row.push_back(table.cell(value));
      row.push_back(map.parameters.axes[point.axis].name);
      table.add_row(row);
    }
  table.flush();
}

void write_map_file(const std::string &path, const SweepMap &map)
{
  Hdf5File file = Hdf5File::create(path);
  file.write_header("mesoslip-map", 1, 2, "");
  const std::size_t n = map.points.size();
  const auto of_all   = [&](const auto &value) {
    std::vector<std::decay_t<decltype(value(std::size_t{0}))>> all;
    for (std::size_t k = 0; k < n; ++k)
      all.push_back(value(k));
    return all;
  };
  std::vector<std::int64_t> shape;
  for (const std::size_t extent : map.parameters.shape())
    shape.push_back(static_cast<std::int64_t>(extent));
  file.create_group("/axes");
  file.write_attribute("/axes", "shape", shape);
  for (std::size_t a = 0; a < map.parameters.axes.size(); ++a)
    {
      const SweepAxis &axis  = map.parameters.axes[a];
      const std::string name = "/axes/" + axis.name;
      write_dataset(file, name, {n},
                    of_all([&](const std::size_t k) { return map.points[k].values[a]; }),
                    map.units[a]);
      file.write_attribute(name, "number", static_cast<int>(a));
      file.write_attribute(name, "keys", texts_of(axis.keys));
      file.write_attribute(name, "logarithmic", axis.logarithmic ? 1 : 0);
    }
  if (map.border)
    write_border(file, map);
  file.create_group("/numbers");
  for (const std::string &name : names_of_numbers(map))
    {
      const auto numbers =
        of_all([&](const std::size_t k) { return number_of(map.results[k], name); });
      std::vector<double> filled;
      std::vector<std::uint8_t> known;
      for (const double number : numbers)
        {
          known.push_back(number == number);
          filled.push_back(known.back() ? number : 0.);
        }
      write_dataset(file, "/numbers/" + name, {n}, filled, unit_of_number(name, map.dim));
      file.write("/known/" + name, {n}, known);
    }
  for (const std::string &name : names_of_texts(map))
    file.write("/texts/" + name, {n}, of_all([&](const std::size_t k) {
                 return text_of(map.results[k], name);
               }));
  file.write("/status", {n},
             of_all([&](const std::size_t k) { return text_of(map.results[k].status); }));
  file.write("/message", {n},
             of_all([&](const std::size_t k) { return map.results[k].message; }));
  file.write("/folder", {n},
             of_all([&](const std::size_t k) { return map.points[k].folder; }));
  file.close();
}

void write_map_table(const std::string &path, const SweepMap &map)
{
  const std::vector<std::string> numbers = names_of_numbers(map),
                                 texts   = names_of_texts(map);
  std::vector<std::string> columns       = columns_of_axes(map);
  columns.emplace_back("status");
  columns.insert(columns.end(), texts.begin(), texts.end());
  for (const std::string &name : numbers)
    columns.push_back(name + " [" + unit_of_number(name, map.dim) + "]");
  columns.insert(columns.end(), {"message", "folder"});
  TableWriter table(path, columns);
  for (std::size_t k = 0; k < map.points.size(); ++k)
    {
      const SweepResult &result = map.results[k];
      std::vector<std::string> row;
      for (const double value : map.points[k].values)
        row.push_back(table.cell(value));
      row.push_back(text_of(result.status));
      for (const std::string &name : texts)
        row.push_back(text_of(result, name));
      for (const std::string &name : numbers)
        row.push_back(table.cell(number_of(result, name)));
      row.insert(row.end(), {result.message, map.points[k].folder});
      table.add_row(row);
    }
  table.flush();
}
} // namespace mesoslip
