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
/** What acts on a suspension in the step from one time. */
template <int dim>
struct SuspensionLoad
{
  double time     = 0.;                  ///< s
  double pressure = 0.;                  ///< Pa
  FarEnd<dim> far;                       ///< its motion
  std::array<double, dim> traction = {}; ///< that is the same everywhere (Pa)
};

/** A node before and after a step. */
template <int dim>
struct NodeStep
{
  std::array<double, dim> u_before = {}; ///< m
  std::array<double, dim> w_before = {}; ///< m/s
  std::array<double, dim> u_after  = {}; ///< m
  std::array<double, dim> w_after  = {}; ///< m/s
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
 *
 * A node that something else moves, the contact or another side, gets the forces of w_n and, as a mass, what a_n has
 * in them. Of Z it has the diagonal alone: the rest would act a step late, and make the node swing.
 */
template <int dim>
class SuspendedNodes
{
public:
  using Vector = Eigen::Matrix<double, dim, 1>; ///< of components

  /** Of the nodes with @p counted this rank counts energy and work; not given: all. */
  SuspendedNodes(const Suspension &suspension,
                 const StepParameters &step,
                 const SideNodes &nodes,
                 const std::vector<bool> &counted = {});

  /** What acts in the step from @p time (s) on under a @p pressure (Pa). */
  SuspensionLoad<dim> load_at(const double time, const double pressure) const;

  /** Takes the mass and the energies at the start of node @p k from node @p i of @p surface before its
   * first step. */
  void start(const unsigned int k, const SurfaceView<dim> &surface, const unsigned int i);

  /** The same of a node that something else moves, whose inverse_mass has guest_mass() already. */
  void start_guest(const unsigned int k,
                   const SurfaceView<dim> &surface,
                   const unsigned int i);

  /** What node @p k adds to this inertia (kg, in 2D kg/m) of component @p c of a node that something else
   * moves, which is called before the first step for each component that is not held. */
  double guest_mass(const unsigned int k, const unsigned int c, const double inertia);

  /** Forces on node @p k, which is node @p i of @p surface, without what depends on its acceleration (N,
   * in 2D N/m). */
  Vector force(const unsigned int k,
               const SurfaceView<dim> &surface,
               const unsigned int i,
               const SuspensionLoad<dim> &load) const;

  /** One step of node @p k, which is node @p i of @p surface, under a load; @p increment is that of the
   * step before (m), and becomes that of this step. Returns the force on the side without weight (N, in 2D N/m). */
  Vector advance(const unsigned int k,
                 const SurfaceView<dim> &surface,
                 const unsigned int i,
                 const SuspensionLoad<dim> &load,
                 std::array<std::vector<double>, dim> &increment);

  /** Counts energy and work of a @p moved node, as advance() does. */
  Vector account(const unsigned int k,
                 const NodeStep<dim> &moved,
                 const SuspensionLoad<dim> &load,
                 std::array<std::vector<double>, dim> &increment);

  /** Makes @p acceleration (m/s^2) at the start of node @p k of this mass (kg, in 2D kg/m), which moves with
   * @p velocity (m/s), that with the suspension and @p pressure (Pa). Of dashpots with z > 2 it has a
   * share of (2/z)^2, as the node does not follow them within a step. */
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

  /** What the nodes that this rank counts have stored and lost (J, in 2D J/m). */
  SuspensionEnergies energies() const;

  /** Work of far end, pressure and weight of the mass on them since the start (J, J/m). */
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

  /** Of a node, so that their order in time changes no sum (J, in 2D J/m). */
  struct Ledger
  {
    double stored   = 0.; ///< in springs, now
    double kinetic  = 0.; ///< of the mass, now
    double at_start = 0.; ///< both at the start
    double lost     = 0.; ///< since the start
    double work     = 0.; ///< see work()
  };

  const Suspension suspension;
  const StepParameters step;
  const SideNodes nodes;
  const std::vector<bool> counted;
  Vector stiffness;               ///< Pa/m
  std::vector<Matrix> dashpots;   ///< of each node, A Z (N s/m, in 2D Pa s)
  std::vector<Matrix> mobilities; ///< of each node, a of a force (m/kg)
  std::vector<Matrix> implicit;   ///< of each node, A Z theta, or its diagonal
  std::vector<Ledger> ledger;
  std::vector<Vector>
    lasting; ///< of each node, traction that depends on the place alone (Pa)
};
} // namespace mesoslip

#endif
