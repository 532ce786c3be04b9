#include "body/mesh/algebraic_multigrid.h"

#include <deal.II/lac/sparsity_tools.h>

#include <petscpc.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace mesoslip
{
static_assert(std::is_same_v<PetscScalar, double>, "a PETSc of real numbers");

namespace
{
void require(const PetscErrorCode error)
{
  if (error != 0)
    throw std::runtime_error("PETSc's matrices or its multigrid GAMG ended with error " +
                             std::to_string(error));
}

/** Starts PETSc, by deal.II's MPI_InitFinalize or here. */
void start_petsc()
{
  PetscBool is_started = PETSC_FALSE;
  require(PetscInitialized(&is_started));
  if (is_started == PETSC_FALSE)
    require(PetscInitializeNoArguments());
}

/** A PETSc vector that uses the memory of a deal.II vector while this object lives. */
class Placed
{
public:
  Placed(Vec the_vec, const double *numbers)
    : vec(the_vec)
  {
    require(VecPlaceArray(vec, numbers));
  }
  Placed(const Placed &)            = delete;
  Placed &operator=(const Placed &) = delete;
  ~Placed()
  {
    VecResetArray(vec);
  }

private:
  Vec vec;
};
} // namespace

struct DistributedMatrix::Library
{
  Mat matrix = nullptr;
  Vec x = nullptr, y = nullptr; ///< for products, see Placed

  Library()                           = default;
  Library(const Library &)            = delete;
  Library &operator=(const Library &) = delete;
  ~Library()
  {
    clear();
  }

  void clear()
  {
    VecDestroy(&x);
    VecDestroy(&y);
    MatDestroy(&matrix);
  }

  /** Sets the options of a new matrix. */
  void set_up()
  {
    require(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
    require(MatSetOption(matrix, MAT_KEEP_NONZERO_PATTERN, PETSC_TRUE));
    require(MatCreateVecs(matrix, &x, &y));
  }
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
  start_petsc();
  const dealii::IndexSet rows = entries.row_index_set();
  dealii::SparsityTools::distribute_sparsity_pattern(entries, owned, communicator, rows);
  std::vector<PetscInt> inside, outside;
  for (const Index row : owned)
    {
      PetscInt n_inside = 0, n = 0;
      for (auto entry = entries.begin(row); entry != entries.end(row); ++entry, ++n)
        n_inside += owned.is_element(entry->column()) ? 1 : 0;
      inside.push_back(n_inside);
      outside.push_back(n - n_inside);
    }
  library->clear();
  const auto n = static_cast<PetscInt>(owned.n_elements());
  Mat &matrix  = library->matrix;
  require(MatCreate(communicator, &matrix));
  require(MatSetSizes(matrix, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
  require(MatSetBlockSize(matrix, static_cast<PetscInt>(n_components)));
  require(MatSetType(matrix, MATAIJ));
  // Only the call for the type of the matrix has an effect.
  require(MatSeqAIJSetPreallocation(matrix, 0, inside.data()));
  require(MatMPIAIJSetPreallocation(matrix, 0, inside.data(), 0, outside.data()));
  library->set_up();
}

void DistributedMatrix::add(const Index row,
                            const std::vector<Index> &columns,
                            const std::vector<double> &values)
{
  const auto i = static_cast<PetscInt>(row);
  const std::vector<PetscInt> of_petsc(columns.begin(), columns.end());
  require(MatSetValues(library->matrix, 1, &i, static_cast<PetscInt>(columns.size()),
                       of_petsc.data(), values.data(), ADD_VALUES));
}

void DistributedMatrix::compress()
{
  require(MatAssemblyBegin(library->matrix, MAT_FINAL_ASSEMBLY));
  require(MatAssemblyEnd(library->matrix, MAT_FINAL_ASSEMBLY));
}

void DistributedMatrix::copy_without(const DistributedMatrix &other,
                                     const std::vector<bool> &fixed)
{
  library->clear();
  Mat &matrix = library->matrix;
  require(MatDuplicate(other.library->matrix, MAT_COPY_VALUES, &matrix));
  library->set_up();
  PetscInt begin = 0;
  require(MatGetOwnershipRange(matrix, &begin, nullptr));
  require(MatGetDiagonal(matrix, library->x));
  std::vector<PetscInt> rows;
  for (std::size_t k = 0; k < fixed.size(); ++k)
    if (fixed[k])
      rows.push_back(begin + static_cast<PetscInt>(k));
  require(MatZeroRowsColumns(matrix, static_cast<PetscInt>(rows.size()), rows.data(), 0.,
                             nullptr, nullptr));
  require(MatDiagonalSet(matrix, library->x, INSERT_VALUES));
}

void DistributedMatrix::vmult(Vector &y, const Vector &x) const
{
  const Placed from(library->x, x.begin()), to(library->y, y.begin());
  require(MatMult(library->matrix, library->x, library->y));
}

void DistributedMatrix::for_each(
  const std::function<void(const Index, const Index, const double)> &action) const
{
  PetscInt begin = 0, end = 0;
  require(MatGetOwnershipRange(library->matrix, &begin, &end));
  for (PetscInt row = begin; row < end; ++row)
    {
      PetscInt n              = 0;
      const PetscInt *columns = nullptr;
      const double *values    = nullptr;
      require(MatGetRow(library->matrix, row, &n, &columns, &values));
      for (PetscInt k = 0; k < n; ++k)
        action(static_cast<Index>(row), static_cast<Index>(columns[k]), values[k]);
      require(MatRestoreRow(library->matrix, row, &n, &columns, &values));
    }
}

struct AlgebraicMultigrid::Library
{
  PC gamg                              = nullptr;
  const DistributedMatrix::Library *of = nullptr;

  Library()                           = default;
  Library(const Library &)            = delete;
  Library &operator=(const Library &) = delete;
  ~Library()
  {
    PCDestroy(&gamg);
  }

  /** Orthonormalizes the motions, as PETSc requires; it needs at least one vector. */
  static void set_near_null_space(Mat matrix, std::vector<Vector> motions)
  {
    std::vector<Vec> vectors;
    for (std::size_t k = 0; k < motions.size(); ++k)
      {
        for (std::size_t l = 0; l < k; ++l)
          motions[k].add(-(motions[l] * motions[k]), motions[l]);
        const double norm = motions[k].l2_norm();
        if (!(norm > 0.))
          continue;
        motions[k] /= norm;
        Vec vector = nullptr;
        require(MatCreateVecs(matrix, &vector, nullptr));
        double *values = nullptr;
        require(VecGetArray(vector, &values));
        std::copy(motions[k].begin(), motions[k].end(), values);
        require(VecRestoreArray(vector, &values));
        vectors.push_back(vector);
      }
    if (vectors.empty()) // no motion is free
      return;
    MatNullSpace space = nullptr;
    require(MatNullSpaceCreate(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)),
                               PETSC_FALSE, static_cast<PetscInt>(vectors.size()),
                               vectors.data(), &space));
    require(MatSetNearNullSpace(matrix, space));
    require(MatNullSpaceDestroy(&space));
    for (Vec &vector : vectors)
      require(VecDestroy(&vector));
  }
};

AlgebraicMultigrid::AlgebraicMultigrid()  = default;
AlgebraicMultigrid::~AlgebraicMultigrid() = default;

const char *AlgebraicMultigrid::name()
{
  return "GAMG";
}

void AlgebraicMultigrid::initialize(const DistributedMatrix &matrix,
                                    const std::vector<Vector> &near_null_space)
{
  library     = std::make_unique<Library>();
  library->of = &matrix.native();
  Mat of      = library->of->matrix;
  Library::set_near_null_space(of, near_null_space);
  require(PCCreate(PetscObjectComm(reinterpret_cast<PetscObject>(of)), &library->gamg));
  require(PCSetOperators(library->gamg, of, of));
  require(PCSetType(library->gamg, PCGAMG));
  require(PCSetUp(library->gamg));
  // W cycles, as with ML.
  require(PCMGSetCycleType(library->gamg, PC_MG_CYCLE_W));
}

void AlgebraicMultigrid::vmult(Vector &y, const Vector &x) const
{
  const Placed from(library->of->x, x.begin()), to(library->of->y, y.begin());
  require(PCApply(library->gamg, library->of->x, library->of->y));
}
} // namespace mesoslip
