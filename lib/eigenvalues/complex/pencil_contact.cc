#include "eigenvalues/complex/pencil_contact.h"

#include <cmath>

namespace mesoslip
{
namespace
{
using Triplet = Eigen::Triplet<double, std::int64_t>;

/** The row @p q of targets, of a force at contact node @p node: @p reactions holds the normal
 * ones of the nodes. */
void add_target(const std::size_t node,
                const double coupling,
                const RealMatrix &reactions,
                const std::int64_t q,
                std::vector<Triplet> &target)
{
  for (RealMatrix::InnerIterator entry(reactions, static_cast<Eigen::Index>(node)); entry;
       ++entry)
    target.emplace_back(q, entry.row(), coupling * entry.value());
}

/** Component @p c, @p d of how the drag of a node changes with its velocity along the flat, at once and later. */
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

} // namespace

template <int dim>
std::vector<std::pair<std::int64_t, double>>
relative(const ElasticBody<dim> &body,
         const std::vector<std::int64_t> &number,
         const SlidingNodesAtRest &contact,
         const std::size_t k,
         const unsigned int c)
{
  std::vector<std::pair<std::int64_t, double>> dofs;
  const auto add = [&](const NodeIndex &node, const double sign) {
    if (const std::int64_t dof = number[row_of(body, node, c)]; dof >= 0)
      dofs.emplace_back(dof, sign);
  };
  add(contact.nodes[k], 1.);
  if (!contact.partners.empty())
    add(contact.partners[k], -1.);
  return dofs;
}

template <int dim>
std::vector<Share> reaction_shares(const ElasticBody<dim> &body,
                                   const std::vector<std::int64_t> &number,
                                   const SlidingNodesAtRest &contact)
{
  // Masses of a body whose fields are divided are collective; a pair has whole ones.
  const std::vector<double> mass =
    contact.partners.empty() ? std::vector<double>() : body.lumped_mass();
  std::vector<Share> shares(number.size());
  const auto set = [&](const NodeIndex &node, const std::size_t k, const double weight) {
    shares[static_cast<std::size_t>(row_of(body, node, dim - 1))] = {
      static_cast<std::int64_t>(k), weight};
  };
  for (std::size_t k = 0; k < contact.nodes.size(); ++k)
    {
      double below = 1.;
      if (!contact.partners.empty() &&
          number[static_cast<std::size_t>(row_of(body, contact.nodes[k], dim - 1))] >= 0)
        {
          const auto mass_of = [&](const NodeIndex &node) {
            return mass[static_cast<std::size_t>(row_of(body, node, 0)) / dim];
          };
          const double own   = mass_of(contact.nodes[k]),
                       other = mass_of(contact.partners[k]);
          below              = other / (own + other);
          set(contact.partners[k], k, below - 1.);
        }
      set(contact.nodes[k], k, below);
    }
  for (const auto &[duplicate, original] : body.duplicate_nodes())
    shares[static_cast<std::size_t>(row_of(body, duplicate, dim - 1))] =
      shares[static_cast<std::size_t>(row_of(body, original, dim - 1))];
  return shares;
}

template <int dim>
void add_contact(const ElasticBody<dim> &body,
                 const std::array<RealMatrix, 3> &reactions,
                 const std::vector<std::int64_t> &number,
                 const SlidingNodesAtRest &contact,
                 SlidingPencil &pencil)
{
  const double speed = std::hypot(contact.velocity[0], contact.velocity[1]);
  const std::array<double, 2> direction = {
    {contact.velocity[0] / speed, contact.velocity[1] / speed}};
  std::vector<Triplet> target, damped_target, spring_target, drag, late_drag, given;
  std::int64_t n_forces = 0;
  for (std::size_t k = 0; k < contact.nodes.size(); ++k)
    for (unsigned int c = 0; c + 1 < dim; ++c)
      {
        const auto moved = relative(body, number, contact, k, c);
        if (moved.empty())
          continue;
        const std::int64_t q = n_forces++;
        for (const auto &[row, sign] : moved)
          given.emplace_back(row, q, sign);
        pencil.contact_nodes.push_back(k);
        const FrictionSlopes slopes =
          contact.slopes.empty() ? FrictionSlopes() : contact.slopes[k];
        const double coupling = (contact.friction[k] + slopes.pressure) * direction[c];
        if (contact.stiffness.empty())
          {
            add_target(k, coupling, reactions[0], q, target);
            add_target(k, coupling, reactions[1], q, damped_target);
            add_target(k, coupling, reactions[2], q, spring_target);
          }
        else
          for (const auto &[column, sign] : relative(body, number, contact, k, dim - 1))
            spring_target.emplace_back(q, column,
                                       -sign * coupling * contact.stiffness[k]);
        if (contact.normal_force.empty())
          continue;
        for (unsigned int d = 0; d + 1 < dim; ++d)
          for (const auto &[column, sign] : relative(body, number, contact, k, d))
            {
              const auto of = drag_of(contact, k, direction, c, d, dim == 3);
              drag.emplace_back(q, column, sign * of[0]);
              late_drag.emplace_back(q, column, sign * of[1]);
            }
      }
  const auto gather = [&](RealMatrix &matrix, const std::vector<Triplet> &entries) {
    matrix.resize(n_forces, pencil.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    matrix.prune(0., 0.);
  };
  gather(pencil.targets, target);
  gather(pencil.damped_targets, damped_target);
  gather(pencil.spring_targets, spring_target);
  gather(pencil.drag, drag);
  gather(pencil.late_drag, late_drag);
  pencil.distribution.resize(pencil.size(), n_forces);
  pencil.distribution.setFromTriplets(given.begin(), given.end());
  const RealMatrix &E    = pencil.distribution;
  pencil.friction        = E * pencil.targets;
  pencil.spring_friction = E * pencil.spring_targets;
  pencil.damped_friction = E * pencil.damped_targets;
  pencil.resistance      = E * pencil.drag;
  pencil.late_resistance = E * pencil.late_drag;
}

#define MESOSLIP_INSTANTIATE(dim)                                                        \
  template std::vector<std::pair<std::int64_t, double>> relative(                        \
    const ElasticBody<dim> &, const std::vector<std::int64_t> &,                         \
    const SlidingNodesAtRest &, const std::size_t, const unsigned int);                  \
  template std::vector<Share> reaction_shares(const ElasticBody<dim> &,                  \
                                              const std::vector<std::int64_t> &,         \
                                              const SlidingNodesAtRest &);               \
  template void add_contact(const ElasticBody<dim> &, const std::array<RealMatrix, 3> &, \
                            const std::vector<std::int64_t> &,                           \
                            const SlidingNodesAtRest &, SlidingPencil &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
