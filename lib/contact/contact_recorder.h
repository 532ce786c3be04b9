#ifndef mesoslip_contact_contact_recorder_h
#define mesoslip_contact_contact_recorder_h

#include "contact/node_loads.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/** In 3D: motion and force of a contact node along y. */
struct LateralMotion
{
  std::vector<double> u;     ///< displacement (m)
  std::vector<double> v;     ///< velocity (m/s)
  std::vector<double> force; ///< on the body (N)

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &u &v &force;
  }
};

/** Motion and forces of one contact node, a value each sample; y is the normal of the flat
 * also in 3D; forces in 2D per unit thickness. */
struct MonitoredNode
{
  std::vector<double> ux;               ///< displacement (m)
  std::vector<double> uy;               ///< displacement (m)
  std::vector<double> vx;               ///< velocity (m/s)
  std::vector<double> vy;               ///< velocity (m/s)
  std::vector<double> normal_force;     ///< N/m, positive when pressed
  std::vector<double> tangential_force; ///< N/m, on the body, along x
  LateralMotion across;                 ///< empty in 2D

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &ux &uy &vx &vy &normal_force &tangential_force &across;
  }
};

/** Sampled resultants; energies are those dissipated from the start to the end of the
 * step. */
struct ContactHistory
{
  std::vector<std::uint64_t> step;      ///< number of the sampled step
  std::vector<double> time;             ///< s
  std::vector<double> normal_force;     ///< N/m, positive when pressed
  std::vector<double> tangential_force; ///< N/m, on the body, along the flat's motion
  std::vector<double> sticking;         ///< number of nodes that stick
  std::vector<double> slipping;         ///< number of nodes that slip
  std::vector<double> separated;        ///< numbers of nodes
  std::vector<double> friction_energy;  ///< J/m
  std::vector<double> impact_energy;    ///< J/m
  std::vector<double> load_work;        ///< integral of F_N |V| since the start (J/m)
  std::vector<MonitoredNode> nodes;     ///< those that are monitored

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &step &time &normal_force &tangential_force &sticking &slipping &separated;
    archive &friction_energy &impact_energy &load_work &nodes;
  }
};

/**
 * Makes samples of the nodes of each rank those of all nodes: every rank gets the sums.
 * Collective.
 */
void sum_over_ranks(ContactHistory &samples, const MPI_Comm communicator);

/** Turns motion and forces of the nodes: x becomes @p direction, of length one, along which
 * the flat moves, and what was along y is what is across. */
void turn_along_flat(ContactHistory &samples, const std::array<double, 2> &direction);

/** Histories of the contact: resultants, and motion and forces of some nodes. */
template <int dim>
class ContactRecorder : public ContactObserver<dim>
{
public:
  /** A sample every @p interval steps (0: none), with those of the given nodes, zero for
   * SharedNodes::none. */
  ContactRecorder(const unsigned int interval,
                  const std::vector<unsigned int> &nodes,
                  const StepParameters &step);

  bool wants(const std::uint64_t step) const override
  {
    return interval > 0 && step % interval == 0;
  }
  void before(const SurfaceView<dim> &surface) override;
  void after(const SurfaceView<dim> &surface, ContactSurface<dim> &contact) override;

  /** What was sampled so far, or since take(). */
  const ContactHistory &history() const
  {
    return samples;
  }

  /** Takes out what was sampled since the last call. */
  ContactHistory take();

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &samples;
  }

private:
  /** u_n and w_n of a monitored node. */
  struct Motion
  {
    std::array<double, dim> u = {}, w = {};
  };

  const unsigned int interval;
  const std::vector<unsigned int> nodes;
  const double beta2;
  std::vector<Motion> motion_before;
  ContactHistory samples;
};

/**
 * Of counts of the nodes of each rank those of the whole contact of @p n_nodes on rank 0;
 * the first nodes of the counts are number @p places there. @p with_loads: as the blocks of
 * all ranks have them. Collective.
 */
std::vector<NodeCounts> gather_nodes(const std::vector<NodeCounts> &blocks,
                                     const std::vector<unsigned int> &places,
                                     const std::size_t n_nodes,
                                     const bool with_loads,
                                     const MPI_Comm communicator);

/** States of the nodes, counted in blocks of steps, and what @p node_loads counts to the end of
 * each block. */
template <int dim>
class NodeStatistics : public ContactObserver<dim>
{
public:
  /** @p steps_per_block 0: one block for the whole run; @p node_loads may be null. */
  explicit NodeStatistics(const std::uint64_t steps_per_block,
                          const NodeLoadObserver<dim> *node_loads = nullptr)
    : node_loads(node_loads)
    , steps_per_block(steps_per_block)
  {
  }

  bool wants(const std::uint64_t) const override
  {
    return true;
  }
  void before(const SurfaceView<dim> &) override
  {
  }
  void after(const SurfaceView<dim> &surface, ContactSurface<dim> &contact) override;

  /** Closes the running block. */
  void finish(ContactSurface<dim> &contact);

  /** Complete blocks and, after finish(), the last, shorter one. */
  const std::vector<NodeCounts> &blocks() const
  {
    return complete_blocks;
  }

  /** Saves or restores the state between two steps (Boost.Serialization). A run that is
   * continued with another length of blocks keeps its own. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &steps_per_block &n_steps &complete_blocks;
  }

private:
  const NodeLoadObserver<dim> *const node_loads;
  std::uint64_t steps_per_block;
  std::uint64_t n_steps = 0; ///< counted in the running block
  std::vector<NodeCounts> complete_blocks;
};
} // namespace mesoslip

#endif
