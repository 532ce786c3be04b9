#ifndef mesoslip_eigenvalues_complex_pencil_contact_h
#define mesoslip_eigenvalues_complex_pencil_contact_h

#include "eigenvalues/complex/sliding_pencil.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace mesoslip
{
/** Row in a matrix of the whole body of component @p c of a node. */
template <int dim>
Eigen::Index
row_of(const ElasticBody<dim> &body, const NodeIndex &node, const unsigned int c)
{
  return static_cast<Eigen::Index>(
    dim * (static_cast<std::size_t>(node.j) * body.n_columns() + node.i) + c);
}

/** The free degrees of freedom that give component @p c of the motion of contact node @p k against the flat or its partner,
 * with their signs. */
template <int dim>
std::vector<std::pair<std::int64_t, double>>
relative(const ElasticBody<dim> &body,
         const std::vector<std::int64_t> &number,
         const SlidingNodesAtRest &contact,
         const std::size_t k,
         const unsigned int c);

/** What a row of a matrix of the whole body adds to normal reactions. */
struct Share
{
  std::int64_t node = -1; ///< the contact node; -1: none
  double weight     = 0.; ///< with which the row counts (-)
};

/** Of all rows, of which @p number has the free degrees of freedom. Of partners that move as one along the normal, each reacts
 * with the share of the other one in their mass; duplicates as their originals, as normal reactions are sums over both. */
template <int dim>
std::vector<Share> reaction_shares(const ElasticBody<dim> &body,
                                   const std::vector<std::int64_t> &number,
                                   const SlidingNodesAtRest &contact);

/** The friction forces, their targets and the drag; the columns of @p reactions are normal reactions of the nodes. */
template <int dim>
void add_contact(const ElasticBody<dim> &body,
                 const std::array<RealMatrix, 3> &reactions,
                 const std::vector<std::int64_t> &number,
                 const SlidingNodesAtRest &contact,
                 SlidingPencil &pencil);

} // namespace mesoslip

#endif
