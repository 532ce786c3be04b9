#include "body/rigid_motions.h"

#include "base/exchange.h"
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace mesoslip
{
template <int dim>
typename RigidMotions<dim>::Displacements
RigidMotions<dim>::at(const std::array<double, dim> &point) const
{
  Displacements motions = Displacements::Zero();
  motions.template leftCols<dim>().setIdentity();
  if constexpr (dim == 2)
    {
      // Lengths are relative to the width of the body, from its centre.
      const double width = body.extent(0);
      motions(0, 2)      = -(point[1] - 0.5 * body.extent(1)) / width;
      motions(1, 2)      = point[0] / width - 0.5;
    }
  else
    {
      const double size = std::hypot(body.extent(0), body.extent(1), body.extent(2));
      Eigen::Vector3d x;
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = (point[d] - 0.5 * body.extent(d)) / size;
      for (unsigned int d = 0; d < 3; ++d)
        motions.col(3 + d) = Eigen::Vector3d::Unit(d).cross(x);
    }
  return motions;
}

template <int dim>
typename RigidMotions<dim>::Hold
RigidMotions<dim>::hold_of(const DofMask &mask,
                           const std::vector<SpringEntry> &springs,
                           const std::vector<NodesAsOne> &as_one) const
{
  Hold own = Hold::Zero();
  // A rotation about a periodic axis is compatible with periodic sides.
  const Periodicity periodic = body.periodicity();
  for (int d = 0; d < n - dim && mpi::this_mpi_process(body.communicator()) == 0; ++d)
    if ((periodic.x && (dim == 2 || d != 0)) || (periodic.y && (dim == 2 || d != 1)))
      own(dim + d, dim + d) = 1.;
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      if (mask.bits({i, j}) != 0 && body.is_counted({i, j}))
        {
          const Displacements motions = at(body.point({i, j}));
          for (unsigned int c = 0; c < dim; ++c)
            if (mask.is_constrained(c, {i, j}))
              own += motions.row(c).transpose() * motions.row(c);
        }
  double stiffest = 0.;
  for (const SpringEntry &spring : springs)
    stiffest = std::max(stiffest, std::fabs(spring.stiffness));
  stiffest = mpi::max(stiffest, body.communicator());
  for (const SpringEntry &spring : springs)
    if (stiffest > 0. && body.is_counted(spring.node))
      {
        const Displacements motions = at(body.point(spring.node));
        own += motions.row(spring.c).transpose() * motions.row(spring.d) *
               (spring.stiffness / stiffest);
      }
  sum_over_ranks(own.data(), static_cast<std::size_t>(own.size()), body.communicator());
  for (const NodesAsOne &group : as_one)
    own += hold_of(group);
  return own;
}

template <int dim>
typename RigidMotions<dim>::Hold RigidMotions<dim>::hold_of(const NodesAsOne &group) const
{
  Hold squares     = Hold::Zero();
  Coefficients sum = Coefficients::Zero();
  double n_nodes   = 0.;
  for (const NodeIndex &node : group.nodes)
    if (body.is_counted(node))
      {
        const Coefficients row = at(body.point(node)).row(group.component);
        squares += row * row.transpose();
        sum += row;
        n_nodes += 1.;
      }
  sum_over_ranks(squares.data(), static_cast<std::size_t>(squares.size()),
                 body.communicator());
  sum_over_ranks(sum.data(), static_cast<std::size_t>(sum.size()), body.communicator());
  n_nodes = mpi::sum(n_nodes, body.communicator());
  return squares - sum * sum.transpose() / std::max(1., n_nodes);
}

template <int dim>
std::vector<typename RigidMotions<dim>::Coefficients>
RigidMotions<dim>::left_by(const Hold &hold)
{
  const Eigen::SelfAdjointEigenSolver<Hold> eigen(hold);
  std::vector<Coefficients> motions;
  for (int k = 0; k < n; ++k)
    if (!(eigen.eigenvalues()[k] > 1e-10 * std::max(1., eigen.eigenvalues()[n - 1])))
      motions.emplace_back(eigen.eigenvectors().col(k));
  return motions;
}

template <int dim>
std::vector<NodalField<double>>
free_rigid_motions(const ElasticBody<dim> &body,
                   const DofMask &mask,
                   const std::vector<SpringEntry> &springs,
                   const std::vector<NodesAsOne> &as_one)
{
  const RigidMotions<dim> rigid(body);
  const auto left = RigidMotions<dim>::left_by(rigid.hold_of(mask, springs, as_one));
  std::vector<NodalField<double>> result(left.size(), body.zero_field());
  for (unsigned int j = 0; j < body.n_rows() && !left.empty(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      {
        const auto motions = rigid.at(body.point({i, j}));
        for (std::size_t k = 0; k < left.size(); ++k)
          {
            const Eigen::Matrix<double, dim, 1> u = motions * left[k];
            for (unsigned int c = 0; c < dim; ++c)
              result[k].row(c, j)[i] = u[c];
          }
      }
  return result;
}

template <int dim>
bool can_move(const ElasticBody<dim> &body,
              const DofMask &mask,
              const std::vector<SpringEntry> &springs,
              const std::vector<NodesAsOne> &as_one)
{
  const RigidMotions<dim> rigid(body);
  return !RigidMotions<dim>::left_by(rigid.hold_of(mask, springs, as_one)).empty();
}

template class RigidMotions<2>;
template class RigidMotions<3>;
template std::vector<NodalField<double>>
free_rigid_motions(const ElasticBody<2> &,
                   const DofMask &,
                   const std::vector<SpringEntry> &,
                   const std::vector<NodesAsOne> &);
template std::vector<NodalField<double>>
free_rigid_motions(const ElasticBody<3> &,
                   const DofMask &,
                   const std::vector<SpringEntry> &,
                   const std::vector<NodesAsOne> &);
template bool can_move(const ElasticBody<2> &,
                       const DofMask &,
                       const std::vector<SpringEntry> &,
                       const std::vector<NodesAsOne> &);
template bool can_move(const ElasticBody<3> &,
                       const DofMask &,
                       const std::vector<SpringEntry> &,
                       const std::vector<NodesAsOne> &);
} // namespace mesoslip
