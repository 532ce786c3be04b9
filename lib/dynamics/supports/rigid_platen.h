#ifndef mesoslip_dynamics_rigid_platen_h
#define mesoslip_dynamics_rigid_platen_h

#include "dynamics/supports/side_nodes.h"
#include "dynamics/supports/side_support.h"
#include "dynamics/surface_condition.h"

#include <array>
#include <mpi.h>
#include <vector>

namespace mesoslip
{
/**
 * Nodes that move as a rigid unit along some axes, under the forces f of the body, a
 * pressure p, springs k and dashpots z to a far end. With sums over the nodes, their area
 * A, the normal n into the body and the mass M of the platen:
 *
 *     (M + sum m) a = -sum f + A (n p - k (u - X) - z (w + theta dt a - V))
 *
 * with theta and V as in SuspendedNodes. alpha does not act on M. Each rank counts loads,
 * energies and work for its share of the area.
 */
template <int dim>
class RigidPlaten : public SurfaceCondition<dim>
{
public:
  /**
   * Platen of these @p nodes of this rank; the first @p n_owned are locally owned.
   * Components not in @p moves are not changed. @p ranks share the nodes. Collective.
   */
  RigidPlaten(const SideSupport &support,
              const std::array<bool, 3> &moves,
              const StepParameters &step,
              const SideNodes &nodes,
              const unsigned int n_owned,
              const MPI_Comm ranks);

  bool wants_total_force() const override
  {
    return true;
  }

  /** Advances the nodes by one step. The first call is collective. */
  void advance(const SurfaceView<dim> &surface) override;

  /**
   * Stops the platen instantly; returns the work of the stopping force on its mass (J, in
   * 2D J/m), see TopSurface::stop().
   */
  double stop();

  /** Initial state of a node without the platen. */
  struct NodeAtStart
  {
    double mass = 0.; ///< mass including other supports (kg, in 2D kg/m)
    std::array<double, dim> acceleration = {}; ///< m/s^2
  };

  /**
   * Initial acceleration (m/s^2) for a @p velocity (m/s) of these nodes of this rank.
   * Collective.
   */
  std::array<double, dim> start_acceleration(const std::vector<NodeAtStart> &nodes,
                                             const std::array<double, 3> &velocity) const;

  /**
   * Force of pressure, springs and dashpots on the nodes of this rank in the last step
   * (N, in 2D N/m).
   */
  const std::array<double, dim> &load() const
  {
    return force;
  }

  /** Displacement increment of the last step (m). */
  const std::array<double, dim> &increment() const
  {
    return moved;
  }

  /**
   * Work of pressure and far end on the platen since the start (J, in 2D J/m), for this
   * rank.
   */
  double work() const
  {
    return total_work;
  }

  /** Energies of springs, dashpots and platen mass, for this rank. */
  SuspensionEnergies energies() const
  {
    return {in_springs + kinetic, at_start, lost};
  }

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &started &moving_mass &moved &w &in_springs &kinetic &at_start &lost
      &total_work;
  }

private:
  void start(const SurfaceView<dim> &surface);
  void move(const SurfaceView<dim> &surface,
            const unsigned int c,
            const double pressure,
            const FarEnd<dim> &far);

  const SideSupport support;
  const std::array<bool, 3> moves;
  const StepParameters step;
  const unsigned int n_owned;
  const MPI_Comm ranks;
  double area       = 0.; ///< area of the owned nodes (m^2, in 2D m)
  double whole_area = 0.; ///< area of all nodes (m^2, in 2D m)
  double mass       = 0.; ///< share of this rank in the platen mass (kg, in 2D kg/m)
  std::array<double, dim> into = {}; ///< unit normal into the body

  bool started                        = false;
  std::array<double, dim> moving_mass = {}; ///< mass of platen and nodes (kg, in 2D kg/m)
  std::array<double, dim> moved       = {}; ///< see increment()
  std::array<double, dim> w           = {}; ///< m/s
  std::array<double, dim> force       = {}; ///< see load()
  double in_springs = 0., kinetic = 0., at_start = 0., lost = 0., total_work = 0.;
};
} // namespace mesoslip

#endif
