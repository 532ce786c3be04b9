#include "body/mesh/algebraic_multigrid.h"

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <ml_utils.h>

namespace mesoslip
{
struct DistributedMatrix::Library
{
  dealii::TrilinosWrappers::SparseMatrix matrix;
  unsigned int n_components = 0; ///< degrees of freedom per node
};

DistributedMatrix::DistributedMatrix()
  : library(std::make_unique<Library>())
{
}

DistributedMatrix::~DistributedMatrix() = default;

void DistributedMatrix::reinit(const dealii::IndexSet &owned,
                               dealii::DynamicSparsityPattern &entries,
                               const unsigned int n_components,
                               const MPI_Comm communicator)
{
  const dealii::IndexSet &rows = entries.row_index_set();
  dealii::TrilinosWrappers::SparsityPattern pattern(owned, owned, rows, communicator);
  std::vector<Index> columns;
  for (const Index row : rows)
    {
      columns.clear();
      for (auto entry = entries.begin(row); entry != entries.end(row); ++entry)
        columns.push_back(entry->column());
      pattern.add_entries(row, columns.begin(), columns.end(), true);
    }
  pattern.compress();
  library->matrix.reinit(pattern);
  library->n_components = n_components;
}

void DistributedMatrix::add(const Index row,
                            const std::vector<Index> &columns,
                            const std::vector<double> &values)
{
  library->matrix.add(row, columns.size(), columns.data(), values.data(), false);
}

void DistributedMatrix::compress()
{
  library->matrix.compress(dealii::VectorOperation::add);
}

// Zeroing rows and columns keeps the matrix symmetric, as ML requires. (deal.II's
// iterators clear a buffer of the width of the matrix for each row they visit.)
void DistributedMatrix::copy_without(const DistributedMatrix &other,
                                     const std::vector<bool> &fixed)
{
  library->matrix.copy_from(other.library->matrix);
  library->n_components          = other.library->n_components;
  const Epetra_CrsMatrix &epetra = library->matrix.trilinos_matrix();
  Epetra_Vector of_rows(epetra.RowMap()), of_columns(epetra.ColMap());
  for (std::size_t k = 0; k < fixed.size(); ++k)
    of_rows[static_cast<int>(k)] = fixed[k] ? 1. : 0.;
  if (epetra.Importer() == nullptr) // on one rank
    of_columns = of_rows;
  else
    of_columns.Import(of_rows, *epetra.Importer(), Insert);
  for (int i = 0; i < epetra.NumMyRows(); ++i)
    {
      int n = 0, *columns = nullptr;
      double *values = nullptr;
      epetra.ExtractMyRowView(i, n, values, columns);
      const auto row = epetra.GRID64(i);
      for (int k = 0; k < n; ++k)
        if (epetra.GCID64(columns[k]) != row &&
            (of_rows[i] != 0. || of_columns[columns[k]] != 0.))
          values[k] = 0.;
    }
}

void DistributedMatrix::vmult(Vector &y, const Vector &x) const
{
  library->matrix.vmult(y, x);
}

void DistributedMatrix::for_each(
  const std::function<void(const Index, const Index, const double)> &action) const
{
  const Epetra_CrsMatrix &epetra = library->matrix.trilinos_matrix();
  for (int i = 0; i < epetra.NumMyRows(); ++i)
    {
      int n = 0, *columns = nullptr;
      double *values = nullptr;
      epetra.ExtractMyRowView(i, n, values, columns);
      for (int k = 0; k < n; ++k)
        action(static_cast<Index>(epetra.GRID64(i)),
               static_cast<Index>(epetra.GCID64(columns[k])), values[k]);
    }
}

namespace
{
// Initial seed of ML on one process. ML estimates eigenvalues with random vectors;
// without a fixed seed, results would depend on previous solves, within the tolerance.
constexpr int seed = 1073741823;
} // namespace

struct AlgebraicMultigrid::Library
{
  std::vector<double> null_space; ///< vector after vector, as ML expects
  dealii::TrilinosWrappers::PreconditionAMG ml;
};

AlgebraicMultigrid::AlgebraicMultigrid()
  : library(std::make_unique<Library>())
{
}

AlgebraicMultigrid::~AlgebraicMultigrid() = default;

const char *AlgebraicMultigrid::name()
{
  return "ML";
}

void AlgebraicMultigrid::vmult(Vector &y, const Vector &x) const
{
  library->ml.vmult(y, x);
}

void AlgebraicMultigrid::initialize(const DistributedMatrix &matrix,
                                    const std::vector<Vector> &near_null_space)
{
  std::vector<double> &null_space = library->null_space;
  null_space.clear();
  for (const Vector &motion : near_null_space)
    null_space.insert(null_space.end(), motion.begin(), motion.end());
  Teuchos::ParameterList parameters;
  ML_Epetra::SetDefaults("SA", parameters);
  parameters.set("ML output", 0);
  // W cycles: the number of iterations hardly grows with the mesh. V cycles took 1.5 to
  // 2.2 times as many in 2D, in about the same time.
  parameters.set("prec type", "MGW");
  parameters.set("PDE equations", static_cast<int>(matrix.native().n_components));
  parameters.set("smoother: type", "Chebyshev");
  parameters.set("smoother: sweeps", 2);
  parameters.set("coarse: type", "Amesos-KLU");
  parameters.set("aggregation: threshold", 1e-4);
  parameters.set("null space: type", "pre-computed");
  parameters.set("null space: dimension", static_cast<int>(near_null_space.size()));
  parameters.set("null space: vectors", null_space.data());
  parameters.set("null space: add default vectors", false);
  ML_set_random_seed(seed);
  library->ml.initialize(matrix.native().matrix, parameters);
}
} // namespace mesoslip
