#ifndef mesoslip_eigenvalues_complex_contact_motion_h
#define mesoslip_eigenvalues_complex_contact_motion_h

#include "eigenvalues/complex/sliding_pencil.h"

#include <array>

namespace mesoslip
{
/** Matrix with these entries; equal places add up. */
RealMatrix matrix_of(const Eigen::Index n_rows,
                     const Eigen::Index n_columns,
                     const std::vector<Eigen::Triplet<double, std::int64_t>> &entries);

/** Matrix row of component @p c of a node of the whole body. */
template <int dim>
Eigen::Index
row_of(const ElasticBody<dim> &body, const NodeIndex &node, const unsigned int c)
{
  return static_cast<Eigen::Index>(
    dim * (static_cast<std::size_t>(node.j) * body.n_columns() + node.i) + c);
}

/**
 * Kinematics of bodies that slide on a flat or on each other. All displacements, numbered
 * as in MatrixEntry, are U x with the unknowns x: the free degrees of freedom except
 * normal displacements of contact nodes that follow a second body; nodes on springs do
 * not follow it.
 */
template <int dim>
struct ContactMotion
{
  /** Reduces a matrix of all displacements to the unknowns. */
  RealMatrix among_unknowns(const RealMatrix &of_all) const
  {
    return RealMatrix(whole.transpose()) * (of_all * whole).eval();
  }

  /** Reduces a matrix of the free degrees of freedom to the unknowns. */
  RealMatrix of_free(const RealMatrix &matrix) const
  {
    return RealMatrix(free.transpose()) * (matrix * free).eval();
  }

  /** Matrix from unknowns to free degrees of freedom. */
  RealMatrix free;

  /** Free degree of freedom of each unknown. */
  std::vector<std::int64_t> of_unknowns;

  /** U, matrix from unknowns to all displacements. */
  RealMatrix whole;

  /**
   * For each axis: matrix from unknowns to the motion of contact nodes relative to the
   * opposite surface.
   */
  std::array<RealMatrix, dim> relative;
};

/** Kinematics for these contact nodes, possibly none. */
template <int dim>
ContactMotion<dim> make_contact_motion(const ElasticBody<dim> &body,
                                       const FreeDofs<dim> &dofs,
                                       const SlidingNodesAtRest &contact);

/** Matrix of all displacements for springs or dashpots of supports. */
template <int dim>
RealMatrix whole_matrix(const ElasticBody<dim> &body,
                        const std::vector<SpringEntry> &entries);

/** Diagonal mass of the free degrees of freedom; all of them must be on one rank. */
template <int dim>
Eigen::VectorXd masses_of(const FreeDofs<dim> &dofs);

/**
 * Matrix from forces -f on all displacements to normal reactions l of contact nodes. On a
 * rigid flat, l is the sum of -f at the node. With the normal displacements S x of
 * contact nodes relative to a second body, and free degrees of freedom x with masses M,
 * the reactions l = -(S M^-1 S^T)^-1 S M^-1 f keep S x constant. No rows if the nodes
 * stand on springs.
 */
template <int dim>
RealMatrix normal_reactions(const ElasticBody<dim> &body,
                            const FreeDofs<dim> &dofs,
                            const SlidingNodesAtRest &contact);
} // namespace mesoslip

#endif
