#ifndef mesoslip_elasticity_rigid_motions_h
#define mesoslip_elasticity_rigid_motions_h

#include <Eigen/Dense>

#include <algorithm>
#include <vector>

namespace mesoslip
{
/**
 * The rigid motions (a, b, r) in the plane that @p hold leaves, where a point (x, y)
 * moves by (a - r y, b + r x): eigenvectors of the eigenvalue zero. @p hold is the sum of
 * m m^T over all constrained components, with m = (1, 0, -y) or (0, 1, x) and lengths
 * measured such that x and y are of order one; what cannot rotate has 1 in the last
 * entry.
 */
inline std::vector<Eigen::Vector3d> motions_left_by(const Eigen::Matrix3d &hold)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(hold);
  std::vector<Eigen::Vector3d> motions;
  for (int k = 0; k < 3; ++k)
    if (!(eigen.eigenvalues()[k] > 1e-10 * std::max(1., eigen.eigenvalues()[2])))
      motions.emplace_back(eigen.eigenvectors().col(k));
  return motions;
}
} // namespace mesoslip

#endif
