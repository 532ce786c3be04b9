#ifndef mesoslip_body_mesh_distributed_matrix_h
#define mesoslip_body_mesh_distributed_matrix_h

#include <deal.II/base/index_set.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <functional>
#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * Values of the degrees of freedom of a mesh; each rank owns some and may have ghost
 * values.
 */
using DistributedVector = dealii::LinearAlgebra::distributed::Vector<double>;

/**
 * A symmetric matrix with rows distributed over the ranks: a Trilinos (Epetra) or PETSc
 * matrix, as MESOSLIP_MULTIGRID selects.
 */
class DistributedMatrix
{
public:
  using Index  = dealii::types::global_dof_index; ///< global number of a row or column
  using Vector = DistributedVector; ///< each rank has at least the values of its rows

  DistributedMatrix();
  ~DistributedMatrix();

  /**
   * Sets the sparsity pattern @p entries and all values to zero. The index set of
   * @p entries has all rows to which this rank adds; @p owned are the locally owned rows,
   * with @p n_components per node. The pattern may be consumed. Collective.
   */
  void reinit(const dealii::IndexSet &owned,
              dealii::DynamicSparsityPattern &entries,
              const unsigned int n_components,
              const MPI_Comm communicator);

  /** Adds @p values to @p row. */
  void add(const Index row,
           const std::vector<Index> &columns,
           const std::vector<double> &values);

  /**
   * Ends adding: contributions to rows of other ranks are sent to their owners.
   * Collective.
   */
  void compress();

  /**
   * Copies @p other; rows and columns of locally owned degrees of freedom that are
   * @p fixed keep only their diagonal entry. Collective.
   */
  void copy_without(const DistributedMatrix &other, const std::vector<bool> &fixed);

  /** y = A x. Collective. */
  void vmult(Vector &y, const Vector &x) const;

  /** Calls action(row, column, value) for the rows of this rank. */
  void for_each(
    const std::function<void(const Index, const Index, const double)> &action) const;

  struct Library;
  /** The matrix object of the library. */
  const Library &native() const
  {
    return *library;
  }

private:
  std::unique_ptr<Library> library;
};
} // namespace mesoslip

#endif
