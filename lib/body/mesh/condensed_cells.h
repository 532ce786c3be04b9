#ifndef mesoslip_body_mesh_condensed_cells_h
#define mesoslip_body_mesh_condensed_cells_h

#include "body/mesh/distributed_matrix.h"
#include "body/mesh/distributed_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace mesoslip
{
/**
 * Adds matrices and vectors of cells to those of the body, whose degrees of freedom may be tied to
 * another one or held at zero; these have a positive diagonal entry and no other ones. As
 * AffineConstraints::distribute_local_to_global(), which in deal.II 9.4 reads in front of a list
 * where all degrees of freedom of a cell are constrained, as in a periodic body one cell wide.
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

  /** Gives @p matrix the entries that all cells of @p mesh add to, zero; @p with_held: also those
   * of what is held. Collective. */
  template <int dim>
  void reinit(DistributedMatrix &matrix,
              const DistributedMesh<dim> &mesh,
              const bool with_held = false) const;

  /** Adds @p cell of the degrees of freedom @p indices. */
  void add(const Eigen::MatrixXd &cell,
           const std::vector<Index> &indices,
           DistributedMatrix &matrix);

  /** The same of a vector, which has the lines of the constraints. */
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
