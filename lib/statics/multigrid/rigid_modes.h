#ifndef mesoslip_statics_multigrid_rigid_modes_h
#define mesoslip_statics_multigrid_rigid_modes_h

#include "elasticity/dof_mask.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <vector>

namespace mesoslip
{
/**
 * The rigid motions (a, b, r) in the plane, where a point (x, y) moves by (a - r y,
 * b + r x), that @p mask leaves: eigenvectors for the eigenvalue zero of the sum of m m^T
 * over all constrained components, with m = (1, 0, -y) or (0, 1, x). Place (node) gives
 * x and y, measured such that they are of order one.
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
 * The rigid motions that constrained degrees of freedom and periodic sides leave to a grid: the
 * null space of its stiffness. A motion (a, b, r) displaces a point by a - r y, b + r x,
 * with x and y from the middle of the grid in widths of a cell.
 */
class RigidModes
{
public:
  RigidModes() = default;

  /** Those of @p material that @p mask leaves. */
  RigidModes(const UniformMaterial &material, const DofMask &mask);

  /** Motions that are orthonormal as nodal vectors; none if nothing is free to move. */
  const std::vector<std::array<double, 3>> &modes() const
  {
    return orthonormal;
  }

  /** Removes the modes from a field (duplicates are not counted but corrected). */
  void remove_from(NodalField<double> &field) const;

  /** Position of node column @p i and row @p j in these coordinates. */
  double x(const double i) const
  {
    return i - centre[0];
  }

  /** Of row @p j. */
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
