#include "statics/static_solver.h"

namespace mesoslip
{
StaticSolverKind static_solver_kind(const std::string &name)
{
  if (name == "multigrid")
    return StaticSolverKind::multigrid;
  if (name == "jacobi")
    return StaticSolverKind::jacobi;
  if (name == "ml")
    return StaticSolverKind::ml;
  throw std::invalid_argument("'" + name + "' is no solver; use multigrid, jacobi or ml");
}
} // namespace mesoslip
