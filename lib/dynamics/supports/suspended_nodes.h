#ifndef mesoslip_dynamics_suspended_nodes_h
#define mesoslip_dynamics_suspended_nodes_h

#include "dynamics/supports/side_nodes.h"
#include "dynamics/supports/suspension.h"
#include "dynamics/surface_condition.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace mesoslip
{
/** Load on a suspension in the step that begins at a given time. */
template <int dim>
struct SuspensionLoad
{
  double time     = 0.;                  ///< s
  double pressure = 0.;                  ///< Pa
  FarEnd<dim> far;                       ///< motion of the far end
  std::array<double, dim> traction = {}; ///< uniform traction (Pa)
};

/** State of a node before and after a step. */
template <int dim>
struct NodeStep
{
  std::array<double, dim> u_before = {}; ///< m
  std::array<double, dim> w_before = {}; ///< m/s
  std::array<double, dim> u_after  = {}; ///< m
  std::array<double, dim> w_after  = {}; ///< m/s
};

/**
 * Independent nodes of a side on springs and dashpots to a far end. With the area A of a
 * node, the matrix Z of its dashpots, its mass m including the suspension, displacement X
 * and velocity V of the far end and all other forces F,
 *
 *     m a_n = F_n - A K (u_n - X_n) - A Z (w_n + theta dt a_n - V_n),
 *     V_n = (X_(n+1) - X_(n-1)) / (2 dt)
 *
 * is solved for a_n, so that dashpots, like alpha (StepParameters::inertia()), do not
 * reduce the critical time step. theta is 1/2, of order two, as long as z = dt A Z_cc / m
 * of the component is below 2, about twice the impedance of the body. Beyond this limit a
 * node would oscillate about its far end from step to step; with theta = 1 - 1/z it
 * follows immediately. The energy balance over the central increment d = (u_(n+1) -
 * u_(n-1)) / 2 is exact: springs store A (u_n - X_n).K (u_(n+1) - X_(n+1)) / 2, dashpots
 * dissipate A (w_n + theta dt a_n - V_n).Z (d - dt V_n).
 *
 * A node that another surface advances (contact or another side) gets the forces of w_n,
 * and the factor of a_n as a mass. Only the diagonal of Z is used for it: off-diagonal
 * terms would act one step late and make the node oscillate.
 */
template <int dim>
class SuspendedNodes
{
public:
  using Vector = Eigen::Matrix<double, dim, 1>; ///< vector of components

  /** Energy and work are counted for nodes with @p counted; empty: for all nodes. */
  SuspendedNodes(const Suspension &suspension,
                 const StepParameters &step,
                 const SideNodes &nodes,
                 const std::vector<bool> &counted = {});

  /** Load in the step that begins at @p time (s) under a @p pressure (Pa). */
  SuspensionLoad<dim> load_at(const double time, const double pressure) const;

  /**
   * Initializes mass and energies of node @p k from node @p i of @p surface, before its
   * first step.
   */
  void start(const unsigned int k, const SurfaceView<dim> &surface, const unsigned int i);

  /**
   * start() for a node that another surface advances; its inverse_mass already contains
   * guest_mass().
   */
  void start_guest(const unsigned int k,
                   const SurfaceView<dim> &surface,
                   const unsigned int i);

  /**
   * Inertia that node @p k adds to the given inertia (kg, in 2D kg/m) of component @p c
   * of a node that another surface advances. Called before the first step for each
   * unconstrained component.
   */
  double guest_mass(const unsigned int k, const unsigned int c, const double inertia);

  /**
   * Forces on node @p k, which is node @p i of @p surface, without the terms of its
   * acceleration (N, in 2D N/m).
   */
  Vector force(const unsigned int k,
               const SurfaceView<dim> &surface,
               const unsigned int i,
               const SuspensionLoad<dim> &load) const;

  /**
   * Advances node @p k, which is node @p i of @p surface, by one step under a load.
   * @p increment is the displacement of the previous step (m) and is replaced by that of
   * this step. Returns the force on the side without weight (N, in 2D N/m).
   */
  Vector advance(const unsigned int k,
                 const SurfaceView<dim> &surface,
                 const unsigned int i,
                 const SuspensionLoad<dim> &load,
                 std::array<std::vector<double>, dim> &increment);

  /** Counts energy and work of a @p moved node, like advance(). */
  Vector account(const unsigned int k,
                 const NodeStep<dim> &moved,
                 const SuspensionLoad<dim> &load,
                 std::array<std::vector<double>, dim> &increment);

  /**
   * Adds suspension and @p pressure (Pa) to the initial @p acceleration (m/s^2) of node
   * @p k with this mass (kg, in 2D kg/m) and @p velocity (m/s). Dashpots with z > 2 are
   * included with the factor (2/z)^2, as the node does not follow them within a step.
   */
  void accelerate(const unsigned int k,
                  const double mass,
                  const double pressure,
                  const std::array<double, dim> &velocity,
                  std::array<double, dim> &acceleration) const;

  /** Mass of the suspension at node @p k (kg, in 2D kg/m). */
  double mass(const unsigned int k) const
  {
    return suspension.mass * nodes.area[k];
  }

  /** Energies stored and dissipated at the counted nodes (J, in 2D J/m). */
  SuspensionEnergies energies() const;

  /**
   * Work of far end, pressure and weight of the mass on them since the start (J, in 2D
   * J/m).
   */
  double work() const;

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    for (std::size_t k = 0; k < ledger.size(); ++k)
      {
        serialize_array(archive, &ledger[k].stored, sizeof(Ledger) / sizeof(double));
        serialize_array(archive, mobilities[k].data(), dim * dim);
        serialize_array(archive, implicit[k].data(), dim * dim);
      }
  }

private:
  using Matrix = Eigen::Matrix<double, dim, dim>;

  Vector push_on(const unsigned int k, const SuspensionLoad<dim> &load) const;
  double theta(const unsigned int k, const unsigned int c, const double mass) const;

  /**
   * Energies of one node, kept separately so that the order of nodes in time changes no
   * sum (J, in 2D J/m).
   */
  struct Ledger
  {
    double stored   = 0.; ///< current energy of springs
    double kinetic  = 0.; ///< current kinetic energy of the mass
    double at_start = 0.; ///< stored and kinetic energy at the start
    double lost     = 0.; ///< dissipated since the start
    double work     = 0.; ///< see work()
  };

  const Suspension suspension;
  const StepParameters step;
  const SideNodes nodes;
  const std::vector<bool> counted;
  Vector stiffness;               ///< Pa/m
  std::vector<Matrix> dashpots;   ///< A Z of each node (N s/m, in 2D Pa s)
  std::vector<Matrix> mobilities; ///< acceleration per force of each node (m/kg)
  std::vector<Matrix> implicit;   ///< A Z theta of each node, or its diagonal
  std::vector<Ledger> ledger;
  std::vector<Vector> lasting; ///< constant traction of each node (Pa)
};
} // namespace mesoslip

#endif
