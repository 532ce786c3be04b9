#include "sliding/mesh/sliding_mesh.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace mesoslip
{
namespace
{
SlidingSetup
on_mesh(SlidingSetup setup, const MeshBoundary &contact, const MeshBoundary &top)
{
  setup.contact.height = contact.height;
  setup.top.tributary  = top.area;
  AssertDimension(setup.contact.friction_coefficient.size(), contact.points.size());
  return setup;
}
} // namespace

template <int dim>
MeshBoundary mesh_boundary(const Mesh<dim> &mesh,
                           const std::vector<BoundaryFace<dim>> &faces)
{
  const BoundaryPoints<dim> found = boundary_points(mesh, faces);
  std::vector<std::size_t> order(found.points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto coordinates = [&](const std::size_t k) {
    const dealii::Point<dim> &p = mesh.points[found.points[k]];
    return std::vector<double>(p.begin_raw(), p.end_raw());
  };
  std::sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
    return coordinates(a) < coordinates(b);
  });
  MeshBoundary boundary;
  double lowest = std::numeric_limits<double>::infinity();
  for (const std::size_t k : order)
    {
      boundary.points.push_back(found.points[k]);
      boundary.area.push_back(found.normal_area[k][dim - 1]);
      boundary.height.push_back(mesh.points[found.points[k]][dim - 1]);
      lowest = std::min(lowest, boundary.height.back());
    }
  for (double &h : boundary.height)
    h -= lowest;
  return boundary;
}

template <int dim>
std::vector<double> mean_of_phases(const Mesh<dim> &mesh,
                                   const std::vector<BoundaryFace<dim>> &faces,
                                   const MeshBoundary &boundary,
                                   const std::vector<double> &property,
                                   const std::vector<double> &weight)
{
  std::unordered_map<unsigned int, std::array<double, 2>> sums;
  for (const BoundaryFace<dim> &face : faces)
    {
      const unsigned int phase          = mesh.cells[face.cell].material_id;
      const BoundaryPoints<dim> of_face = boundary_points<dim>(mesh, {face});
      for (std::size_t k = 0; k < of_face.points.size(); ++k)
        {
          const double share = weight[phase] * of_face.normal_area[k].norm();
          auto &sum          = sums[of_face.points[k]];
          sum[0] += share * property[phase];
          sum[1] += share;
        }
    }
  std::vector<double> means;
  for (const unsigned int point : boundary.points)
    means.push_back(sums.at(point)[0] / sums.at(point)[1]);
  return means;
}

template <int dim>
SlidingMesh<dim>::SlidingMesh(const MeshOperator<dim> &op,
                              const MeshBoundary &contact,
                              const MeshBoundary &top,
                              const std::vector<HeldComponent> &held,
                              const SlidingSetup &setup)
  : SlidingSurfaces<dim>(on_mesh(setup, contact, top),
                         static_cast<unsigned int>(top.points.size()))
  , u(static_cast<unsigned int>(op.part.points.size()), 1, dim)
  , w(u)
  , stepper(op, held, setup.step, u, w, top.points.at(0))
{
  stepper.add_surface(contact.points, this->contact);
  stepper.add_surface(top.points, this->top);
  if (setup.energy_interval > 0)
    energy =
      std::make_unique<EnergyAudit>(stepper, setup.top.platen_mass, setup.energy_interval,
                                    [this]() { return boundary_work(); });
}

template <int dim>
BoundaryWork SlidingMesh<dim>::boundary_work() const
{
  const bool counts = dealii::Utilities::MPI::this_mpi_process(stepper.communicator) == 0;
  return counts ? SlidingSurfaces<dim>::boundary_work() : BoundaryWork();
}

#define MESOSLIP_INSTANTIATE(dim)                                                    \
  template MeshBoundary mesh_boundary(const Mesh<dim> &,                             \
                                      const std::vector<BoundaryFace<dim>> &);       \
  template std::vector<double> mean_of_phases(                                       \
    const Mesh<dim> &, const std::vector<BoundaryFace<dim>> &, const MeshBoundary &, \
    const std::vector<double> &, const std::vector<double> &);                       \
  template class SlidingMesh<dim>;
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
