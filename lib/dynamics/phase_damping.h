#ifndef mesoslip_dynamics_phase_damping_h
#define mesoslip_dynamics_phase_damping_h

#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace mesoslip
{
struct StepParameters;

/**
 * Damping C = sum over the phases p of beta_p K_p + alpha_p M_p on the nodes of a rank.
 * With one common beta, steppers compute K (u + beta w) in one product. If beta differs
 * by phase, they compute K u, and C w follows from a second product, with an operator
 * whose phases have the stiffness beta_p D_p and the density alpha_p rho_p. A step then
 * takes two to three times as long; with alpha_p alone little more. alpha_p acts on the
 * mean of w_n and w_(n+1) like a common alpha, so that a node has the inertia m + dt/2
 * sum of alpha_p m_p.
 */
class PhaseDamping
{
public:
  /**
   * Sets the first field to K_beta times the second one, whose owned nodes are set.
   * Collective.
   */
  using Product = std::function<void(NodalField<double> &, NodalField<double> &)>;

  /**
   * @p drags are alpha_p m_p of the nodes (kg/s, in 2D kg/(m s)); @p like has the layout
   * of the fields.
   */
  PhaseDamping(const StepParameters &step,
               Product multiply,
               NodalField<double> drags,
               const NodalField<double> &like);

  /** Sum of alpha_p m_p of a node (kg/s, in 2D kg/(m s)). */
  double drag(const NodeIndex &node) const
  {
    return drags(0, node);
  }

  /** @p Kw = (sum of beta_p K_p) @p w (N, in 2D N/m). Collective. */
  void multiply(NodalField<double> &Kw, NodalField<double> &w) const
  {
    product(Kw, w);
  }

  /** Computes C w, which force() returns (N, in 2D N/m). Collective. */
  void start_step(NodalField<double> &w);

  /** C w of the current step (N, in 2D N/m). */
  const NodalField<double> &force() const
  {
    return of_step;
  }

private:
  const Product product;          ///< null without beta_p
  const NodalField<double> drags; ///< one component
  NodalField<double> of_step;
};

/**
 * Phases with stiffness beta_p D_p (Pa s) and density alpha_p rho_p (kg/(m^3 s)); zero
 * for a common value, which steppers handle themselves.
 */
template <int dim>
std::vector<ElasticPhase<dim>> phases_of_damping(std::vector<ElasticPhase<dim>> phases,
                                                 const StepParameters &step);

/**
 * PhaseDamping for a row of points; @p drags is the lumped mass of phases_of_damping()
 * (kg/s, in 2D kg/(m s)).
 */
std::unique_ptr<PhaseDamping> damping_of_points(const StepParameters &step,
                                                const std::vector<double> &drags,
                                                const PhaseDamping::Product &multiply,
                                                const NodalField<double> &like);

/**
 * Inertias of the nodes of global row @p j, m (1 + alpha dt/2) (kg/m); @p damping is the
 * material of phases_of_damping(), or null.
 */
std::vector<double> inertia_row(const UniformMaterial &material,
                                const UniformMaterial *damping,
                                const StepParameters &step,
                                const unsigned int j);
} // namespace mesoslip

#endif
