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
 * The damping C = sum over the phases p of beta_p K_p + alpha_p M_p on the nodes of a rank. Steppers form K (u + beta w)
 * in one product, with one beta; where it differs by phase they take K u, and the forces C w come from a product of
 * their own, with an operator whose phases have the stiffness beta_p D_p and the density alpha_p rho_p. A step then
 * costs two to three times as much, with alpha_p alone little more. As a common alpha, alpha_p acts on the mean of w_n
 * and w_(n+1), so that a node has the inertia m + dt/2 sum of alpha_p m_p.
 */
class PhaseDamping
{
public:
  /** Makes the first field K_beta times the second one, whose owned nodes are set. Collective. */
  using Product = std::function<void(NodalField<double> &, NodalField<double> &)>;

  /** @p drags are the alpha_p m_p of the nodes (kg/s, in 2D kg/(m s)), @p like has their layout. */
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

  /** C w for force() to return (N, in 2D N/m). Collective. */
  void start_step(NodalField<double> &w);

  /** C w of the step under way. */
  const NodalField<double> &force() const
  {
    return of_step;
  }

private:
  const Product product;          ///< null without beta_p
  const NodalField<double> drags; ///< one component
  NodalField<double> of_step;
};

/** Phases with the stiffness beta_p D_p (Pa s) and the density alpha_p rho_p (kg/(m^3 s)); zero where there is one value
 * for all, which steppers know themselves. */
template <int dim>
std::vector<ElasticPhase<dim>> phases_of_damping(std::vector<ElasticPhase<dim>> phases,
                                                 const StepParameters &step);

/** PhaseDamping of a row of points, with the lumped mass @p drags of phases_of_damping() (kg/s, in 2D kg/(m s)). */
std::unique_ptr<PhaseDamping> damping_of_points(const StepParameters &step,
                                                const std::vector<double> &drags,
                                                const PhaseDamping::Product &multiply,
                                                const NodalField<double> &like);

/** What the nodes of global row @p j resist their acceleration with, m (1 + alpha dt/2) (kg/m); @p damping is of
 * phases_of_damping(), or null. */
std::vector<double> inertia_row(const UniformMaterial &material,
                                const UniformMaterial *damping,
                                const StepParameters &step,
                                const unsigned int j);
} // namespace mesoslip

#endif
