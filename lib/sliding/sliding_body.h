#ifndef mesoslip_sliding_sliding_body_h
#define mesoslip_sliding_sliding_body_h

#include "contact/contact_map.h"
#include "contact/contact_recorder.h"
#include "contact/pair/paired_contact.h"
#include "dynamics/energy_audit.h"
#include "dynamics/grid/explicit_stepper.h"
#include "dynamics/supports/side_column.h"
#include "dynamics/supports/top_surface.h"
#include "grid/halo.h"
#include "grid/row_partition.h"
#include "sliding/loop_profile.h"
#include "sliding/supports/shared_sides.h"

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace mesoslip
{
/** Setup of a body on the flat, without its material. */
struct SlidingSetup
{
  StepParameters step;            ///< time step, beta2, damping, body acceleration
  SideConstraints sides;          ///< components constrained on the left and right side
  ContactSetup contact;           ///< the flat
  TopSetup top;                   ///< the load
  std::vector<LoadedSide> loaded; ///< loaded sides other than the top, platens first
  SweepOptions sweep;             ///< instruction set, temporal blocking
  bool periodic = false;          ///< periodic in x

  /** Steps between samples of contact and top histories; 0: no histories. */
  unsigned int history_interval = 1;

  /** Steps between probe samples. */
  unsigned int probe_interval = 1;

  /** Contact nodes whose motion and tractions are stored with the histories. */
  std::vector<unsigned int> monitored_nodes;

  /** Ranks that share contact and top, each observing its own nodes; on a grid a single
   * rank. */
  MPI_Comm ranks = MPI_COMM_SELF;

  MPI_Comm platen_ranks = MPI_COMM_SELF; ///< ranks that share the platens of the sides

  /** Numbers in the whole contact of the locally owned nodes. */
  std::vector<unsigned int> contact_places;

  /** Steps in a block of the node statistics; 0: one block for the whole run. */
  std::uint64_t steps_per_block = 0;

  /** Whether the load on each contact node is accumulated in every step. */
  bool node_loads = false;

  ContactMapSetup contact_map; ///< fields and steps of the contact map

  /** Steps between samples of the energy balance; 0: none. */
  unsigned int energy_interval = 0;
};

template <int dim>
struct CounterMotion;

/**
 * A body on the moving flat, with load, histories and energies: a run without files,
 * signals and checkpoints. Derived classes define the material and the time integration.
 */
template <int dim>
class SlidingBody
{
public:
  virtual ~SlidingBody() = default;

  SlidingBody(const SlidingBody &)            = delete; ///< observed in place
  SlidingBody &operator=(const SlidingBody &) = delete; ///< see the constructor

  /** Time integration of displacement and velocity. */
  virtual Stepper &time_integration() = 0;

  /** Contact with a counter body; else null. */
  const PairedContact<dim> *paired() const
  {
    return pair.get();
  }

  /** Work done on and dissipated at contact and top since the start, on this rank. */
  BoundaryWork boundary_work() const;

  /** States of all @p n_nodes nodes of the contact, on rank 0. Collective. */
  std::vector<NodeCounts> contact_states(const std::size_t n_nodes);

  /** State between two steps (Boost.Serialization), for the same number of ranks: locally
   * owned rows, surfaces and energies. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    Stepper &stepper = time_integration();
    std::uint64_t n  = stepper.step_number();
    archive &n;
    serialize_own_rows(archive, stepper.u, stepper.rows);
    serialize_own_rows(archive, stepper.w, stepper.rows);
    stepper.set_step_number(n);
    archive &contact &contact_recorder &node_statistics &top &top_recorder;
    for (RigidPlaten<dim> &platen : platens)
      archive &platen;
    for (SideSurface<dim> &side : sides)
      archive &side;
    if (setup.node_loads)
      archive &node_loads;
    if (energy)
      archive &*energy;
    if (pair)
      archive &*pair;
  }

  /** Saves or restores the motion of locally owned rows and the memory of the contact
   * (Boost.Serialization). A run of the same body may start from it, with different
   * loads and material. */
  template <class Archive>
  void serialize_end(Archive &archive)
  {
    Stepper &stepper = time_integration();
    serialize_own_rows(archive, stepper.u, stepper.rows);
    serialize_own_rows(archive, stepper.w, stepper.rows);
    contact.serialize_memory(archive);
  }

  const SlidingSetup setup;              ///< completed: widths, periodicity
  ContactSurface<dim> contact;           ///< the bottom
  TopSurface<dim> top;                   ///< the top
  std::deque<RigidPlaten<dim>> platens;  ///< on other sides, loaded ones first
  std::deque<SideSurface<dim>> sides;    ///< the remaining loaded sides, in this order
  ContactRecorder<dim> contact_recorder; ///< histories of the contact
  NodeLoadObserver<dim> node_loads;      ///< loads of the contact nodes, if requested
  NodeStatistics<dim> node_statistics;   ///< states of the contact nodes
  ContactMapSampler<dim> contact_map;    ///< samples of the contact map
  TopRecorder top_recorder;              ///< histories of the top
  LoopProfile profile;                   ///< clocks around the parts of a step
  std::unique_ptr<EnergyAudit> energy;   ///< null without an energy interval

protected:
  /** Initial state: at rest, u = 0, with @p n_top_nodes nodes of the top. A @p timer,
   * which may be null, gets the times of the parts of a step. */
  SlidingBody(const SlidingSetup &setup, const unsigned int n_top_nodes, Timer *timer);

  /** Boundary condition of the locally stored contact @p nodes: contact with the flat, or
   * with @p counter if there is one. Collective over the @p communicator. */
  SurfaceCondition<dim> &contact_condition(CounterMotion<dim> *counter,
                                           const NodesOfContact &nodes,
                                           const MPI_Comm communicator);

  /** Observes the energies; call it once time_integration() exists. */
  void watch_energy();

  /** Starts paired contact nodes that press on each other with their common acceleration,
   * once both bodies have started. */
  void start_together();

  /** Sets the normal velocities of the scheme at the contact according to
   * contact_start. */
  virtual void start_contact() = 0;

  NormalStart
    contact_start; ///< initial state of the contact nodes along the normal, set by
                   ///< set_initial_velocity()

private:
  void add_platen(const LoadedSide &side);

  SlidingBody<dim> *below = nullptr;        ///< the counter body; null: the flat is rigid
  std::unique_ptr<PairedContact<dim>> pair; ///< contact with it
};

/** Contact nodes of a grid with this completed @p setup; if it is periodic, the last node
 * is a copy of the first. */
NodesOfContact nodes_of_contact(const SlidingSetup &setup);

/**
 * A body on a plane grid. Each rank holds a slab of rows; the contact is on rank 0, the
 * top on the last rank.
 */
class SlidingGrid : public SlidingBody<2>
{
public:
  /**
   * Initial state: at rest, u = 0. @p material must outlive the body. @p bottom replaces
   * the contact. A @p timer gets the times of the parts of a step. On the rank of the
   * contact the body is above @p counter, if there is one; their contact nodes are
   * paired.
   */
  SlidingGrid(const UniformMaterial &material,
              const SlidingSetup &given,
              const MPI_Comm communicator = MPI_COMM_SELF,
              SurfaceCondition<2> *bottom = nullptr,
              Timer *timer                = nullptr,
              CounterMotion<2> *counter   = nullptr);

  Stepper &time_integration() override
  {
    return stepper;
  }

  /** Sets the velocities of the scheme at beta2 dt before the start (see
   * ExplicitStepper), for a body that starts with @p velocity (m/s); zero where it is
   * held. */
  void set_initial_velocity(const std::array<double, 3> &velocity);

private:
  void start_contact() override;
  NodalField<double> start_acceleration(const std::array<double, 3> &v) const;
  void load_top(const std::array<double, 3> &v,
                std::vector<double> &whole,
                NodalField<double> &a) const;
  void start_as_one(const RigidPlaten<2> &platen,
                    const std::vector<NodeIndex> &nodes,
                    const std::vector<double> &mass,
                    const std::array<double, 3> &v,
                    NodalField<double> &a) const;
  void load_side(const std::size_t k,
                 const unsigned int l,
                 const std::array<double, 3> &v,
                 std::vector<double> &whole,
                 NodalField<double> &a) const;

public:
  const UniformMaterial &material; ///< the grid, with stiffness and density of its cells
  const std::optional<UniformMaterial> damping; ///< phases_of_damping(), if there are any
  const MPI_Comm communicator;                  ///< ranks that share the body
  const NodeRows rows;                     ///< locally owned node rows and ghost rows
  NodalField<double> u;                    ///< displacement (m), owned and ghost rows
  NodalField<double> w;                    ///< velocity of the scheme (m/s)
  MPIHalo halo;                            ///< exchange with the ranks above and below
  std::deque<PlatenColumn> platen_columns; ///< sides that platens move
  std::deque<SideColumn> columns;          ///< sides under a load
  ExplicitStepper stepper;                 ///< the time integration
};
} // namespace mesoslip

#endif
