#ifndef mesoslip_body_mesh_conjugate_gradients_h
#define mesoslip_body_mesh_conjugate_gradients_h

#include "body/mesh/algebraic_multigrid.h"
#include "statics/static_solver.h"

#include <string>

namespace mesoslip
{
/**
 * Solves A x = b with deal.II's conjugate gradients from the initial guess @p x, until
 * the residual is @p tolerance times @p reference. Collective. @throws NotConverged,
 * which names the load case @p of
 */
SolverReport conjugate_gradients(const DistributedMatrix &A,
                                 AlgebraicMultigrid::Vector &x,
                                 const AlgebraicMultigrid::Vector &b,
                                 const AlgebraicMultigrid &preconditioner,
                                 const double reference,
                                 const double tolerance,
                                 const std::string &of = "");
} // namespace mesoslip

#endif
