#ifndef mesoslip_eigenvalues_complex_contact_motion_h
#define mesoslip_eigenvalues_complex_contact_motion_h

#include "eigenvalues/complex/sliding_pencil.h"

#include <array>

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

/**
 * How bodies move that slide on a flat or on each other. Their displacements, numbered as MatrixEntry says, are U x with the
 * unknowns x: what is free, but for displacements of contact nodes along the normal, which follow what the nodes meet of a second
 * body, unless they stand on springs.
 */
template <int dim>
struct ContactMotion
{
  /** What a matrix of all displacements is among the unknowns. */
  RealMatrix among_unknowns(const RealMatrix &of_all) const
  {
    return RealMatrix(whole.transpose()) * (of_all * whole).eval();
  }

  /** What a matrix of the free degrees of freedom is among the unknowns. */
  RealMatrix of_free(const RealMatrix &matrix) const
  {
    return RealMatrix(free.transpose()) * (matrix * free).eval();
  }

  /** Free degrees of freedom by unknowns. */
  RealMatrix free;

  /** The free degree of freedom that each unknown is. */
  std::vector<std::int64_t> of_unknowns;

  /** U. */
  RealMatrix whole;

  /** For each axis, motion of contact nodes against what they meet, by unknowns. */
  std::array<RealMatrix, dim> relative;
};

/** Of these contact nodes, of which there may be none. */
template <int dim>
ContactMotion<dim> make_contact_motion(const ElasticBody<dim> &body,
                                       const FreeDofs<dim> &dofs,
                                       const SlidingNodesAtRest &contact);

/** Springs or dashpots of supports as a matrix of all displacements. */
template <int dim>
RealMatrix whole_matrix(const ElasticBody<dim> &body,
                        const std::vector<SpringEntry> &entries);

/** The diagonal of the mass of free degrees of freedom that one rank has. */
template <int dim>
Eigen::VectorXd masses_of(const FreeDofs<dim> &dofs);

/**
 * Reactions l of contact nodes by -f on all displacements. Of a rigid flat, l is the sum of -f at the node. With the normal
 * displacements S x of contact nodes against what they meet, by free degrees of freedom x of masses M, reactions
 * l = -(S M^-1 S^T)^-1 S M^-1 f keep S x still. Without rows if the nodes stand on springs.
 */
template <int dim>
RealMatrix normal_reactions(const ElasticBody<dim> &body,
                            const FreeDofs<dim> &dofs,
                            const SlidingNodesAtRest &contact);
} // namespace mesoslip

#endif
