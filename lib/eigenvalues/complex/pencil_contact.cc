#include "eigenvalues/complex/pencil_contact.h"

#include <cmath>

namespace mesoslip
{
namespace
{
using Triplet = Eigen::Triplet<double, std::int64_t>;

/**
 * Entry (@p c, @p d) of the derivative of a node's drag with respect to its tangential
 * velocity: instantaneous and delayed part.
 */
std::array<double, 2> drag_of(const SlidingNodesAtRest &contact,
                              const std::size_t k,
                              const std::array<double, 2> &direction,
                              const unsigned int c,
                              const unsigned int d,
                              const bool is_spatial)
{
  const FrictionSlopes slopes =
    contact.slopes.empty() ? FrictionSlopes() : contact.slopes[k];
  const double speed = std::hypot(contact.velocity[0], contact.velocity[1]),
               force = contact.normal_force[k], along = direction[c] * direction[d],
               across = is_spatial
                          ? contact.friction[k] / speed * ((c == d ? 1. : 0.) - along)
                          : 0.;
  return {{force * (slopes.rate * along + across), force * slopes.state * along}};
}

/**
 * Numbering of the friction forces: an index for each contact node and tangential axis,
 * -1 if the node does not move along it.
 */
template <int dim>
struct FrictionForces
{
  explicit FrictionForces(const ContactMotion<dim> &motion)
  {
    std::array<RealMatrix, dim> by_rows;
    for (unsigned int c = 0; c + 1 < dim; ++c)
      by_rows[c] = motion.relative[c].transpose();
    for (Eigen::Index k = 0; k < motion.relative[0].rows(); ++k)
      {
        std::array<std::int64_t, 2> &of_node = number.emplace_back();
        for (unsigned int c = 0; c + 1 < dim; ++c)
          {
            of_node[c] = -1;
            for (RealMatrix::InnerIterator entry(by_rows[c], k); entry; ++entry)
              {
                of_node[c] = n;
                slip.emplace_back(n, entry.row(), entry.value());
              }
            n += of_node[c] >= 0 ? 1 : 0;
          }
      }
  }

  std::vector<std::array<std::int64_t, 2>> number; ///< indices of the nodes' forces
  std::vector<Triplet> slip; ///< relative motion of contact nodes, by unknowns
  std::int64_t n = 0;        ///< number of friction forces
};
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
  const FrictionForces<dim> forces(motion);
  const double speed = std::hypot(contact.velocity[0], contact.velocity[1]);
  const std::array<double, 2> direction = {
    {contact.velocity[0] / speed, contact.velocity[1] / speed}};
  const std::size_t n_nodes = contact.nodes.size();
  std::vector<Triplet> by_reaction, by_approach, drag, late_drag;
  for (std::size_t k = 0; k < n_nodes; ++k)
    for (unsigned int c = 0; c + 1 < dim; ++c)
      {
        const std::int64_t q = forces.number[k][c];
        if (q < 0)
          continue;
        pencil.contact_nodes.push_back(k);
        const double slope    = contact.slopes.empty() ? 0. : contact.slopes[k].pressure,
                     coupling = (contact.friction[k] + slope) * direction[c];
        if (contact.stiffness.empty())
          by_reaction.emplace_back(q, k, coupling);
        else
          by_approach.emplace_back(q, k, -coupling * contact.stiffness[k]);
        for (unsigned int d = 0; d + 1 < dim && !contact.normal_force.empty(); ++d)
          if (const std::int64_t other = forces.number[k][d]; other >= 0)
            {
              const auto of = drag_of(contact, k, direction, c, d, dim == 3);
              drag.emplace_back(q, other, of[0]);
              late_drag.emplace_back(q, other, of[1]);
            }
      }
  const auto gather = [&](const std::size_t n_columns,
                          const std::vector<Triplet> &entries) {
    RealMatrix matrix(forces.n, static_cast<Eigen::Index>(n_columns));
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix.prune(0., 0.), matrix;
  };
  RealMatrix slip(forces.n, pencil.size());
  slip.setFromTriplets(forces.slip.begin(), forces.slip.end());
  const RealMatrix coupled =
                     gather(static_cast<std::size_t>(reactions[0].rows()), by_reaction),
                   E    = slip.transpose();
  pencil.targets        = coupled * reactions[0];
  pencil.damped_targets = coupled * reactions[1];
  pencil.spring_targets =
    coupled * reactions[2] + gather(n_nodes, by_approach) * motion.relative[dim - 1];
  const auto n_forces    = static_cast<std::size_t>(forces.n);
  pencil.drag_of_slip    = gather(n_forces, drag);
  pencil.drag            = pencil.drag_of_slip * slip;
  pencil.late_drag       = gather(n_forces, late_drag) * slip;
  pencil.distribution    = E;
  pencil.friction        = E * pencil.targets;
  pencil.spring_friction = E * pencil.spring_targets;
  pencil.damped_friction = E * pencil.damped_targets;
  pencil.resistance      = E * pencil.drag;
  pencil.late_resistance = E * pencil.late_drag;
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
