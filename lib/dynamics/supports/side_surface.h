#ifndef mesoslip_dynamics_side_surface_h
#define mesoslip_dynamics_side_surface_h

#include "dynamics/supports/side_support.h"
#include "dynamics/supports/suspended_nodes.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * A side under its load: pressure, springs, dashpots and mass of each node, see SuspendedNodes. It moves its
 * own nodes. Those that it shares with the contact, the top or a side before it are moved there, as
 * guests: it adds to their forces and counts its work.
 */
template <int dim>
class SideSurface : public SurfaceCondition<dim>
{
public:
  /** Of the @p nodes that this rank has it counts those with @p counted. */
  SideSurface(const SideSupport &support,
              const StepParameters &step,
              const SideNodes &nodes,
              const std::vector<bool> &counted);

  /** One step of the first nodes, which are its own. */
  void advance(const SurfaceView<dim> &surface) override;

  /** Before the first step of own node @p k, which is node @p i of @p surface; once all nodes are there,
   * has_started() follows. */
  void start(const unsigned int k, const SurfaceView<dim> &surface, const unsigned int i);

  /** One step of own node @p k, which is node @p i of @p surface; others may be some steps ahead. */
  void
  advance(const unsigned int k, const SurfaceView<dim> &surface, const unsigned int i);

  /** Whether start() has to be called. */
  bool is_at_start() const
  {
    return !started;
  }

  /** All nodes have been started. */
  void has_started()
  {
    started = true;
  }

  /**
   * @name Guests
   * @{
   */
  /** See SuspendedNodes::guest_mass(). */
  double guest_mass(const unsigned int k, const unsigned int c, const double inertia)
  {
    return nodes.guest_mass(k, c, inertia);
  }

  /** Before the first step of node @p k, which is node @p i of @p surface; add_force() does it unless
   * has_started() was called. */
  void start_guest(const unsigned int k,
                   const SurfaceView<dim> &surface,
                   const unsigned int i);

  /** Adds to the force of node @p k, which is node @p i of the @p surface that moves it, before its step. */
  void add_force(const unsigned int k,
                 const SurfaceView<dim> &surface,
                 const unsigned int i,
                 const std::array<double *, dim> &force);

  /** Counts what happened to node @p k in the step, after it. */
  void
  account(const unsigned int k, const SurfaceView<dim> &surface, const unsigned int i);
  /** @} */

  /** Makes @p acceleration (m/s^2) of node @p k of this mass (kg, in 2D kg/m) at the start, when it moves
   * with @p velocity (m/s), that with the load. */
  void accelerate(const unsigned int k,
                  const double mass,
                  const std::array<double, dim> &velocity,
                  std::array<double, dim> &acceleration) const
  {
    nodes.accelerate(k, mass, support.pressure(0.), velocity, acceleration);
  }

  /** Mass that node @p k has more by the suspension (kg, in 2D kg/m). */
  double mass(const unsigned int k) const
  {
    return nodes.mass(k);
  }

  /** Work of load and far end since the start (J, in 2D J/m), of this rank. */
  double work() const
  {
    return nodes.work();
  }

  /** Energies of the suspension, of this rank. */
  SuspensionEnergies suspended() const
  {
    return nodes.energies();
  }

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &started &increment &nodes;
  }

private:
  const SuspensionLoad<dim> &load_at(const SurfaceView<dim> &surface);

  const SideSupport support;
  const StepParameters step;
  SuspendedNodes<dim> nodes;
  std::array<std::vector<double>, dim>
    increment;                      ///< how far each node moved in the step before (m)
  std::vector<NodeStep<dim>> steps; ///< where guests were before the step under way
  bool started = false;

  struct LoadOfStep
  {
    std::uint64_t step = 0;
    SuspensionLoad<dim> load;
  };
  std::vector<std::optional<LoadOfStep>> loads; ///< of the steps that are under way
};
} // namespace mesoslip

#endif
