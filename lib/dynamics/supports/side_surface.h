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
 * A side under its load: pressure, springs, dashpots and mass of each node, see
 * SuspendedNodes. It advances its own nodes. Nodes shared with the contact, the top or a
 * previous side are advanced there, as guests: this side adds its forces and counts its
 * work.
 */
template <int dim>
class SideSurface : public SurfaceCondition<dim>
{
public:
  /**
   * Side with @p nodes of this rank; energy and work are counted for nodes with
   * @p counted.
   */
  SideSurface(const SideSupport &support,
              const StepParameters &step,
              const SideNodes &nodes,
              const std::vector<bool> &counted);

  /** Advances the first nodes, which belong to this side, by one step. */
  void advance(const SurfaceView<dim> &surface) override;

  /**
   * Call before the first step of own node @p k, which is node @p i of @p surface; call
   * has_started() after all nodes.
   */
  void start(const unsigned int k, const SurfaceView<dim> &surface, const unsigned int i);

  /**
   * Advances own node @p k, which is node @p i of @p surface, by one step; nodes may be
   * at different steps.
   */
  void
  advance(const unsigned int k, const SurfaceView<dim> &surface, const unsigned int i);

  /** Whether start() must be called. */
  bool is_at_start() const
  {
    return !started;
  }

  /** Marks all nodes as started. */
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

  /**
   * Call before the first step of node @p k, which is node @p i of @p surface;
   * add_force() calls it unless has_started() was called.
   */
  void start_guest(const unsigned int k,
                   const SurfaceView<dim> &surface,
                   const unsigned int i);

  /**
   * Adds to the force of node @p k, which is node @p i of the @p surface that advances
   * it, before its step.
   */
  void add_force(const unsigned int k,
                 const SurfaceView<dim> &surface,
                 const unsigned int i,
                 const std::array<double *, dim> &force);

  /** Counts energy and work of node @p k after its step. */
  void
  account(const unsigned int k, const SurfaceView<dim> &surface, const unsigned int i);
  /** @} */

  /**
   * Adds the load to the initial @p acceleration (m/s^2) of node @p k with this mass (kg,
   * in 2D kg/m) and @p velocity (m/s).
   */
  void accelerate(const unsigned int k,
                  const double mass,
                  const std::array<double, dim> &velocity,
                  std::array<double, dim> &acceleration) const
  {
    nodes.accelerate(k, mass, support.pressure(0.), velocity, acceleration);
  }

  /** Mass of the suspension at node @p k (kg, in 2D kg/m). */
  double mass(const unsigned int k) const
  {
    return nodes.mass(k);
  }

  /** Work of load and far end since the start (J, in 2D J/m), for this rank. */
  double work() const
  {
    return nodes.work();
  }

  /** Energies of the suspension, for this rank. */
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
    increment;                      ///< previous displacement increments (m)
  std::vector<NodeStep<dim>> steps; ///< state of guests before the current step
  bool started = false;

  struct LoadOfStep
  {
    std::uint64_t step = 0;
    SuspensionLoad<dim> load;
  };
  std::vector<std::optional<LoadOfStep>> loads; ///< loads of the steps in progress
};
} // namespace mesoslip

#endif
