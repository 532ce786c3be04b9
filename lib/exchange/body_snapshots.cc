#include "exchange/body_snapshots.h"

#include "base/errors.h"
#include "exchange/datasets.h"
#include "exchange/mesh_datasets.h"
#include "exchange/orientation_datasets.h"

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
BodySnapshots<dim>::BodySnapshots(const std::string &path, const std::string &hint)
  : BodySnapshots(Hdf5File::open(path, hint))
{
}

template <int dim>
BodySnapshots<dim>::BodySnapshots(const std::string &path, const MPI_Comm communicator)
  : BodySnapshots(Hdf5File::open_together(path, communicator))
{
}

template <int dim>
BodySnapshots<dim>::BodySnapshots(Hdf5File &&opened)
  : file(std::move(opened))
  , is_grid(!file.exists("/mesh"))
  , digest(check_body_header<dim>(file, is_grid))
  , rve_digest(rve_digest_of(file))
  , phases(read_phases<dim>(file, "/material", false, snapshots_program))
  , conditions(read_run_conditions(file))
{
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
std::vector<double> BodySnapshots<dim>::displacement(const std::size_t k) const
{
  return displacement(k, 0, rows_of_points()[0]);
}

template <int dim>
std::array<std::size_t, 2> BodySnapshots<dim>::rows_of_points() const
{
  const Shape shape = file.shape(displacement_name, snapshots_hint);
  std::size_t n     = 1;
  for (std::size_t axis = 2; axis + 1 < shape.size(); ++axis)
    n *= shape[axis];
  return {{shape.at(1), n}};
}

template <int dim>
std::vector<double> BodySnapshots<dim>::displacement(const std::size_t k,
                                                     const std::size_t first,
                                                     const std::size_t n_rows) const
{
  Shape count  = file.shape(displacement_name, snapshots_hint), offset(count.size(), 0);
  offset[0]    = k;
  offset.at(1) = first;
  count[0]     = 1;
  count.at(1)  = n_rows;
  return file.read_block<double>(displacement_name, offset, count, snapshots_hint);
}

template <int dim>
std::vector<Phase<dim>> BodySnapshots<dim>::materials() const
{
  return oriented_phases(
    phases,
    read_orientations(file, snapshot_phases, phases.size(), snapshots_program).materials);
}

template <int dim>
Mesh<dim> BodySnapshots<dim>::mesh() const
{
  Mesh<dim> mesh = is_grid ? mesh_of_cells(read_grid<dim>(file, snapshots_program))
                           : read_mesh_cells<dim>(file, snapshots_program);
  std::vector<std::uint8_t> id(mesh.cells.size());
  if (file.exists(snapshot_phases))
    id = file.read<std::uint8_t>(snapshot_phases);
  std::size_t n_values = 1;
  for (const std::size_t n : file.shape(displacement_name, snapshots_hint))
    n_values *= n;
  if (id.size() != mesh.cells.size() ||
      n_values != times().size() * dim * mesh.points.size())
    throw UserError(path() + ": phases or displacements are not those of the cells and "
                             "nodes of the body; run contact_dynamics again");
  require_phases(file, snapshot_phases, id, phases.size(), snapshots_program);
  for (std::size_t cell = 0; cell < id.size(); ++cell)
    mesh.cells[cell].material_id = id[cell];
  const Orientations turned =
    read_orientations(file, snapshot_phases, phases.size(), snapshots_program);
  for (std::size_t cell = 0; cell < turned.id.size(); ++cell)
    mesh.cells[cell].material_id = turned.id[cell];
  return mesh;
}

template class BodySnapshots<2>;
template class BodySnapshots<3>;
} // namespace mesoslip
