#include "sliding/mesh/statics/mesh_pressures.h"

#include "mesh/boundary.h"
#include "mesh/cell_gradients.h"

#include <algorithm>
#include <numeric>

namespace mesoslip
{
namespace
{
/** Mean strain of a cell. */
template <int dim>
VoigtVector<dim> mean_strain(const Mesh<dim> &mesh,
                             const std::vector<unsigned int> &corners,
                             const NodalField<double> &u)
{
  const auto gradients    = integrated_gradients(mesh, corners);
  VoigtVector<dim> strain = VoigtVector<dim>::Zero();
  for (std::size_t v = 0; v < corners.size(); ++v)
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        strain[voigt_index<dim>(c, d)] += gradients[v][d] * u(c, {corners[v], 0});
  return strain / cell_measure(mesh, corners).volume;
}
} // namespace

template <int dim>
PhasePressures mesh_phase_pressures(const MeshMorphology<dim> &morphology,
                                    const ContactParameters &parameters,
                                    const NodalField<double> &u,
                                    const double normal_force)
{
  const Mesh<dim> &mesh = morphology.mesh;
  const auto group      = std::find(mesh.boundaries.begin(), mesh.boundaries.end(),
                                    parameters.mesh.contact_boundary);
  std::vector<double> area(morphology.phases.size()), force(area.size());
  const std::vector<Phase<dim>> materials = morphology.materials();
  for (const BoundaryFace<dim> &face :
       faces_of_group(mesh, boundary_faces(mesh),
                      static_cast<unsigned int>(group - mesh.boundaries.begin())))
    {
      const auto &cell               = mesh.cells[face.cell];
      const VoigtVector<dim> strain  = mean_strain(mesh, cell.vertices, u);
      const VoigtMatrix<dim> &D      = materials[cell.material_id].stiffness;
      const unsigned int phase       = morphology.phase_of(cell.material_id);
      const double pressure          = -D.row(dim - 1).dot(strain);
      const BoundaryPoints<dim> here = boundary_points<dim>(mesh, {face});
      for (const auto &of_point : here.normal_area)
        {
          area[phase] -= of_point[dim - 1];
          force[phase] -= of_point[dim - 1] * pressure;
        }
    }
  const double total = std::accumulate(area.begin(), area.end(), 0.);
  for (std::size_t p = 0; p < area.size(); ++p)
    {
      area[p] /= total;
      force[p] /= total;
    }
  return phase_pressures<dim>(parameters, morphology.phases, area, force,
                              normal_force / total);
}

template PhasePressures mesh_phase_pressures(const MeshMorphology<2> &,
                                             const ContactParameters &,
                                             const NodalField<double> &,
                                             const double);
template PhasePressures mesh_phase_pressures(const MeshMorphology<3> &,
                                             const ContactParameters &,
                                             const NodalField<double> &,
                                             const double);
} // namespace mesoslip
