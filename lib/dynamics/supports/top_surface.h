#ifndef mesoslip_dynamics_top_surface_h
#define mesoslip_dynamics_top_surface_h

#include "base/serialize_members.h"
#include "dynamics/supports/rigid_platen.h"
#include "dynamics/supports/suspended_nodes.h"

#include <array>
#include <cstdint>
#include <limits>
#include <mpi.h>
#include <optional>
#include <utility>
#include <vector>

namespace mesoslip
{
/** How the top of the body is held and loaded, by a platen unless set otherwise. */
struct TopSetup : SideSupport
{
  TopSetup() ///< see the members
  {
    is_platen = true;
  }

  /** A top that does not move. */
  void hold()
  {
    is_platen = false;
    held.fill(true);
  }

  /** Whether nothing of it moves from the start. */
  bool is_held() const
  {
    return !is_platen && held == std::array<bool, 3>{{true, true, true}};
  }

  /** Whether its nodes stand on a suspension or under a traction, each by itself. */
  bool is_suspended_by_nodes() const
  {
    return !is_platen && suspension.is_there();
  }

  /** Whether component @p c along the flat does not move from the start. */
  bool holds(const unsigned int c) const
  {
    return is_platen ? !(suspension.stiffness[c] > 0.) : held[c];
  }

  /** The components in which a platen moves it, of @p dim. */
  std::array<bool, 3> moves(const unsigned int dim) const
  {
    std::array<bool, 3> result = {};
    for (unsigned int c = 0; c < dim; ++c)
      result[c] = c + 1 == dim || !holds(c);
    return result;
  }

  /** Whether it keeps the body from moving along the flat from the start, so that it takes the
   * friction. */
  bool holds_tangentially() const
  {
    return holds(0);
  }

  /** Whether it takes the friction: it holds the body along the flat, or its suspension does. */
  bool takes_friction() const
  {
    bool takes = true;
    for (unsigned int c = 0; c < 2; ++c)
      takes = takes && (direction[c] == 0. || holds(c) || suspension.resists(c));
    return takes;
  }

  /** Whether component @p c of @p dim, the last one along the normal, is held in statics and
   * modes, where a platen has its own degrees of freedom. */
  bool is_fixed(const unsigned int c, const unsigned int dim) const
  {
    return is_platen || (c + 1 < dim ? held[c] : is_held());
  }

  /** From this time (s) on the top stays where it is. */
  double hold_from = std::numeric_limits<double>::infinity();

  /** Along which tangential forces are counted: x and y, of length one. */
  std::array<double, 2> direction = {{1., 0.}};

  /** Width of a cell of a grid (m). */
  double cell_width = 0.;

  /** What each node stands for; on a grid the area may be left out, and the push is that of the area. */
  SideNodes nodes;

  /** The last column duplicates the first. */
  bool periodic = false;

  /** The first nodes, which this rank owns; the others are copies (SharedNodes). Not
   * given: all. */
  std::optional<unsigned int> n_owned;
};

/** Forces on the body during one step, per unit thickness. */
struct TopLoad
{
  double normal = 0.; ///< N/m, positive when it presses
  double tangential =
    0.; ///< N/m, as transmitted from the contact, along direction; of springs
};

/** Sampled resultants at the top, per unit thickness. */
struct TopHistory
{
  std::vector<double> normal_force;     ///< N/m, positive when it presses
  std::vector<double> tangential_force; ///< N/m, as transmitted from the contact
  std::vector<double> displacement;     ///< mean u_y (m)

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/**
 * Makes samples of the nodes of each rank those of all nodes: every rank gets the sums.
 * Collective.
 */
void sum_over_ranks(TopHistory &samples, const MPI_Comm communicator);

/** Histories of the top. */
class TopRecorder
{
public:
  /** A sample every @p interval steps; 0: none. */
  explicit TopRecorder(const unsigned int interval)
    : interval(interval)
  {
  }

  /** Whether this step is sampled. */
  bool wants(const std::uint64_t step) const
  {
    return interval > 0 && step % interval == 0;
  }

  /** Mean @p displacement (m) before the step, load in it. */
  void record(const double displacement, const TopLoad &load);

  /** What was sampled so far, or since take(). */
  const TopHistory &history() const
  {
    return samples;
  }

  /** Takes out what was sampled since the last call. */
  TopHistory take()
  {
    return std::exchange(samples, TopHistory());
  }

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &samples;
  }

private:
  const unsigned int interval;
  TopHistory samples;
};

/**
 * The top of the body under its load. Ranks that share it count loads and work of their
 * own nodes, whose sums are those of the top. Work is formed with the central increment
 * (u_(n+1) - u_(n-1)) / 2, for which the discrete energy balance is exact.
 */
template <int dim>
class TopSurface : public SurfaceCondition<dim>
{
public:
  /** For a top of which this rank has @p n_nodes nodes, at rest, and @p ranks share the
   * rest. Collective. */
  TopSurface(const TopSetup &setup,
             const StepParameters &step,
             const unsigned int n_nodes,
             const MPI_Comm ranks = MPI_COMM_SELF);

  /** @p recorder is filled from now on and has to outlive the last step. */
  void observe(TopRecorder &recorder)
  {
    recorders.push_back(&recorder);
  }

  bool wants_total_force() const override
  {
    return platen.has_value();
  }

  /** One step of the surface under its load. */
  void advance(const SurfaceView<dim> &surface) override;

  /** Accelerations (m/s^2) of the nodes of these masses (kg, in 2D kg/m) by load, weight and suspension when they
   * start with @p velocity (m/s), but for what is @p held and for the load of a platen. */
  std::vector<std::array<double, dim>>
  start_acceleration(const std::vector<double> &mass,
                     const std::vector<std::array<bool, dim>> &held,
                     const std::array<double, 3> &velocity) const;

  /** What moves its nodes as one; null: nothing. */
  const RigidPlaten<dim> *moved_by() const
  {
    return platen ? &*platen : nullptr;
  }

  /** Mass that node @p i has more by its suspension (kg, in 2D kg/m). */
  double suspended_mass(const unsigned int i) const
  {
    return on_nodes ? nodes.mass(i) : 0.;
  }

  /** Work done on the body since the start (J/m), by load and far end on the nodes of this rank. */
  double work() const
  {
    return total_work + (on_nodes ? nodes.work() : 0.) + (platen ? platen->work() : 0.);
  }

  /** Energies of the suspension, of this rank. */
  SuspensionEnergies suspended() const
  {
    return on_nodes ? nodes.energies()
           : platen ? platen->energies()
                    : SuspensionEnergies();
  }

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &increment &started &holding &total_work;
    if (on_nodes)
      archive &nodes;
    if (platen)
      archive &*platen;
  }

private:
  void initialize(const SurfaceView<dim> &surface);

  TopLoad push_nodes(const SurfaceView<dim> &surface);
  SurfaceView<dim> held_along_flat(SurfaceView<dim> surface) const;
  TopLoad push_suspended(const SurfaceView<dim> &given);
  TopLoad push_platen(const SurfaceView<dim> &surface);
  TopLoad hold(const SurfaceView<dim> &surface);
  double transmitted(const SurfaceView<dim> &surface,
                     const std::array<bool, 2> &held) const;
  double along_flat(const std::array<double, dim> &force) const;
  void stop(const SurfaceView<dim> &surface);

  void move_node(double &u, double &w, const double acceleration) const;

  const TopSetup setup;
  const StepParameters step;
  const unsigned int n_distinct; ///< nodes that this rank owns
  const MPI_Comm ranks;

  std::vector<double> tributary; ///< area (m^2, m) that each node carries
  double n_in_top = 0.;          ///< nodes of the whole top

  const bool on_nodes;       ///< there is a suspension of each node
  SuspendedNodes<dim> nodes; ///< if so
  std::optional<RigidPlaten<dim>> platen;
  std::array<std::vector<double>, dim> increment; ///< of the step before (m)
  std::vector<double> no_mobility;                ///< zeros, one a node
  bool started          = false;
  bool holding          = false;
  double total_work     = 0.;
  double work_this_step = 0.;
  std::vector<TopRecorder *> recorders;
};
} // namespace mesoslip

#endif
