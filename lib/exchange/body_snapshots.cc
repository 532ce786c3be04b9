#include "exchange/body_snapshots.h"

#include "base/errors.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"
#include "exchange/mesh_datasets.h"
#include "parameters/parameters.h"

namespace mesoslip
{
namespace
{
const char snapshots_program[] = "contact_dynamics";
const char displacement_name[] = "/snapshots/displacement";
const char snapshots_hint[] =
  "fields, the mean strain and further probes need it: run contact_dynamics with "
  "Snapshots/Interval > 0";
const char probe_hint[] =
  "name it in Observation/Probes of the contact_dynamics run, or give its position here";
} // namespace

template <int dim>
BodySnapshots<dim>::BodySnapshots(Hdf5File &&opened)
  : file(std::move(opened))
  , is_grid(!file.exists("/mesh"))
  , digest(check_dynamics_header(file, dim))
  , rve_digest(body_rve_digest(file))
  , phases(read_phases<dim>(file, "/material", false, snapshots_program))
  , materials(file, body_phases_dataset, phases.size(), snapshots_program)
  , grid(is_grid ? read_grid<dim>(file, snapshots_program) : UniformGrid<dim>())
  , conditions(read_run_conditions(file))
{
  if (!is_grid)
    return;
  Shape nodes = shape_of_cells(grid);
  for (std::size_t &n : nodes)
    ++n;
  nodes.push_back(dim);
  require_sizes(shape_of_cells(grid), nodes);
}

/**
 * Checks the sizes of the fields, except the number of snapshots. @throws UserError if
 * they differ
 */
template <int dim>
void BodySnapshots<dim>::require_sizes(const Shape &cells,
                                       const Shape &displacement) const
{
  const auto check = [this](const char *dataset, const Shape &found,
                            const Shape &expected) {
    if (found != expected)
      throw UserError(path() + ": " + dataset + " has the shape " + to_text(found) +
                      " instead of " + to_text(expected) +
                      ", which the cells and nodes of the body and the times of its "
                      "snapshots ask for; run contact_dynamics again");
  };
  if (!materials.shape.empty())
    check(body_phases_dataset, materials.shape, cells);
  if (!has_snapshots())
    return;
  Shape expected = {times().size()};
  expected.insert(expected.end(), displacement.begin(), displacement.end());
  check(displacement_name, file.shape(displacement_name, snapshots_hint), expected);
  file.require_unit(displacement_name, "m");
}

template <int dim>
bool BodySnapshots<dim>::has_snapshots() const
{
  return file.exists(displacement_name);
}

template <int dim>
std::vector<double> BodySnapshots<dim>::ascending_times(const std::string &dataset,
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

template <int dim>
std::vector<double> BodySnapshots<dim>::times() const
{
  file.shape(displacement_name, snapshots_hint); // throws if there are none
  return ascending_times("/snapshots/time", snapshots_hint);
}

template <int dim>
std::size_t BodySnapshots<dim>::n_points() const
{
  return file.shape(displacement_name, snapshots_hint).at(1);
}

template <int dim>
std::vector<double> BodySnapshots<dim>::displacement(const std::size_t k,
                                                     const std::size_t first,
                                                     const std::size_t count) const
{
  return file.read_block<double>(displacement_name, {k, first, 0}, {1, count, dim},
                                 snapshots_hint);
}

template <int dim>
std::vector<double> BodySnapshots<dim>::displacement(const IndexRange &snapshots,
                                                     const CellBlock<dim> &block) const
{
  if (block.n_cells() == 0)
    return {};
  Shape first = {snapshots.first}, count = {snapshots.count};
  for (unsigned int d = dim; d-- > 0;)
    {
      first.push_back(block.first[d]);
      count.push_back(block.cells[d] + std::size_t{1});
    }
  first.push_back(0);
  count.push_back(dim);
  return file.read_block<double>(displacement_name, first, count, snapshots_hint);
}

template <int dim>
Mesh<dim> BodySnapshots<dim>::mesh() const
{
  Mesh<dim> mesh = read_mesh_cells<dim>(file, snapshots_program);
  require_sizes({mesh.cells.size()}, {mesh.points.size(), dim});
  return mesh;
}

template <int dim>
std::vector<std::uint16_t>
BodySnapshots<dim>::constituent_ids(const std::size_t first,
                                    const std::size_t count) const
{
  return materials.shape.empty() ? std::vector<std::uint16_t>(count)
                                 : materials.of_cells(file, first, count);
}

template <int dim>
std::vector<std::string> BodySnapshots<dim>::probes() const
{
  return file.exists("/probes") ? file.list("/probes") : std::vector<std::string>();
}

template <int dim>
std::vector<double> BodySnapshots<dim>::probe_position(const std::string &name) const
{
  const std::string group = "/probes/" + name;
  auto position = file.read_attribute<std::vector<double>>(group, "position", probe_hint);
  if (position.size() != dim)
    throw UserError(path() + ": the position of " + group + " has " +
                    std::to_string(position.size()) + " numbers instead of " +
                    std::to_string(dim) + "; run contact_dynamics again");
  return position;
}

template <int dim>
ProbeSeries BodySnapshots<dim>::probe(const std::string &name,
                                      const std::string &quantity,
                                      const TimeWindow &window) const
{
  constexpr std::size_t n = dim * (dim + 1) / 2;
  const std::string group = "/probes/" + name, data = group + "/" + quantity;
  const auto times     = ascending_times(group + "/time", probe_hint);
  const Shape expected = {times.size(), n}, found = file.shape(data, probe_hint);
  if (found != expected)
    throw UserError(path() + ": " + data + " has the shape " + to_text(found) +
                    " instead of " + to_text(expected) + "; run contact_dynamics again");
  file.require_unit(data, quantity == "stress" ? "Pa" : "-");
  const IndexRange range = entries_in(times, window);
  return {times_of(times, range),
          file.read_block<double>(data, {range.first, 0}, {range.count, n})};
}

template class BodySnapshots<2>;
template class BodySnapshots<3>;
} // namespace mesoslip
