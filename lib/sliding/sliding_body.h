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
/** What a body on the flat is made of besides its material. */
struct SlidingSetup
{
  StepParameters step;            ///< time step, beta2, damping, body acceleration
  SideConstraints sides;          ///< components constrained on the left and right side
  ContactSetup contact;           ///< the flat
  TopSetup top;                   ///< the load
  std::vector<LoadedSide> loaded; ///< other sides that are not just held, platens first
  SweepOptions sweep;             ///< instruction set, temporal blocking
  bool periodic = false;          ///< in x

  /** Histories of contact and top have a sample every so many steps; 0: none. */
  unsigned int history_interval = 1;

  /** Probes have a sample every so many steps. */
  unsigned int probe_interval = 1;

  /** Contact nodes whose motion and tractions are kept with the histories. */
  std::vector<unsigned int> monitored_nodes;

  /** Which share contact and top, each observing its own nodes; on a grid one has all. */
  MPI_Comm ranks = MPI_COMM_SELF;

  MPI_Comm platen_ranks = MPI_COMM_SELF; ///< which share platens at the sides

  /** Numbers in the whole contact of the nodes that this rank owns. */
  std::vector<unsigned int> contact_places;

  /** Steps in a block of the node statistics; 0: one block for the whole run. */
  std::uint64_t steps_per_block = 0;

  /** Whether the load on each contact node is summed up in every step. */
  bool node_loads = false;

  ContactMapSetup contact_map; ///< what the map of the contact has of which steps

  /** The energy balance has a sample every so many steps; 0: none. */
  unsigned int energy_interval = 0;
};

template <int dim>
struct CounterMotion;

/**
 * A body on the moving flat, with load, histories and energies: everything of a run but
 * files, signals and checkpoints. What it is made of, and how its fields are advanced, is
 * for derived classes to say.
 */
template <int dim>
class SlidingBody
{
public:
  virtual ~SlidingBody() = default;

  SlidingBody(const SlidingBody &)            = delete; ///< observed in place
  SlidingBody &operator=(const SlidingBody &) = delete; ///< see the constructor

  /** What advances displacement and velocity. */
  virtual Stepper &time_integration() = 0;

  /** With a second body; else null. */
  const PairedContact<dim> *paired() const
  {
    return pair.get();
  }

  /** Work done on and dissipated at contact and top since the start, of this rank. */
  BoundaryWork boundary_work() const;

  /** States of all @p n_nodes nodes of the contact, on rank 0. Collective. */
  std::vector<NodeCounts> contact_states(const std::size_t n_nodes);

  /** State between two steps (Boost.Serialization), for the same ranks: own rows, surfaces
   * and energies. */
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

  /** Saves or restores the motion of own rows and what the contact remembers, from which a run of the same
   * body may start (Boost.Serialization); its loads and its material may be others. */
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
  std::deque<RigidPlaten<dim>> platens;  ///< at other sides, the first ones loaded
  std::deque<SideSurface<dim>> sides;    ///< that are loaded besides, in this order
  ContactRecorder<dim> contact_recorder; ///< histories of the contact
  NodeLoadObserver<dim> node_loads;      ///< loads of the contact nodes, if wanted
  NodeStatistics<dim> node_statistics;   ///< states of the contact nodes
  ContactMapSampler<dim> contact_map;    ///< samples of all of them
  TopRecorder top_recorder;              ///< histories of the top
  LoopProfile profile;                   ///< clocks around the parts of a step
  std::unique_ptr<EnergyAudit> energy;   ///< null without an energy interval

protected:
  /** At rest at u = 0, for a top of @p n_top_nodes nodes. A @p timer, which may be null, gets the
   * times of the parts of a step. */
  SlidingBody(const SlidingSetup &setup, const unsigned int n_top_nodes, Timer *timer);

  /** What moves the @p nodes of the contact that this rank has: the contact, which is that with @p counter where there is one.
   * Collective over the @p communicator. */
  SurfaceCondition<dim> &contact_condition(CounterMotion<dim> *counter,
                                           const NodesOfContact &nodes,
                                           const MPI_Comm communicator);

  /** To be called once time_integration() is there: observes the energies. */
  void watch_energy();

  /** Starts partners that press on each other with their common acceleration, once both bodies have started. */
  void start_together();

  /** Sets the velocities of the scheme along the normal at the contact as contact_start tells. */
  virtual void start_contact() = 0;

  NormalStart
    contact_start; ///< of the nodes of the contact, after set_initial_velocity()

private:
  void add_platen(const LoadedSide &side);

  SlidingBody<dim> *below = nullptr;        ///< the second body; null: the flat is rigid
  std::unique_ptr<PairedContact<dim>> pair; ///< with it
};

/** The nodes of the contact of a grid with this completed @p setup, whose last one duplicates the first where it is periodic. */
NodesOfContact nodes_of_contact(const SlidingSetup &setup);

/**
 * On a plane grid. Each rank holds a slab of rows; the contact is on rank 0, the top on the
 * last one.
 */
class SlidingGrid : public SlidingBody<2>
{
public:
  /**
   * At rest at u = 0. @p material must outlive the body. @p bottom takes the place of the
   * contact; a @p timer gets the times of the parts of a step; on the rank of the contact the body
   * is above @p counter, if there is one, whose nodes at the contact are partners of its own.
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

  /** The velocities of the scheme, of beta2 dt before the start (see ExplicitStepper), of a
   * body that starts with @p velocity (m/s); zero where it is held. */
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
  const std::optional<UniformMaterial> damping; ///< of phases_of_damping(), if there are
  const MPI_Comm communicator;                  ///< of the ranks that share the body
  const NodeRows rows;                     ///< node rows of this rank, and ghost rows
  NodalField<double> u;                    ///< displacement (m), own and ghost rows
  NodalField<double> w;                    ///< velocity of the scheme (m/s)
  MPIHalo halo;                            ///< exchange with the ranks above and below
  std::deque<PlatenColumn> platen_columns; ///< sides that platens move
  std::deque<SideColumn> columns;          ///< sides under a load
  ExplicitStepper stepper;                 ///< the time integration
};
} // namespace mesoslip

#endif
