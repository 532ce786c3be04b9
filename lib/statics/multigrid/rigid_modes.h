#ifndef mesoslip_statics_multigrid_rigid_modes_h
#define mesoslip_statics_multigrid_rigid_modes_h

#include "elasticity/dof_mask.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mesoslip
{
/**
 * The rigid motions (a, b, r) in the plane, with displacements (a - r y, b + r x), that
 * @p mask does not constrain: null space of the sum of m m^T over all constrained
 * components, with m = (1, 0, -y) or (0, 1, x). Place (node) gives x and y, scaled to
 * order one.
 */
template <typename Place>
std::vector<Eigen::Vector3d>
motions_left_by(const DofMask &mask, const bool can_rotate, const Place &place)
{
  Eigen::Matrix3d hold = Eigen::Matrix3d::Zero();
  if (!can_rotate)
    hold(2, 2) = 1.;
  for (unsigned int j = 0; j < mask.n_rows(); ++j)
    for (unsigned int i = 0; i < mask.n_columns(); ++i)
      {
        const auto [x, y] = place(NodeIndex{i, j});
        const Eigen::Vector3d u(1., 0., -y), v(0., 1., x);
        if (mask.is_constrained(0, {i, j}))
          hold += u * u.transpose();
        if (mask.is_constrained(1, {i, j}))
          hold += v * v.transpose();
      }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(hold);
  std::vector<Eigen::Vector3d> motions;
  for (int k = 0; k < 3; ++k)
    if (!(eigen.eigenvalues()[k] > 1e-10 * std::max(1., eigen.eigenvalues()[2])))
      motions.emplace_back(eigen.eigenvectors().col(k));
  return motions;
}
} // namespace mesoslip

namespace mesoslip::multigrid
{
/**
 * The rigid motions of a grid that remain with its constraints and periodic sides: the
 * null space of its stiffness. A motion (a, b, r) displaces a point by (a - r y, b + r
 * x), with x and y from the centre of the grid in cell widths.
 */
class RigidModes
{
public:
  RigidModes() = default;

  /** Rigid motions of @p material under the constraints @p mask. */
  RigidModes(const UniformMaterial &material, const DofMask &mask)
    : aspect(material.grid().spacing[1] / material.grid().spacing[0])
  {
    const Periodicity periodic = material.periodicity();
    n_nodes = {{material.n_columns() - periodic.x, material.n_rows() - periodic.y}};
    for (unsigned int d = 0; d < 2; ++d)
      centre[d] = 0.5 * (n_nodes[d] - 1);

    // Scaled by the size of the grid, so that components of the motions are comparable.
    const double size = std::hypot(n_nodes[0], n_nodes[1] * aspect);
    const auto place  = [&](const NodeIndex &node) {
      return std::array<double, 2>{{x(node.i) / size, y(node.j) / size}};
    };
    // x and y sum to zero over the nodes, so the three motions are orthogonal.
    const double n           = static_cast<double>(n_nodes[0]) * n_nodes[1];
    const auto second_moment = [](const double m) { return (m * m - 1.) / 12.; };
    const double moment =
      n * (second_moment(n_nodes[0]) + aspect * aspect * second_moment(n_nodes[1]));
    const Eigen::Vector3d norms(n, n, moment / (size * size));

    std::vector<Eigen::Vector3d> basis;
    for (Eigen::Vector3d mode : motions_left_by(mask, !periodic.x && !periodic.y, place))
      {
        for (const Eigen::Vector3d &other : basis)
          mode -= other * (other.cwiseProduct(norms).dot(mode));
        const double norm = std::sqrt(mode.cwiseProduct(norms).dot(mode));
        if (norm > 1e-8)
          basis.emplace_back(mode / norm);
      }
    for (const Eigen::Vector3d &mode : basis)
      orthonormal.push_back({{mode[0], mode[1], mode[2] / size}});
  }

  /** The remaining rigid motions, orthonormal as nodal vectors; empty if none remains. */
  const std::vector<std::array<double, 3>> &modes() const
  {
    return orthonormal;
  }

  /** Projects the modes out of a field (periodic copies are corrected, but do not enter
   * the projection). */
  void remove_from(NodalField<double> &field) const
  {
    if (orthonormal.empty())
      return;
    std::array<double, 3> sums = {};
    for (unsigned int j = 0; j < n_nodes[1]; ++j)
      {
        const double *u = field.row(0, j), *v = field.row(1, j);
        double su = 0., sv = 0., moment = 0.;
        for (unsigned int i = 0; i < n_nodes[0]; ++i)
          {
            su += u[i];
            sv += v[i];
            moment += x(i) * v[i];
          }
        sums[0] += su;
        sums[1] += sv;
        sums[2] += moment - y(j) * su;
      }
    std::array<double, 3> motion = {};
    for (const auto &mode : orthonormal)
      {
        const double share = mode[0] * sums[0] + mode[1] * sums[1] + mode[2] * sums[2];
        for (unsigned int k = 0; k < 3; ++k)
          motion[k] += share * mode[k];
      }
    for (unsigned int j = 0; j < field.n_rows(); ++j)
      {
        double *u = field.row(0, j), *v = field.row(1, j);
        for (unsigned int i = 0; i < field.n_columns(); ++i)
          {
            u[i] -= motion[0] - motion[2] * y(j);
            v[i] -= motion[1] + motion[2] * x(i);
          }
      }
  }

  /** x of node column @p i. */
  double x(const double i) const
  {
    return i - centre[0];
  }

  /** y of node row @p j. */
  double y(const double j) const
  {
    return (j - centre[1]) * aspect;
  }

private:
  std::array<unsigned int, 2> n_nodes = {};
  std::array<double, 2> centre        = {};
  double aspect                       = 1.;
  std::vector<std::array<double, 3>> orthonormal;
};
} // namespace mesoslip::multigrid

#endif
