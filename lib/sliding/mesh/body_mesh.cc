#include "sliding/mesh/body_mesh.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "base/text.h"
#include "body/mesh/mesh_body.h"
#include "elasticity/element_operator.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"
#include "exchange/mesh_datasets.h"
#include "mesh/cell_quality.h"
#include "mesh/periodic_points.h"
#include "program/output_folder.h"

#include <algorithm>
#include <numeric>

namespace mesoslip
{
template <int dim>
BodyMemory BodyMesh<dim>::read(const ContactParameters &parameters,
                               const unsigned int n_here,
                               const unsigned int n_ranks)
{
  const MeshBodyParameters &given = parameters.mesh;
  static_cast<MeshMorphology<dim> &>(*this) =
    read_mesh<dim>(given.mesh, given.mesh.files[0], given.phases);
  const BodyMemory memory = memory_on_mesh(parameters, this->mesh);
  require_memory({memory.on_machine(n_here, n_ranks),
                  "take a coarser mesh, or divide it among more machines"});
  for (const std::string &line : join_periodic_sides(*this, given))
    this->description.push_back(line);
  return memory;
}

template <int dim>
std::vector<BoundaryFace<dim>>
BodyMesh<dim>::group(const std::vector<BoundaryFace<dim>> &faces,
                     const std::string &key,
                     const unsigned int group) const
{
  auto found            = faces_of_group(this->mesh, faces, group);
  const std::size_t all = n_faces_in_file(this->mesh, group);
  if (found.empty() || all > found.size())
    throw UserError(key + ": of the group '" + this->mesh.boundaries[group] + "' " +
                    std::to_string(all - found.size()) + " of " + std::to_string(all) +
                    " faces " + why_not_found(this->mesh, found, group));
  return found;
}

template <int dim>
double BodyMesh<dim>::smallest_edge() const
{
  return cell_quality(this->mesh).smallest_edge;
}

template <int dim>
double BodyMesh<dim>::mass(const double /*of_box*/) const
{
  const auto of_points =
    lumped_mass(this->mesh.points, this->mesh.cells,
                elastic_phases<dim>(materials(), MeanDilatation::never));
  return std::accumulate(of_points.begin(), of_points.end(), 0.);
}

template <int dim>
std::unique_ptr<DistributedBody<dim>>
BodyMesh<dim>::distribute(const std::vector<unsigned int> &contact,
                          const std::vector<MeshPlace> & /*probes*/,
                          const std::vector<ElasticPhase<dim>> &phases,
                          const InstructionSet isa,
                          const MPI_Comm communicator) const
{
  return distribute_mesh(this->mesh, contact, phases, isa, communicator);
}

template <int dim>
std::unique_ptr<PointBody<dim>>
BodyMesh<dim>::make_elastic(const MeshBodyParameters &parameters,
                            const std::string &contact,
                            const std::string &top,
                            const std::vector<ElasticPhase<dim>> &phases,
                            const MPI_Comm communicator,
                            const bool whole) const
{
  MeshBodyInput<dim> input;
  input.phases      = phases;
  input.periodicity = {!parameters.periodic[0].empty(), !parameters.periodic[1].empty()};
  input.contact_boundary = contact;
  input.top_boundary     = top;
  if (!whole)
    return MeshBody<dim>::divide(this->mesh, input, communicator);
  input.mesh = this->mesh;
  broadcast_object(communicator, input.mesh);
  return std::make_unique<MeshBody<dim>>(input, communicator);
}

template <int dim>
Deformation BodyMesh<dim>::deformation(const PointBody<dim> &elastic,
                                       const NodalField<double> &u) const
{
  const auto &body       = dynamic_cast<const MeshBody<dim> &>(elastic);
  const Mesh<dim> &local = body.local_mesh();
  return largest_deformation(local.points, local.cells, body.cell_numbers(), u,
                             body.communicator());
}

template <int dim>
void BodyMesh<dim>::write_cells(Hdf5File &file) const
{
  write_mesh(file, this->mesh);
  std::vector<std::uint8_t> phase_id;
  for (const auto &cell : this->mesh.cells)
    phase_id.push_back(static_cast<std::uint8_t>(cell.material_id));
  write_dataset(file, body_phases_dataset, {phase_id.size()}, phase_id);
}

template <int dim>
void BodyMesh<dim>::show(const std::string &path,
                         const std::vector<XdmfField> &fields,
                         const std::vector<double> &times) const
{
  show_file(path, this->mesh, fields, times,
            {{"phase", body_phases_dataset, XdmfField::Values::phases, {}}});
}

template <int dim>
std::vector<BoundaryFace<dim>> group_faces(const BodyMesh<dim> &body,
                                           const std::vector<BoundaryFace<dim>> &faces,
                                           const std::string &key,
                                           const std::string &name)
{
  const std::vector<std::string> &names = body.mesh.boundaries;
  const auto found                      = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw UserError(
      key + ": '" + name + "' is no physical group of " +
      (dim == 2 ? "curves" : "surfaces") + " in " + body.file +
      (names.empty() ? ", which has none" : "; there are " + to_text(names)) +
      "; name one there, or here");
  return body.group(faces, key, static_cast<unsigned int>(found - names.begin()));
}

template <int dim>
std::vector<std::string> join_periodic_sides(BodyMesh<dim> &body,
                                             const MeshBodyParameters &parameters)
{
  std::vector<std::string> lines;
  if (parameters.periodic[0].empty() && parameters.periodic[1].empty())
    return lines;
  const auto faces = body.boundary();
  for (unsigned int axis = 0; axis + 1 < dim; ++axis)
    if (const auto &groups = parameters.periodic[axis]; !groups.empty())
      {
        const std::string key = std::string("Mesh/Periodic in ") + "xy"[axis];
        const auto sides = join_sides(body.mesh, group_faces(body, faces, key, groups[0]),
                                      group_faces(body, faces, key, groups[1]), axis,
                                      body.smallest_edge());
        lines.push_back(key.substr(5) + ": " + opposite_text(sides));
      }
  return lines;
}

#define MESOSLIP_INSTANTIATE(dim)                                                       \
  template class BodyMesh<dim>;                                                         \
  template std::vector<BoundaryFace<dim>> group_faces(                                  \
    const BodyMesh<dim> &, const std::vector<BoundaryFace<dim>> &, const std::string &, \
    const std::string &);                                                               \
  template std::vector<std::string> join_periodic_sides(BodyMesh<dim> &,                \
                                                        const MeshBodyParameters &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
