#ifndef mesoslip_dynamics_suspended_nodes_h
#define mesoslip_dynamics_suspended_nodes_h

#include "dynamics/supports/suspension.h"
#include "dynamics/surface_condition.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace mesoslip
{
/** What a suspension did to the nodes of a side in one step, of those that this rank owns. */
template <int dim>
struct SuspensionStep
{
  std::array<double, dim> force =
    {};             ///< of springs and dashpots on the side (N, in 2D N/m)
  double work = 0.; ///< by far end, pressure and weight of the mass (J, J/m)
};

/**
 * Nodes of a side on springs and dashpots to a far end, each by itself. With A the area of a node, Z the
 * matrix of its dashpots, m its mass with that of the suspension, X and V of the far end and F all other forces,
 *
 *     m a_n = F_n - A K (u_n - X_n) - A Z (w_n + theta dt a_n - V_n),   V_n = (X_(n+1) - X_(n-1)) / (2 dt)
 *
 * which is solved for a_n, so that dashpots, as alpha (StepParameters::inertia()), leave the critical time
 * step as it is. theta is 1/2, of order two, as long as z = dt A Z_cc / m of the component is below 2, about twice
 * the impedance of the body. Beyond it a node would swing about its far end from step to step; with theta = 1 - 1/z it
 * follows at once. The balance over the central increment d = (u_(n+1) - u_(n-1)) / 2 is exact:
 * springs keep A (u_n - X_n).K (u_(n+1) - X_(n+1)) / 2, dashpots lose A (w_n + theta dt a_n - V_n).Z (d - dt V_n).
 */
template <int dim>
class SuspendedNodes
{
public:
  /** @p area (m^2, in 2D m) of each node; @p impedance, if the side absorbs, component (r, c) of Z in
   * [dim r + c] for each node (Pa s/m). */
  SuspendedNodes(const Suspension &suspension,
                 const StepParameters &step,
                 const std::vector<double> &area,
                 const std::vector<std::vector<double>> &impedance);

  /** Takes the masses and energies at the start from @p surface before its first step; the first
   * @p n_owned nodes count. */
  void start(const SurfaceView<dim> &surface, const unsigned int n_owned);

  /** One step under a @p pressure (Pa) on the last component; @p increment is that of the step before
   * (m), and becomes that of this step. */
  SuspensionStep<dim> advance(const SurfaceView<dim> &surface,
                              const double pressure,
                              const unsigned int n_owned,
                              std::array<std::vector<double>, dim> &increment);

  /** Acceleration (m/s^2) of node @p i of this mass (kg, in 2D kg/m) without the suspension's at the
   * start, when it moves with @p velocity (m/s) under @p pressure (Pa) and its weight alone. Of dashpots with z > 2 a
   * share of (2/z)^2, as the node does not follow them within a step. */
  std::array<double, dim>
  start_acceleration(const unsigned int i,
                     const double mass,
                     const double pressure,
                     const std::array<double, dim> &velocity) const;

  /** What the nodes that this rank owns have stored and lost (J, in 2D J/m). */
  const SuspensionEnergies &energies() const
  {
    return energy;
  }

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &energy &kinetic;
    for (std::size_t i = 0; i < mobilities.size(); ++i)
      {
        serialize_array(archive, mobilities[i].data(), dim * dim);
        serialize_array(archive, theta[i].data(), dim);
      }
  }

private:
  using Vector = Eigen::Matrix<double, dim, 1>;
  using Matrix = Eigen::Matrix<double, dim, dim>;

  Matrix dashpots_of(const unsigned int i) const;
  double stiffness_of_dashpot(const unsigned int i,
                              const unsigned int c,
                              const double mass) const;

  const Suspension suspension;
  const StepParameters step;
  const std::vector<double> area;
  const std::vector<std::vector<double>> impedance;
  Vector stiffness;               ///< Pa/m
  std::vector<Matrix> mobilities; ///< of each node, a of a force (m/kg)
  std::vector<Vector> theta;      ///< of each node, by component
  SuspensionEnergies energy;
  double kinetic = 0.; ///< of the masses now (J, J/m)
};
} // namespace mesoslip

#endif
