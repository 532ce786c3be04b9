#ifndef mesoslip_contact_equilibrium_solver_h
#define mesoslip_contact_equilibrium_solver_h

#include "base/exchange.h"
#include "body/rigid_motions.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * Stiffness that relates displacements to nodal forces: largest normal stiffness, in 3D
 * times the mean distance of contact nodes (N/m, in 2D Pa).
 */
template <int dim>
double stiffness_scale(const ElasticBody<dim> &body)
{
  double D = 0.;
  for (const ElasticPhase<dim> &phase : body.phases())
    D = std::max(D, phase.stiffness(dim - 1, dim - 1));
  if constexpr (dim == 2)
    return D;
  const auto &areas = body.surface(ElasticBody<dim>::bottom).normal_area;
  double area       = 0.;
  for (const auto &normal_area : areas)
    area += std::fabs(normal_area[dim - 1]);
  return D * std::sqrt(area / static_cast<double>(areas.size()));
}

/**
 * Solver for the displacements of a body whose constraints and forces change. It solves
 * for corrections, so that a good initial guess helps with any tolerance criterion of the
 * linear solver.
 */
template <int dim>
class EquilibriumSolver
{
public:
  /** @p body must outlive it. */
  explicit EquilibriumSolver(const ElasticBody<dim> &body)
    : body(body)
    , solver(body.make_solver())
    , Ku(body.zero_field())
    , residual(Ku)
    , correction(Ku)
    , left(Ku)
  {
  }

  /**
   * Constrains the degrees of freedom in @p mask to their values in the displacements,
   * and adds the springs @p on, which exist on all ranks that have their nodes.
   */
  void set_constrained(const DofMask &mask, const std::vector<SpringEntry> &on = {})
  {
    constrained = mask;
    springs     = on;
    on_springs  = mpi::max(springs.empty() ? 0 : 1, body.communicator()) > 0;
    solver->set_constrained_on_springs(mask, springs);
  }

  /**
   * Improves @p u until the unbalanced forces on free degrees of freedom are at most
   * @p tolerance relative to all internal nodal forces, or no longer decrease. Returns
   * the relative residual. Collective on a distributed body.
   */
  double
  solve(NodalField<double> &u, const NodalField<double> &force, const double tolerance)
  {
    for (unsigned int k = 0;; ++k)
      {
        body.vmult(Ku, u);
        const double share = residual_share(with_springs(force, u));
        if (share <= tolerance || k == 4)
          return share;
        correction.set_zero();
        n_iterations +=
          solver->solve(correction, residual, std::min(0.5, 0.5 * tolerance / share))
            .iterations;
        for (std::size_t n = 0; n < u.size(); ++n)
          u.begin()[n] += correction.begin()[n];
      }
  }

  /**
   * Whether constraints and springs leave a rigid motion of the body free. Collective.
   */
  bool can_move() const
  {
    return mesoslip::can_move(body, constrained,
                              with_foundation(body.foundation(), springs));
  }

  /** K u after solve() (N, in 2D N/m). */
  const NodalField<double> &internal_force() const
  {
    return Ku;
  }

  /** Number of iterations of all linear solves. */
  unsigned int iterations() const
  {
    return n_iterations;
  }

private:
  /** @p force minus the spring forces. Collective, as some ranks may have no springs. */
  const NodalField<double> &with_springs(const NodalField<double> &force,
                                         const NodalField<double> &u)
  {
    if (!on_springs)
      return force;
    left = force;
    for (const SpringEntry &spring : springs)
      left(spring.c, spring.node) -=
        spring.stiffness * (u(spring.d, spring.node) - spring.rest);
    body.update_copies(left);
    return left;
  }

  double residual_share(const NodalField<double> &force)
  {
    double free = 0., all = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int j = 0; j < body.n_rows(); ++j)
        for (unsigned int i = 0; i < body.n_columns(); ++i)
          {
            const NodeIndex node  = {i, j};
            const double internal = Ku(c, node);
            const double x =
              constrained.is_constrained(c, node) ? 0. : force(c, node) - internal;
            residual(c, node) = x;
            if (!body.is_counted(node))
              continue;
            free += x * x;
            all += internal * internal;
          }
    free = mpi::sum(free, body.communicator());
    all  = mpi::sum(all, body.communicator());
    return all > 0. ? std::sqrt(free / all) : (free > 0. ? 1. : 0.);
  }

  const ElasticBody<dim> &body;
  std::unique_ptr<StaticSolver> solver;
  DofMask constrained;
  NodalField<double> Ku, residual, correction, left;
  std::vector<SpringEntry> springs;
  bool on_springs           = false; ///< whether any rank has springs
  unsigned int n_iterations = 0;
};
} // namespace mesoslip

#endif
