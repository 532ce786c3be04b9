#include "exchange/body_snapshots.h"

#include "base/errors.h"
#include "exchange/datasets.h"
#include "exchange/mesh_datasets.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
const char snapshots_program[] = "contact_dynamics";
const char displacement_name[] = "/snapshots/displacement";
const char snapshot_phases[]   = "/material/phase_id";
const char snapshots_hint[]    = "run contact_dynamics with Snapshots/Interval > 0";

template <int dim>
std::string check_body_header(const Hdf5File &file, const bool is_grid)
{
  return file.check_header(is_grid ? "mesoslip-dynamics" : "mesoslip-dynamics-mesh", 2,
                           dim, "contact_dynamics writes such a file");
}

std::string rve_digest_of(const Hdf5File &file)
{
  return file.has_attribute("/material", "rve_digest")
           ? file.read_attribute<std::string>("/material", "rve_digest")
           : "";
}
} // namespace

template <int dim>
BodySnapshots<dim>::BodySnapshots(Hdf5File &&opened)
  : file(std::move(opened))
  , is_grid(!file.exists("/mesh"))
  , digest(check_body_header<dim>(file, is_grid))
  , rve_digest(rve_digest_of(file))
  , phases(read_phases<dim>(file, "/material", false, snapshots_program))
  , materials(file, snapshot_phases, phases.size(), snapshots_program)
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

/** @throws UserError unless the fields have these extents, without the number of snapshots */
template <int dim>
void BodySnapshots<dim>::require_sizes(const Shape &cells,
                                       const Shape &displacement) const
{
  Shape expected = {times().size()};
  expected.insert(expected.end(), displacement.begin(), displacement.end());
  if ((!materials.shape.empty() && materials.shape != cells) ||
      file.shape(displacement_name, snapshots_hint) != expected)
    throw UserError(path() + ": phases or displacements are not those of the cells and "
                             "nodes of the body; run contact_dynamics again");
}

template <int dim>
std::vector<double> BodySnapshots<dim>::times() const
{
  auto times = file.read<double>("/snapshots/time", {any_extent}, snapshots_hint);
  file.require_unit("/snapshots/time", "s");
  if (times.empty() || !std::is_sorted(times.begin(), times.end()))
    throw UserError(path() + ": the times of /snapshots are " +
                    (times.empty() ? "missing" : "not ascending") + "; " +
                    snapshots_hint);
  return times;
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
std::vector<double> BodySnapshots<dim>::displacement(const std::size_t k,
                                                     const CellBlock<dim> &block) const
{
  if (block.n_cells() == 0)
    return {};
  Shape first = {k}, count = {1};
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

template class BodySnapshots<2>;
template class BodySnapshots<3>;
} // namespace mesoslip
