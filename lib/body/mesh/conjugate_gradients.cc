#include "body/mesh/conjugate_gradients.h"

#include "material/plausibility.h"

#include <deal.II/lac/solver_cg.h>

#include <cmath>

namespace mesoslip
{
SolverReport conjugate_gradients(const DistributedMatrix &A,
                                 AlgebraicMultigrid::Vector &x,
                                 const AlgebraicMultigrid::Vector &b,
                                 const AlgebraicMultigrid &preconditioner,
                                 const double reference,
                                 const double tolerance,
                                 const std::string &of)
{
  constexpr unsigned int max_iterations = 2000;
  const std::string beginning           = (of.empty() ? "" : of + ": ") +
                                "conjugate gradients with " + AlgebraicMultigrid::name();
  if (!std::isfinite(reference))
    throw NotConverged(beginning + " met numbers that are not finite",
                       NotConverged::Reason::not_finite);
  dealii::SolverControl control(max_iterations, tolerance * reference);
  try
    {
      dealii::SolverCG<AlgebraicMultigrid::Vector>(control).solve(A, x, b,
                                                                  preconditioner);
    }
  catch (const dealii::SolverControl::NoConvergence &e)
    {
      const double reached = e.last_residual / reference;
      throw NotConverged(brief_text(6, beginning, " stopped after ", e.last_step,
                                    " iterations at a relative residual of ", reached,
                                    ", wanted ", tolerance),
                         std::isfinite(reached) ? NotConverged::Reason::iterations
                                                : NotConverged::Reason::not_finite,
                         reached);
    }
  SolverReport report;
  report.iterations = control.last_step();
  report.residual   = control.last_value() / reference;
  return report;
}
} // namespace mesoslip
