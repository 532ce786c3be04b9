#include "elasticity/ml_conjugate_gradients.h"

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

#include <Epetra_CrsMatrix.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <ml_utils.h>

#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
constexpr unsigned int max_iterations = 2000;

// With which ML starts on one process. It estimates eigenvalues from random vectors.
constexpr int seed = 1073741823;
} // namespace

MlConjugateGradients::MlConjugateGradients(
  const Matrix &the_matrix,
  const std::vector<std::vector<double>> &rigid_motions,
  const unsigned int components)
  : matrix(the_matrix)
  , motions(rigid_motions)
  , n_components(components)
  , held(the_matrix.m())
{
}

// Dropping rows and columns keeps the matrix symmetric, which ML relies on. (deal.II's
// iterators clear a buffer as long as the matrix is wide for each row they visit.)
void MlConjugateGradients::copy_without_held()
{
  constrained.copy_from(matrix);
  const Epetra_CrsMatrix &epetra = constrained.trilinos_matrix();
  for (int i = 0; i < epetra.NumMyRows(); ++i)
    {
      int n = 0, *columns = nullptr;
      double *values = nullptr;
      epetra.ExtractMyRowView(i, n, values, columns);
      const auto row         = epetra.GRID64(i);
      const bool row_is_held = held.is_element(row);
      for (int k = 0; k < n; ++k)
        {
          const auto column = epetra.GCID64(columns[k]);
          if (column != row && (row_is_held || held.is_element(column)))
            values[k] = 0.;
        }
    }
}

void MlConjugateGradients::set_held(const dealii::IndexSet &new_held)
{
  held = new_held;
  held.compress();
  copy_without_held();

  // ML takes the motions one after the other, zero where entries are held.
  const auto range    = constrained.local_range();
  const std::size_t n = range.second - range.first;
  null_space.assign(n * motions.size(), 0.);
  for (std::size_t k = 0; k < motions.size(); ++k)
    for (std::size_t i = 0; i < n; ++i)
      if (!held.is_element(range.first + i))
        null_space[k * n + i] = motions[k][i];

  Teuchos::ParameterList parameters;
  ML_Epetra::SetDefaults("SA", parameters);
  parameters.set("ML output", 0);
  parameters.set("PDE equations", static_cast<int>(n_components));
  parameters.set("smoother: type", "Chebyshev");
  parameters.set("smoother: sweeps", 2);
  parameters.set("coarse: type", "Amesos-KLU");
  parameters.set("aggregation: threshold", 1e-4);
  parameters.set("null space: type", "pre-computed");
  parameters.set("null space: dimension", static_cast<int>(motions.size()));
  parameters.set("null space: vectors", null_space.data());
  parameters.set("null space: add default vectors", false);
  // Otherwise results depended, within the tolerance, on what was solved before: on the
  // share of a rank, and on the order of the cases.
  ML_set_random_seed(seed);
  preconditioner.initialize(constrained, parameters);
}

SolverReport
MlConjugateGradients::solve(Vector &u, const Vector &force, const double tolerance) const
{
  // The scale is the residual of the prescribed values alone.
  Vector r(force), prescribed(u);
  const auto range      = matrix.local_range();
  const auto clear_held = [&](Vector &x, const bool keep) {
    for (auto i = range.first; i < range.second; ++i)
      if (held.is_element(i) != keep)
        x(i) = 0.;
    x.compress(dealii::VectorOperation::insert);
  };
  clear_held(prescribed, true);
  matrix.vmult(r, prescribed);
  r.sadd(-1., 1., force);
  clear_held(r, false);
  const double reference = r.l2_norm();
  if (!std::isfinite(reference))
    throw NotConverged("conjugate gradients with ML met numbers that are not finite",
                       NotConverged::Reason::not_finite);

  matrix.vmult(r, u);
  r.sadd(-1., 1., force);
  clear_held(r, false);
  SolverReport report;
  report.residual = reference > 0. ? r.l2_norm() / reference : 0.;
  if (report.residual <= tolerance)
    return report;

  Vector correction(u);
  correction = 0.;
  dealii::SolverControl control(max_iterations, tolerance * reference);
  dealii::SolverCG<Vector> conjugate_gradients(control);
  try
    {
      conjugate_gradients.solve(constrained, correction, r, preconditioner);
    }
  catch (const dealii::SolverControl::NoConvergence &e)
    {
      std::ostringstream text;
      text << "conjugate gradients with ML stopped after " << e.last_step
           << " iterations at a relative residual of " << e.last_residual / reference
           << ", wanted " << tolerance;
      throw NotConverged(text.str());
    }
  u += correction;
  report.iterations = control.last_step();
  report.residual   = control.last_value() / reference;
  return report;
}
} // namespace mesoslip
