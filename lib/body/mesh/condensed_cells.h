#ifndef mesoslip_body_mesh_condensed_cells_h
#define mesoslip_body_mesh_condensed_cells_h

#include "body/mesh/distributed_matrix.h"
#include "body/mesh/distributed_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace mesoslip
{
/**
 * Adds matrices and vectors of cells to the global ones. Degrees of freedom may be tied
 * to another one or constrained to zero; their rows and columns have only a positive
 * diagonal entry. Replaces AffineConstraints::distribute_local_to_global(), which in
 * deal.II 9.4 reads out of bounds if all degrees of freedom of a cell are constrained, as
 * in a periodic body one cell wide.
 */
class CondensedCells
{
public:
  using Index = dealii::types::global_dof_index; ///< a degree of freedom

  /** @p constraints must outlive it. */
  explicit CondensedCells(const dealii::AffineConstraints<double> &constraints)
    : constraints(constraints)
  {
  }

  /**
   * Gives @p matrix the sparsity pattern of all cells of @p mesh and sets it to zero;
   * with @p with_held also the entries of constrained degrees of freedom. Collective.
   */
  template <int dim>
  void reinit(DistributedMatrix &matrix,
              const DistributedMesh<dim> &mesh,
              const bool with_held = false) const;

  /** Adds the matrix @p cell with degrees of freedom @p indices. */
  void add(const Eigen::MatrixXd &cell,
           const std::vector<Index> &indices,
           DistributedMatrix &matrix);

  /** Adds the vector @p cell; @p vector contains the lines of the constraints. */
  void add(const Eigen::VectorXd &cell,
           const std::vector<Index> &indices,
           DistributedVector &vector) const;

private:
  Index target(const Index dof) const;

  const dealii::AffineConstraints<double> &constraints;
  std::vector<Index> columns; ///< scratch
  std::vector<double> values; ///< scratch
};
} // namespace mesoslip

#endif
