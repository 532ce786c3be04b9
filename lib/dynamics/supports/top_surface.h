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
/** Constraints and loads at the top of the body; a platen by default. */
struct TopSetup : SideSupport
{
  TopSetup() ///< platen by default
  {
    is_platen = true;
  }

  /** Constrains the top completely. */
  void hold()
  {
    is_platen = false;
    held.fill(true);
  }

  /** Whether the top is completely constrained from the start. */
  bool is_held() const
  {
    return !is_platen && held == std::array<bool, 3>{{true, true, true}};
  }

  /** Whether each node has its own suspension or traction. */
  bool is_suspended_by_nodes() const
  {
    return !is_platen && suspension.is_there();
  }

  /** Whether component @p c along the flat is constrained from the start. */
  bool holds(const unsigned int c) const
  {
    return is_platen ? !(suspension.stiffness[c] > 0.) : held[c];
  }

  /** Components in which a platen moves the top, for @p dim. */
  std::array<bool, 3> moves(const unsigned int dim) const
  {
    std::array<bool, 3> result = {};
    for (unsigned int c = 0; c < dim; ++c)
      result[c] = c + 1 == dim || !holds(c);
    return result;
  }

  /**
   * Whether the top constrains the body along the flat from the start and thus carries
   * the friction.
   */
  bool holds_tangentially() const
  {
    return holds(0);
  }

  /**
   * Whether the top carries the friction: by constraints along the flat or by its
   * suspension.
   */
  bool takes_friction() const
  {
    bool takes = true;
    for (unsigned int c = 0; c < 2; ++c)
      takes = takes && (direction[c] == 0. || holds(c) || suspension.resists(c));
    return takes;
  }

  /**
   * Whether component @p c of @p dim (the last one along the normal) is constrained in
   * statics and modes, where a platen has its own degrees of freedom.
   */
  bool is_fixed(const unsigned int c, const unsigned int dim) const
  {
    return is_platen || (c + 1 < dim ? held[c] : is_held());
  }

  /** Time (s) from which on the top is fixed. */
  double hold_from = std::numeric_limits<double>::infinity();

  /** Unit vector (x, y) along which tangential forces are counted. */
  std::array<double, 2> direction = {{1., 0.}};

  /** Width of a cell of a grid (m). */
  double cell_width = 0.;

  /** Data of each node; on a grid the area may be omitted, push is then the area. */
  SideNodes nodes;

  /** Whether the last column is the periodic copy of the first. */
  bool periodic = false;

  /**
   * Number of locally owned nodes, the first ones; the others are ghost nodes
   * (SharedNodes). Empty: all are owned.
   */
  std::optional<unsigned int> n_owned;
};

/** Forces on the body during one step, per unit thickness. */
struct TopLoad
{
  double normal = 0.; ///< N/m, positive if it presses
  double tangential =
    0.; ///< N/m, transmitted from the contact, along direction; force of springs
};

/** Sampled resultants at the top, per unit thickness. */
struct TopHistory
{
  std::vector<double> normal_force;     ///< N/m, positive if it presses
  std::vector<double> tangential_force; ///< N/m, transmitted from the contact
  std::vector<double> displacement;     ///< mean u_y (m)

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/**
 * Replaces the samples of each rank by their sums over the ranks, the samples of all
 * nodes. Collective.
 */
void sum_over_ranks(TopHistory &samples, const MPI_Comm communicator);

/** Records histories of the top. */
class TopRecorder
{
public:
  /** Samples every @p interval steps; 0: never. */
  explicit TopRecorder(const unsigned int interval)
    : interval(interval)
  {
  }

  /** Whether this step is sampled. */
  bool wants(const std::uint64_t step) const
  {
    return interval > 0 && step % interval == 0;
  }

  /** Adds a sample: mean @p displacement (m) before the step, load during the step. */
  void record(const double displacement, const TopLoad &load);

  /** Samples since the start or the last take(). */
  const TopHistory &history() const
  {
    return samples;
  }

  /** Returns and clears the samples since the last call. */
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
 * The top of the body under its load. Each rank counts loads and work of its owned nodes;
 * the sums over the ranks are the totals. Work is computed with the central increment
 * (u_(n+1) - u_(n-1)) / 2, for which the discrete energy balance is exact.
 */
template <int dim>
class TopSurface : public SurfaceCondition<dim>
{
public:
  /**
   * Top at rest with @p n_nodes nodes on this rank; @p ranks share the top. Collective.
   */
  TopSurface(const TopSetup &setup,
             const StepParameters &step,
             const unsigned int n_nodes,
             const MPI_Comm ranks = MPI_COMM_SELF);

  /** Registers @p recorder for all following steps; it must outlive the last step. */
  void observe(TopRecorder &recorder)
  {
    recorders.push_back(&recorder);
  }

  bool wants_total_force() const override
  {
    return platen.has_value();
  }

  /** Advances the surface by one step under its load. */
  void advance(const SurfaceView<dim> &surface) override;

  /**
   * Initial accelerations (m/s^2) of nodes with these masses (kg, in 2D kg/m) and
   * @p velocity (m/s) by load, weight and suspension, without @p held components and
   * without the load of a platen.
   */
  std::vector<std::array<double, dim>>
  start_acceleration(const std::vector<double> &mass,
                     const std::vector<std::array<bool, dim>> &held,
                     const std::array<double, 3> &velocity) const;

  /** The platen that moves the nodes; null if there is none. */
  const RigidPlaten<dim> *moved_by() const
  {
    return platen ? &*platen : nullptr;
  }

  /** Mass of the suspension at node @p i (kg, in 2D kg/m). */
  double suspended_mass(const unsigned int i) const
  {
    return on_nodes ? nodes.mass(i) : 0.;
  }

  /**
   * Work of load and far end on the nodes of this rank since the start (J, in 2D J/m).
   */
  double work() const
  {
    return total_work + (on_nodes ? nodes.work() : 0.) + (platen ? platen->work() : 0.);
  }

  /** Energies of the suspension, for this rank. */
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
  const unsigned int n_distinct; ///< locally owned nodes
  const MPI_Comm ranks;

  std::vector<double> tributary; ///< tributary area of each node (m^2, in 2D m)
  double n_in_top = 0.;          ///< number of nodes of the whole top

  const bool on_nodes;       ///< each node has its own suspension
  SuspendedNodes<dim> nodes; ///< used if on_nodes
  std::optional<RigidPlaten<dim>> platen;
  std::array<std::vector<double>, dim> increment; ///< previous increment (m)
  std::vector<double> no_mobility;                ///< zeros, one per node
  bool started          = false;
  bool holding          = false;
  double total_work     = 0.;
  double work_this_step = 0.;
  std::vector<TopRecorder *> recorders;
};
} // namespace mesoslip

#endif
