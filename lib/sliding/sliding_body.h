#ifndef mesoslip_sliding_sliding_body_h
#define mesoslip_sliding_sliding_body_h

#include "contact/contact_map.h"
#include "contact/contact_recorder.h"
#include "dynamics/energy_audit.h"
#include "dynamics/explicit_stepper.h"
#include "dynamics/top_surface.h"
#include "grid/halo.h"
#include "grid/row_partition.h"
#include "sliding/loop_profile.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace mesoslip
{
/** What a body on the flat is made of besides its material. */
struct SlidingSetup
{
  StepParameters step;   ///< time step, beta2, damping, body acceleration
  SideConstraints sides; ///< components constrained on the left and right side
  ContactSetup contact;  ///< the flat
  TopSetup top;          ///< the load
  SweepOptions sweep;    ///< instruction set, temporal blocking
  bool periodic = false; ///< in x

  /** Histories of contact and top have a sample every so many steps; 0: none. */
  unsigned int history_interval = 1;

  /** Contact nodes whose motion and tractions are kept with the histories. */
  std::vector<unsigned int> monitored_nodes;

  /** Which share contact and top, each observing its own nodes; on a grid one has all. */
  MPI_Comm ranks = MPI_COMM_SELF;

  /** Numbers in the whole contact of the nodes that this rank owns; not used on a grid. */
  std::vector<unsigned int> contact_places;

  /** Steps in a block of the node statistics; 0: one block for the whole run. */
  std::uint64_t steps_per_block = 0;

  /** Whether the load on each contact node is summed up in every step. */
  bool node_loads = false;

  ContactMapSetup contact_map; ///< what the map of the contact has of which steps

  /** The energy balance has a sample every so many steps; 0: none. */
  unsigned int energy_interval = 0;
};

/** The two loaded surfaces of a body on the flat, and their histories. */
template <int dim>
class SlidingSurfaces
{
public:
  /** For a top of @p n_top_nodes nodes. */
  SlidingSurfaces(const SlidingSetup &setup, const unsigned int n_top_nodes);

  SlidingSurfaces(const SlidingSurfaces &)            = delete; ///< observed in place
  SlidingSurfaces &operator=(const SlidingSurfaces &) = delete; ///< see the constructor

  /** Work done on and dissipated at contact and top since the start, of this rank. */
  BoundaryWork boundary_work() const;

  /** States of all @p n_nodes nodes of the contact, on rank 0. Collective. */
  std::vector<NodeCounts> contact_states(const std::size_t n_nodes);

  /** State between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize_surfaces(Archive &archive)
  {
    archive &contact &contact_recorder &node_statistics &top &top_recorder;
    if (setup.node_loads)
      archive &node_loads;
  }

  const SlidingSetup setup;              ///< completed: widths, periodicity
  ContactSurface<dim> contact;           ///< the bottom
  TopSurface<dim> top;                   ///< the top
  ContactRecorder<dim> contact_recorder; ///< histories of the contact
  NodeLoadObserver<dim> node_loads;      ///< loads of the contact nodes, if wanted
  NodeStatistics<dim> node_statistics;   ///< states of the contact nodes
  ContactMapSampler<dim> contact_map;    ///< samples of all of them
  TopRecorder top_recorder;              ///< histories of the top
};

/**
 * A body on the moving flat, with load, histories and energies: everything of a run but
 * files, signals and checkpoints. Each rank holds a slab of rows; the contact is on rank
 * 0, the top on the last one. The grid has rows, so there is an instance for dim = 2.
 */
template <int dim>
class SlidingBody : public SlidingSurfaces<dim>
{
public:
  /**
   * At rest at u = 0. @p material must outlive the body. @p bottom takes the place of the
   * contact; a @p timer gets the times of the parts of a step.
   */
  SlidingBody(const UniformMaterial &material,
              const SlidingSetup &given,
              const MPI_Comm communicator   = MPI_COMM_SELF,
              SurfaceCondition<dim> *bottom = nullptr,
              Timer *timer                  = nullptr);

  /** State between two steps (Boost.Serialization): own rows and boundaries. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    std::uint64_t n = stepper.step_number();
    archive &n;
    serialize_own_rows(archive, u, rows);
    serialize_own_rows(archive, w, rows);
    this->serialize_surfaces(archive);
    stepper.set_step_number(n);
    if (energy)
      archive &*energy;
  }

  const UniformMaterial &material;     ///< of all cells
  const MPI_Comm communicator;         ///< of the ranks that share the body
  const NodeRows rows;                 ///< node rows of this rank, and ghost rows
  NodalField<double> u;                ///< displacement (m), own and ghost rows
  NodalField<double> w;                ///< velocity of the scheme (m/s)
  MPIHalo halo;                        ///< exchange with the ranks above and below
  LoopProfile profile;                 ///< clocks around the parts of a step
  ExplicitStepper stepper;             ///< the time integration
  std::unique_ptr<EnergyAudit> energy; ///< null without an energy interval
};
} // namespace mesoslip

#endif
