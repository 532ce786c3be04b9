#include "elasticity/static_solver.h"

#include "elasticity/assembled_solver.h"
#include "elasticity/conjugate_gradients.h"
#include "elasticity/multigrid/multigrid_solver.h"

namespace mesoslip
{
StaticSolverKind static_solver_kind(const std::string &name)
{
  if (name == "multigrid")
    return StaticSolverKind::multigrid;
  if (name == "jacobi")
    return StaticSolverKind::jacobi;
  if (name == "assembled")
    return StaticSolverKind::assembled;
  throw std::invalid_argument("'" + name +
                              "' is no solver; use multigrid, jacobi or assembled");
}

std::unique_ptr<StaticSolver> make_static_solver(const StaticSolverKind kind,
                                                 const UniformMaterial &material)
{
  if (kind == StaticSolverKind::multigrid)
    return std::make_unique<MultigridSolver>(material);
  if (kind == StaticSolverKind::assembled)
    return std::make_unique<AssembledGridSolver>(material);
  return std::make_unique<JacobiSolver>(material);
}
} // namespace mesoslip
