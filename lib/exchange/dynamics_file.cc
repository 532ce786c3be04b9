#include "exchange/dynamics_file.h"

#include "base/digest.h"
#include "base/errors.h"
#include "exchange/datasets.h"
#include "parameters/parameters.h"

#include <cmath>

namespace mesoslip
{
namespace
{
constexpr int newest_dynamics_version = 1;

const char dynamics_program[] = "contact_dynamics";
const char snapshots_name[]   = "/snapshots/displacement";
const char phases_name[]      = "/material/phase_id";

const char snapshot_hint[] =
  "fields, the mean strain and further probes need it: run contact_dynamics with "
  "Snapshots/Interval > 0";
const char file_hint[] = "contact_dynamics writes such a file";
const char probe_hint[] =
  "name it in Observation/Probes of the contact_dynamics run, or give its position here";

std::string digest_of(const BodyDescription &body)
{
  Digest digest;
  digest.add(body.rve_digest);
  for (unsigned int d = 0; d < 2; ++d)
    digest.add(body.grid.cells[d]).add(body.grid.spacing[d]);
  for (const Phase<2> &phase : body.phases)
    {
      for (int k = 0; k < phase.stiffness.size(); ++k)
        digest.add(phase.stiffness.data()[k]);
      digest.add(phase.density);
    }
  digest.add(std::string(body.phase_id.begin(), body.phase_id.end()));
  return digest.hex();
}
} // namespace

IndexRange entries_in(const std::vector<double> &times, const TimeWindow &window)
{
  // Not scaled by an end at infinity.
  const auto slack = [](const double t) { return std::isfinite(t) ? 1e-9 * t : 0.; };
  if (!(window.begin <= window.end))
    return {};
  const auto from = std::lower_bound(times.begin(), times.end(),
                                     window.begin - std::fabs(slack(window.begin)));
  const auto to =
    std::upper_bound(from, times.end(), window.end + std::fabs(slack(window.end)));
  return {static_cast<std::size_t>(from - times.begin()),
          static_cast<std::size_t>(to - from)};
}

Shape nodes_shape(const UniformGrid<2> &grid)
{
  return {std::size_t(grid.cells[1]) + 1, std::size_t(grid.cells[0]) + 1, 2};
}

std::vector<double> interleaved(const NodalField<double> &u)
{
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(u.n_components()) * u.n_columns() * u.n_rows());
  for (unsigned int j = 0; j < u.n_rows(); ++j)
    for (unsigned int i = 0; i < u.n_columns(); ++i)
      for (unsigned int c = 0; c < u.n_components(); ++c)
        values.push_back(u.row(c, j)[i]);
  return values;
}

DynamicsFile DynamicsFile::create(const std::string &path,
                                  const BodyDescription &body,
                                  const std::string &format)
{
  DynamicsFile file(Hdf5File::create(path));
  file.grid = body.grid;
  file.write_header(format, newest_dynamics_version, 2, digest_of(body));
  write_grid(file, body.grid);
  write_phases(file, "/material", body.phases, false);
  file.write_attribute("/material", "rve_digest", body.rve_digest);
  if (!body.phase_id.empty())
    write_dataset(file, phases_name, {body.grid.cells[1], body.grid.cells[0]},
                  body.phase_id);
  return file;
}

DynamicsFile DynamicsFile::resume(const std::string &path, const std::size_t n_snapshots)
{
  const std::string remedy = "start again without --resume";
  DynamicsFile file(Hdf5File::resume(path, remedy));
  if (n_snapshots > 0 && file.shape(snapshots_name, remedy)[0] < n_snapshots)
    throw UserError(path + " has fewer than the " + std::to_string(n_snapshots) +
                    " snapshots it had at the checkpoint; " + remedy);
  file.grid = read_grid<2>(file, dynamics_program);
  for (const std::string &name : file.list("/"))
    if (name != "grid" && name != "material" && name != "snapshots" &&
        name != "contact_map")
      file.remove("/" + name);
  return file;
}

DynamicsFile DynamicsFile::open(const std::string &path, const std::string &hint)
{
  DynamicsFile file(Hdf5File::open(path, hint));
  file.digest =
    file.check_header("mesoslip-dynamics", newest_dynamics_version, 2, file_hint);
  file.grid       = read_grid<2>(file, dynamics_program);
  file.conditions = read_run_conditions(file);
  return file;
}

Shape DynamicsFile::snapshot_shape(const std::size_t n) const
{
  Shape shape = nodes_shape(grid);
  shape.insert(shape.begin(), n);
  return shape;
}

void DynamicsFile::reserve_snapshots(const std::size_t n)
{
  reserve_rows(snapshots_name, snapshot_shape(n));
}

void DynamicsFile::write_snapshot(const std::size_t k, const NodalField<double> &u)
{
  write_row(snapshots_name, k, interleaved(u));
}

void DynamicsFile::complete_snapshots(const std::vector<double> &times)
{
  write_dataset(*this, "/snapshots/time", {times.size()}, times, "s");
  write_unit(snapshots_name, "m");
  if (!times.empty())
    show({{"displacement", snapshots_name, XdmfField::Values::nodes, {2}}}, times);
}

void DynamicsFile::show(const std::vector<XdmfField> &series,
                        const std::vector<double> &times) const
{
  const std::string name   = path().substr(path().rfind('/') + 1);
  const std::string prefix = path().substr(0, path().rfind('.'));
  write_xdmf(prefix + ".xdmf", name, grid, series, times);
  if (exists(phases_name))
    write_xdmf(prefix + "-phases.xdmf", name, grid,
               {{"phase", phases_name, XdmfField::Values::phases}});
}

std::string DynamicsFile::rve_digest() const
{
  return has_attribute("/material", "rve_digest")
           ? read_attribute<std::string>("/material", "rve_digest")
           : "";
}

std::vector<std::uint8_t> DynamicsFile::phase_id() const
{
  return exists(phases_name)
           ? read<std::uint8_t>(phases_name, {grid.cells[1], grid.cells[0]})
           : std::vector<std::uint8_t>();
}

BodyDescription DynamicsFile::heterogeneous_body() const
{
  BodyDescription body;
  body.grid     = grid;
  body.phases   = read_phases<2>(*this, "/material", false, dynamics_program);
  body.phase_id = phase_id();
  if (body.phase_id.empty())
    throw UserError(path() + " has no " + phases_name +
                    ", as its body is homogeneous; name the run of a heterogeneous one");
  require_phases(*this, phases_name, body.phase_id, body.phases.size(), dynamics_program);
  body.node_friction = read<double>("/contact/friction_coefficient",
                                    {grid.cells[0] + std::size_t(1)}, file_hint);
  body.rve_digest    = rve_digest();
  return body;
}

bool DynamicsFile::has_snapshots() const
{
  return exists(snapshots_name);
}

std::vector<double> DynamicsFile::ascending_times(const std::string &dataset,
                                                  const std::string &hint) const
{
  const auto times = read<double>(dataset, {any_extent}, hint);
  require_unit(dataset, "s");
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k] > times[k - 1]))
      throw UserError(path() + ": " + dataset + " does not increase from entry " +
                      std::to_string(k - 1) + " (" + to_text(times[k - 1]) +
                      " s) to the next (" + to_text(times[k]) +
                      " s); run contact_dynamics again");
  return times;
}

std::vector<double> DynamicsFile::snapshot_times() const
{
  const Shape found    = shape(snapshots_name, snapshot_hint);
  const auto times     = ascending_times("/snapshots/time", snapshot_hint);
  const Shape expected = snapshot_shape(times.size());
  if (found != expected)
    throw UserError(path() + ": " + snapshots_name + " has the shape " + to_text(found) +
                    " instead of " + to_text(expected) +
                    ", which its times and /grid ask for");
  require_unit(snapshots_name, "m");
  return times;
}

std::vector<double> DynamicsFile::snapshots(const std::size_t first,
                                            const std::size_t count) const
{
  return read_block<double>(snapshots_name, {first, 0, 0, 0}, snapshot_shape(count),
                            snapshot_hint);
}

std::vector<std::string> DynamicsFile::probes() const
{
  return exists("/probes") ? list("/probes") : std::vector<std::string>();
}

std::array<double, 2> DynamicsFile::probe_position(const std::string &name) const
{
  return read_attribute<std::array<double, 2>>("/probes/" + name, "position", probe_hint);
}

ProbeSeries DynamicsFile::probe(const std::string &name,
                                const std::string &quantity,
                                const TimeWindow &window) const
{
  const std::string group = "/probes/" + name;
  ProbeSeries series;
  series.time            = ascending_times(group + "/time", probe_hint);
  const std::string data = group + "/" + quantity;
  const Shape expected   = {series.time.size(), 3};
  if (const Shape found = shape(data, probe_hint); found != expected)
    throw UserError(path() + ": " + data + " has the shape " + to_text(found) +
                    " instead of " + to_text(expected) + "; run contact_dynamics again");
  require_unit(data, quantity == "stress" ? "Pa" : "-");
  const IndexRange range = entries_in(series.time, window);
  series.values          = read_block<double>(data, {range.first, 0}, {range.count, 3});
  const auto begin       = series.time.begin() + static_cast<std::ptrdiff_t>(range.first);
  series.time =
    std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(range.count));
  return series;
}
} // namespace mesoslip
