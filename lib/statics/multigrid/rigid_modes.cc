#include "statics/multigrid/rigid_modes.h"

#include <cmath>

namespace mesoslip::multigrid
{
RigidModes::RigidModes(const UniformMaterial &material, const DofMask &mask)
  : aspect(material.grid().spacing[1] / material.grid().spacing[0])
{
  const Periodicity periodic = material.periodicity();
  n_nodes = {{material.n_columns() - periodic.x, material.n_rows() - periodic.y}};
  for (unsigned int d = 0; d < 2; ++d)
    centre[d] = 0.5 * (n_nodes[d] - 1);

  // Measured by the size of the grid, motions are vectors of comparable components.
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

void RigidModes::remove_from(NodalField<double> &field) const
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
} // namespace mesoslip::multigrid
