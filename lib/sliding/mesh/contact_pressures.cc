#include "base/object_exchange.h"
#include "mesh/boundary.h"
#include "mesh/cell_shapes.h"
#include "sliding/mesh/elastic_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace mesoslip
{
namespace
{
/** Displacements of mesh points by number. */
template <int dim>
using Displacements = std::map<unsigned int, std::array<double, dim>>;

/** Mean strain of a cell. */
template <int dim>
VoigtVector<dim> mean_strain(const Mesh<dim> &mesh,
                             const std::vector<unsigned int> &corners,
                             const Displacements<dim> &u)
{
  const auto gradients    = integrated_gradients(mesh, corners);
  VoigtVector<dim> strain = VoigtVector<dim>::Zero();
  for (std::size_t v = 0; v < corners.size(); ++v)
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        strain[voigt_index<dim>(c, d)] += gradients[v][d] * u.at(corners[v])[c];
  return strain / cell_measure(mesh, corners).volume;
}

/** Displacements of the corners of the cells behind these @p faces (on rank 0), by point
 * number in the mesh of rank 0. Collective. */
template <int dim>
Displacements<dim> displacements_behind(const std::vector<BoundaryFace<dim>> &faces,
                                        const BodyMesh<dim> &morphology,
                                        const PointBody<dim> &elastic,
                                        const NodalField<double> &u)
{
  std::set<unsigned int> corners;
  for (const BoundaryFace<dim> &face : faces)
    {
      const auto &vertices = morphology.mesh.cells[face.cell].vertices;
      corners.insert(vertices.begin(), vertices.end());
    }
  std::vector<unsigned int> points;
  for (const unsigned int corner : corners)
    points.push_back(morphology.whole_point(corner));
  broadcast_object(elastic.communicator(), points);
  const std::vector<double> values = elastic.values_at(points, u);
  Displacements<dim> result;
  auto value = values.begin();
  for (const unsigned int corner : corners)
    {
      std::copy_n(value, dim, result[corner].begin());
      value += dim;
    }
  return result;
}
} // namespace

template <int dim>
std::vector<ContactCell> cells_at_contact(const BodyMesh<dim> &morphology,
                                          const MeshBodyParameters &parameters,
                                          const PointBody<dim> &elastic,
                                          const NodalField<double> &u)
{
  const Mesh<dim> &mesh = morphology.mesh;
  std::vector<BoundaryFace<dim>> faces;
  if (!mesh.cells.empty())
    faces = group_faces(morphology, morphology.boundary(), "Mesh/Contact boundary",
                        parameters.contact_boundary);
  const auto behind = displacements_behind(faces, morphology, elastic, u);
  const std::vector<Phase<dim>> materials = morphology.materials();
  std::vector<ContactCell> found;
  for (const BoundaryFace<dim> &face : faces)
    {
      const auto &cell              = mesh.cells[face.cell];
      const VoigtVector<dim> strain = mean_strain<dim>(mesh, cell.vertices, behind);
      const VoigtMatrix<dim> &D     = materials[cell.material_id].stiffness;
      ContactCell &here             = found.emplace_back();
      here.phase                    = morphology.phase_of(cell.material_id);
      here.pressure                 = -D.row(dim - 1).dot(strain);
      for (const auto &of_point : boundary_points<dim>(mesh, {face}).normal_area)
        here.area -= of_point[dim - 1];
    }
  return found;
}

template std::vector<ContactCell> cells_at_contact(const BodyMesh<2> &,
                                                   const MeshBodyParameters &,
                                                   const PointBody<2> &,
                                                   const NodalField<double> &);
template std::vector<ContactCell> cells_at_contact(const BodyMesh<3> &,
                                                   const MeshBodyParameters &,
                                                   const PointBody<3> &,
                                                   const NodalField<double> &);
} // namespace mesoslip
