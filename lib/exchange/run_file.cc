#include "exchange/run_file.h"

#include "base/errors.h"
#include "exchange/rve_file.h"
#include "parameters/parameters.h"

namespace mesoslip
{
namespace
{
constexpr int newest_version = 1;

const char snapshot_hint[] =
  "fields, the mean strain and further probes need it: run contact_dynamics with "
  "Snapshots/Interval > 0";
const char file_hint[] = "contact_dynamics writes such a file";
const char probe_hint[] =
  "name it in Observation/Probes of the contact_dynamics run, or give its position here";
} // namespace

RunFile::RunFile(const std::string &path, const std::string &role)
  : file(Hdf5File::open(path, "the " + role + "; run contact_dynamics first"))
  , the_digest(file.check_header("mesoslip-dynamics", newest_version, 2, file_hint))
  , the_grid(read_grid(file, file_hint))
  , the_conditions(read_run_conditions(file))
{
}

std::string RunFile::rve_digest() const
{
  return file.exists("/material") && file.has_attribute("/material", "rve_digest")
           ? file.read_attribute<std::string>("/material", "rve_digest")
           : "";
}

std::vector<std::uint8_t> RunFile::phase_id() const
{
  if (!file.exists("/material/phase_id"))
    return {};
  return file.read<std::uint8_t>("/material/phase_id",
                                 {the_grid.cells[1], the_grid.cells[0]});
}

std::vector<double> RunFile::ascending_times(const std::string &dataset,
                                             const std::string &hint) const
{
  const auto times = file.read<double>(dataset, {any_extent}, hint);
  file.require_unit(dataset, "s");
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k] > times[k - 1]))
      throw UserError(path() + ": " + dataset + " does not increase from entry " +
                      std::to_string(k - 1) + " (" + to_text(times[k - 1]) +
                      " s) to the next (" + to_text(times[k]) +
                      " s); run contact_dynamics again");
  return times;
}

std::vector<double> RunFile::snapshot_times() const
{
  const Shape shape    = file.shape("/snapshots/displacement", snapshot_hint);
  const auto times     = ascending_times("/snapshots/time", snapshot_hint);
  const Shape expected = {times.size(), std::size_t(the_grid.cells[1]) + 1,
                          std::size_t(the_grid.cells[0]) + 1, 2};
  if (shape != expected)
    throw UserError(path() + ": /snapshots/displacement has the shape " + to_text(shape) +
                    " instead of " + to_text(expected) +
                    ", which its times and /grid ask for");
  file.require_unit("/snapshots/displacement", "m");
  return times;
}

std::vector<double> RunFile::snapshots(const std::size_t first,
                                       const std::size_t count) const
{
  const std::size_t nx = the_grid.cells[0], ny = the_grid.cells[1];
  return file.read_block<double>("/snapshots/displacement", {first, 0, 0, 0},
                                 {count, ny + 1, nx + 1, 2}, snapshot_hint);
}

std::vector<std::string> RunFile::probes() const
{
  return file.exists("/probes") ? file.list("/probes") : std::vector<std::string>();
}

std::array<double, 2> RunFile::probe_position(const std::string &name) const
{
  const auto position =
    file.read_attribute<std::vector<double>>("/probes/" + name, "position", probe_hint);
  if (position.size() != 2)
    throw UserError(path() + ": the position of the probe " + name +
                    " does not have two coordinates");
  return {{position[0], position[1]}};
}

ProbeSeries RunFile::probe(const std::string &name,
                           const std::string &quantity,
                           const TimeWindow &window) const
{
  const std::string group = "/probes/" + name;
  ProbeSeries series;
  series.time            = ascending_times(group + "/time", probe_hint);
  const std::string data = group + "/" + quantity;
  const Shape expected   = {series.time.size(), 3};
  if (const Shape shape = file.shape(data, probe_hint); shape != expected)
    throw UserError(path() + ": " + data + " has the shape " + to_text(shape) +
                    " instead of " + to_text(expected) + "; run contact_dynamics again");
  file.require_unit(data, quantity == "stress" ? "Pa" : "-");
  const IndexRange range = entries_in(series.time, window);
  series.values    = file.read_block<double>(data, {range.first, 0}, {range.count, 3});
  const auto begin = series.time.begin() + static_cast<std::ptrdiff_t>(range.first);
  series.time =
    std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(range.count));
  return series;
}
} // namespace mesoslip
