#include "body/mesh/algebraic_multigrid.h"

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
    throw std::runtime_error("PETSc's multigrid GAMG ended with its error " +
                             std::to_string(error));
}
} // namespace

struct AlgebraicMultigrid::Library
{
  Mat matrix = nullptr;
  PC gamg    = nullptr;
  Vec x = nullptr, y = nullptr; ///< without numbers of their own

  ~Library()
  {
    VecDestroy(&x);
    VecDestroy(&y);
    PCDestroy(&gamg);
    MatDestroy(&matrix);
  }

  /** The rows of this rank. */
  void copy(const dealii::TrilinosWrappers::SparseMatrix &from, const unsigned int dim)
  {
    const auto [begin, end]     = from.local_range();
    std::vector<PetscInt> first = {0}, columns;
    std::vector<double> values;
    for (auto row = begin; row < end; ++row)
      {
        for (auto entry = from.begin(row); entry != from.end(row); ++entry)
          {
            columns.push_back(static_cast<PetscInt>(entry->column()));
            values.push_back(entry->value());
          }
        first.push_back(static_cast<PetscInt>(columns.size()));
      }
    const auto n_rows = static_cast<PetscInt>(end - begin);
    require(MatCreate(from.get_mpi_communicator(), &matrix));
    require(MatSetSizes(matrix, n_rows, n_rows, PETSC_DETERMINE, PETSC_DETERMINE));
    require(MatSetBlockSize(matrix, static_cast<PetscInt>(dim)));
    require(MatSetType(matrix, MATAIJ));
    // One of them is meant, the other one does nothing.
    require(
      MatSeqAIJSetPreallocationCSR(matrix, first.data(), columns.data(), values.data()));
    require(
      MatMPIAIJSetPreallocationCSR(matrix, first.data(), columns.data(), values.data()));
    require(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
    require(MatCreateVecs(matrix, &x, &y));
  }

  /** PETSc wants them orthonormal, and one at least. */
  void set_near_null_space(std::vector<Vector> motions)
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
        require(VecDuplicate(x, &vector));
        double *values = nullptr;
        require(VecGetArray(vector, &values));
        std::copy(motions[k].begin(), motions[k].end(), values);
        require(VecRestoreArray(vector, &values));
        vectors.push_back(vector);
      }
    if (vectors.empty()) // nothing is free
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

void AlgebraicMultigrid::initialize(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                    const unsigned int dim,
                                    const std::vector<Vector> &near_null_space)
{
  PetscBool is_started = PETSC_FALSE;
  require(PetscInitialized(&is_started));
  if (is_started == PETSC_FALSE) // not by deal.II's MPI_InitFinalize
    require(PetscInitializeNoArguments());
  library = std::make_unique<Library>();
  library->copy(matrix, dim);
  library->set_near_null_space(near_null_space);
  require(PCCreate(matrix.get_mpi_communicator(), &library->gamg));
  require(PCSetOperators(library->gamg, library->matrix, library->matrix));
  require(PCSetType(library->gamg, PCGAMG));
  require(PCSetUp(library->gamg));
  // W cycles, as with ML.
  require(PCMGSetCycleType(library->gamg, PC_MG_CYCLE_W));
}

void AlgebraicMultigrid::vmult(Vector &y, const Vector &x) const
{
  require(VecPlaceArray(library->x, x.begin()));
  require(VecPlaceArray(library->y, y.begin()));
  require(PCApply(library->gamg, library->x, library->y));
  require(VecResetArray(library->x));
  require(VecResetArray(library->y));
}
} // namespace mesoslip
