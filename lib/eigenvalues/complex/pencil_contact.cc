#include "eigenvalues/complex/pencil_contact.h"

#include <cmath>

namespace mesoslip
{
namespace
{
using Triplet = Eigen::Triplet<double, std::int64_t>;

/** Matrix from unknowns to the slip of each friction force: of all contact nodes along
 * @p direction and, in 3D, of all across it. */
template <int dim>
RealMatrix slip_of(const ContactMotion<dim> &motion,
                   const std::array<double, 2> &direction)
{
  const Eigen::Index n = motion.relative[0].rows(), n_forces = (dim - 1) * n;
  RealMatrix slip(n_forces, motion.relative[0].cols());
  for (unsigned int c = 0; c + 1 < dim; ++c)
    {
      const std::array<double, 2> turned = {
        {direction[c], c == 0 ? -direction[1] : direction[0]}};
      std::vector<Triplet> entries;
      for (Eigen::Index q = 0; q < n_forces; ++q)
        if (const double share = turned[static_cast<std::size_t>(q / n)]; share != 0.)
          entries.emplace_back(q, q % n, share);
      slip += matrix_of(n_forces, n, entries) * motion.relative[c];
    }
  return slip;
}

/** Rows of @p matrix times @p factors, without those that are zero. */
RealMatrix scaled(const Eigen::VectorXd &factors, const RealMatrix &matrix)
{
  RealMatrix result = factors.asDiagonal() * matrix;
  result.prune(0., 0.);
  return result;
}
} // namespace

template <int dim>
RealMatrix springs_of(const ContactMotion<dim> &motion, const SlidingNodesAtRest &contact)
{
  const RealMatrix &normal = motion.relative[dim - 1];
  if (contact.stiffness.empty())
    return {normal.cols(), normal.cols()};
  const Eigen::Map<const Eigen::VectorXd> stiffness(contact.stiffness.data(),
                                                    normal.rows());
  return RealMatrix(normal.transpose()) * (stiffness.asDiagonal() * normal);
}

template <int dim>
void add_contact(const ContactMotion<dim> &motion,
                 const std::array<RealMatrix, 3> &reactions,
                 const SlidingNodesAtRest &contact,
                 SlidingPencil &pencil)
{
  const double speed = std::hypot(contact.velocity[0], contact.velocity[1]);
  const RealMatrix slip =
    slip_of(motion, {{contact.velocity[0] / speed, contact.velocity[1] / speed}});
  const Eigen::Index n     = motion.relative[0].rows();
  pencil.n_along           = n;
  pencil.drag_of_slip      = Eigen::VectorXd::Zero(slip.rows());
  pencil.late_drag_of_slip = pencil.slack = pencil.drag_of_slip;
  std::vector<Triplet> by_reaction, by_approach;
  for (Eigen::Index q = 0; q < slip.rows(); ++q)
    {
      const auto k = static_cast<std::size_t>(q % n);
      pencil.contact_nodes.push_back(k);
      const FrictionSlopes slopes =
        contact.slopes.empty() ? FrictionSlopes() : contact.slopes[k];
      const double force  = contact.normal_force.empty() ? 0. : contact.normal_force[k];
      const bool is_along = q < n;
      pencil.drag_of_slip[q] =
        force * (is_along ? slopes.rate : contact.friction[k] / speed);
      pencil.late_drag_of_slip[q] = is_along ? force * slopes.state : 0.;
      pencil.slack[q]             = contact.slack.empty() ? 0. : contact.slack[k];
      if (const double coupling = contact.friction[k] + slopes.pressure;
          is_along && contact.stiffness.empty())
        by_reaction.emplace_back(q, q, coupling);
      else if (is_along)
        by_approach.emplace_back(q, q, -coupling * contact.stiffness[k]);
    }
  const RealMatrix coupled = matrix_of(slip.rows(), reactions[0].rows(), by_reaction);
  pencil.targets           = coupled * reactions[0];
  pencil.damped_targets    = coupled * reactions[1];
  pencil.spring_targets =
    coupled * reactions[2] +
    matrix_of(slip.rows(), n, by_approach) * motion.relative[dim - 1];
  pencil.drag         = scaled(pencil.drag_of_slip, slip);
  pencil.late_drag    = scaled(pencil.late_drag_of_slip, slip);
  pencil.distribution = slip.transpose();
}

template RealMatrix springs_of(const ContactMotion<2> &, const SlidingNodesAtRest &);
template RealMatrix springs_of(const ContactMotion<3> &, const SlidingNodesAtRest &);
template void add_contact(const ContactMotion<2> &,
                          const std::array<RealMatrix, 3> &,
                          const SlidingNodesAtRest &,
                          SlidingPencil &);
template void add_contact(const ContactMotion<3> &,
                          const std::array<RealMatrix, 3> &,
                          const SlidingNodesAtRest &,
                          SlidingPencil &);
} // namespace mesoslip
