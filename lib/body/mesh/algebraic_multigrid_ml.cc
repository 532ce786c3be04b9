#include "body/mesh/algebraic_multigrid.h"

#include <deal.II/lac/trilinos_precondition.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <ml_utils.h>

namespace mesoslip
{
namespace
{
// With which ML starts on one process. It estimates eigenvalues from random vectors, and
// otherwise results depended, within the tolerance, on what was solved before.
constexpr int seed = 1073741823;
} // namespace

struct AlgebraicMultigrid::Library
{
  std::vector<double> null_space; ///< vector after vector, as ML wants them
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

void AlgebraicMultigrid::initialize(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                    const unsigned int dim,
                                    const std::vector<Vector> &near_null_space)
{
  std::vector<double> &null_space = library->null_space;
  null_space.clear();
  for (const Vector &motion : near_null_space)
    null_space.insert(null_space.end(), motion.begin(), motion.end());
  Teuchos::ParameterList parameters;
  ML_Epetra::SetDefaults("SA", parameters);
  parameters.set("ML output", 0);
  // W cycles: iterations hardly grow with the mesh; V cycles took 1.5 to 2.2 times as many in
  // 2D, in about the same time.
  parameters.set("prec type", "MGW");
  parameters.set("PDE equations", static_cast<int>(dim));
  parameters.set("smoother: type", "Chebyshev");
  parameters.set("smoother: sweeps", 2);
  parameters.set("coarse: type", "Amesos-KLU");
  parameters.set("aggregation: threshold", 1e-4);
  parameters.set("null space: type", "pre-computed");
  parameters.set("null space: dimension", static_cast<int>(near_null_space.size()));
  parameters.set("null space: vectors", null_space.data());
  parameters.set("null space: add default vectors", false);
  ML_set_random_seed(seed);
  library->ml.initialize(matrix, parameters);
}
} // namespace mesoslip
