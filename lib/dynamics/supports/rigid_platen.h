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
 * Nodes that move as one along some axes, pushed by the forces f of the body, a pressure p, springs k and dashpots z to
 * a far end: with sums over the nodes, their area A, the normal n into the body and the mass M of the platen
 *
 *     (M + sum m) a = -sum f + A (n p - k (u - X) - z (w + theta dt a - V))
 *
 * with theta and V as in SuspendedNodes. alpha does not act on M. Ranks that share the nodes count loads, energies and
 * work of their part of the area.
 */
template <int dim>
class RigidPlaten : public SurfaceCondition<dim>
{
public:
  /** Of these @p nodes of this rank, of which the first @p n_owned are counted here; components in which they do not
   * move are left alone. @p ranks share the nodes. Collective. */
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

  /** One step. Collective before the first one. */
  void advance(const SurfaceView<dim> &surface) override;

  /** Stops it at once, and returns the work (J, in 2D J/m) of what stops it on its mass, see TopSurface::stop(). */
  double stop();

  /** A node at the start as it would move without the platen. */
  struct NodeAtStart
  {
    double mass = 0.; ///< with that of other supports (kg, in 2D kg/m)
    std::array<double, dim> acceleration = {}; ///< m/s^2
  };

  /** Acceleration (m/s^2) at the start with @p velocity (m/s) of these nodes of this rank. Collective. */
  std::array<double, dim> start_acceleration(const std::vector<NodeAtStart> &nodes,
                                             const std::array<double, 3> &velocity) const;

  /** Force of pressure, springs and dashpots on the nodes in the last step (N, in 2D N/m), of this rank. */
  const std::array<double, dim> &load() const
  {
    return force;
  }

  /** How far it moved in the last step (m). */
  const std::array<double, dim> &increment() const
  {
    return moved;
  }

  /** Work of pressure and far end on it since the start (J, in 2D J/m), of this rank. */
  double work() const
  {
    return total_work;
  }

  /** Energies of springs, dashpots and the mass of the platen, of this rank. */
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
  double area       = 0.; ///< of the nodes of this rank (m^2, m)
  double whole_area = 0.; ///< of all nodes (m^2, m)
  double mass       = 0.; ///< what this rank counts of the platen (kg, in 2D kg/m)
  std::array<double, dim> into = {}; ///< the normal, into the body

  bool started                        = false;
  std::array<double, dim> moving_mass = {}; ///< of platen and nodes (kg, in 2D kg/m)
  std::array<double, dim> moved       = {}; ///< see increment()
  std::array<double, dim> w           = {}; ///< m/s
  std::array<double, dim> force       = {}; ///< see load()
  double in_springs = 0., kinetic = 0., at_start = 0., lost = 0., total_work = 0.;
};
} // namespace mesoslip

#endif
