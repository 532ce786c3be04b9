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
/** A number for each degree of freedom of a mesh; each rank owns some and may know others. */
using DistributedVector = dealii::LinearAlgebra::distributed::Vector<double>;

/**
 * A symmetric matrix whose rows are divided among the ranks: Trilinos' on Epetra or PETSc's, as
 * the multigrid that works with it (MESOSLIP_MULTIGRID).
 */
class DistributedMatrix
{
public:
  using Index =
    dealii::types::global_dof_index; ///< number of a row or column in the whole matrix
  using Vector = DistributedVector;  ///< each rank has at least the numbers of its rows

  DistributedMatrix();
  ~DistributedMatrix();

  /** Zero, with the @p entries of the rows to which this rank adds, which are those of its index
   * set; @p owned are those that it keeps, @p n_components a node. The entries may be used up.
   * Collective. */
  void reinit(const dealii::IndexSet &owned,
              dealii::DynamicSparsityPattern &entries,
              const unsigned int n_components,
              const MPI_Comm communicator);

  /** Adds @p values to @p row. */
  void add(const Index row,
           const std::vector<Index> &columns,
           const std::vector<double> &values);

  /** Ends adding: the ranks send one another what is of rows of others. Collective. */
  void compress();

  /** Becomes @p other with nothing but the diagonal in the rows and columns of owned degrees of freedom that
   * are @p fixed. Collective. */
  void copy_without(const DistributedMatrix &other, const std::vector<bool> &fixed);

  /** y = A x. Collective. */
  void vmult(Vector &y, const Vector &x) const;

  /** Calls action(row, column, value) for the rows of this rank. */
  void for_each(
    const std::function<void(const Index, const Index, const double)> &action) const;

  struct Library;
  /** The library's own. */
  const Library &native() const
  {
    return *library;
  }

private:
  std::unique_ptr<Library> library;
};
} // namespace mesoslip

#endif
