#include "sliding/supports/mesh_side.h"

#include "material/shear_impedance.h"
#include "sliding/mesh/body_mesh.h"
#include "sliding/supports/side_platen.h"

#include <array>
#include <map>

namespace mesoslip
{
namespace
{
/** Sums over the faces around a point. */
template <int dim>
struct PointSums
{
  double area = 0.;                           ///< m^2, in 2D m
  dealii::Tensor<1, dim> push;                ///< along the normal into the body
  Eigen::Matrix<double, dim, dim> impedance = ///< times the area
    Eigen::Matrix<double, dim, dim>::Zero();
};

template <int dim>
Eigen::Matrix<double, dim, dim> impedance_of(const Phase<dim> &phase,
                                             const dealii::Tensor<1, dim> &normal)
{
  Eigen::Matrix<double, dim, 1> n;
  for (unsigned int d = 0; d < dim; ++d)
    n[d] = normal[d];
  return impedance<dim>(phase.stiffness, phase.density, n);
}
} // namespace

template <int dim>
MeshSide mesh_side(const BodyMesh<dim> &morphology,
                   const std::vector<BoundaryFace<dim>> &faces,
                   const bool absorbing)
{
  const Mesh<dim> &mesh                   = morphology.mesh;
  const std::vector<Phase<dim>> materials = morphology.materials();
  std::map<unsigned int, PointSums<dim>> sums;
  for (const BoundaryFace<dim> &face : faces)
    {
      const BoundaryPoints<dim> found = boundary_points<dim>(mesh, {face});
      for (std::size_t k = 0; k < found.points.size(); ++k)
        {
          const dealii::Tensor<1, dim> &normal_area = found.normal_area[k];
          const double area                         = normal_area.norm();
          PointSums<dim> &sum                       = sums[mesh.master(found.points[k])];
          sum.area += area;
          sum.push -= normal_area;
          if (absorbing && area > 0.)
            sum.impedance +=
              area * impedance_of(materials[mesh.cells[face.cell].material_id],
                                  normal_area / area);
        }
    }
  MeshSide side;
  side.nodes.impedance.resize(absorbing ? dim * dim : 0);
  for (const auto &[point, sum] : sums)
    {
      side.points.push_back(point);
      side.nodes.area.push_back(sum.area);
      for (unsigned int c = 0; c < dim; ++c)
        {
          side.nodes.push[c].push_back(sum.push[c]);
          side.nodes.position[c].push_back(mesh.points[point][c]);
        }
      for (std::size_t m = 0; m < side.nodes.impedance.size(); ++m)
        side.nodes.impedance[m].push_back(sum.impedance(m / dim, m % dim) / sum.area);
    }
  return side;
}

void MeshSide::keep_for_platen(const std::set<unsigned int> &others,
                               const SideSupport &support)
{
  std::vector<bool> own;
  for (const unsigned int point : points)
    own.push_back(others.count(point) == 0);
  carry_whole_side(nodes, own, support);
  std::vector<unsigned int> kept, numbers;
  for (unsigned int k = 0; k < points.size(); ++k)
    if (own[k])
      {
        kept.push_back(points[k]);
        numbers.push_back(k);
      }
  points = kept;
  nodes  = nodes.at(numbers);
}

template MeshSide
mesh_side(const BodyMesh<2> &, const std::vector<BoundaryFace<2>> &, const bool);
template MeshSide
mesh_side(const BodyMesh<3> &, const std::vector<BoundaryFace<3>> &, const bool);
} // namespace mesoslip
