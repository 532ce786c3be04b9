#ifndef mesoslip_contact_contact_recorder_h
#define mesoslip_contact_contact_recorder_h

#include "contact/node_loads.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/** In 3D: motion and force of a contact node along y, one value per sample. */
struct LateralMotion
{
  std::vector<double> u;     ///< displacement (m)
  std::vector<double> v;     ///< velocity (m/s)
  std::vector<double> force; ///< force on the body (N)

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &u &v &force;
  }
};

/**
 * Motion and forces of one contact node, one value per sample. y is the normal of the
 * flat, also in 3D; forces in 2D are per unit thickness.
 */
struct MonitoredNode
{
  std::vector<double> ux;               ///< displacement (m)
  std::vector<double> uy;               ///< displacement (m)
  std::vector<double> vx;               ///< velocity (m/s)
  std::vector<double> vy;               ///< velocity (m/s)
  std::vector<double> normal_force;     ///< N/m, positive when pressed
  std::vector<double> tangential_force; ///< N/m, on the body, along x
  std::vector<double> gap; ///< gap (m), negative while a contact spring is compressed
  LateralMotion across;    ///< empty in 2D

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &ux &uy &vx &vy &normal_force &tangential_force &gap &across;
  }
};

/** Sampled resultants; energies are dissipated from the start to the end of the step. */
struct ContactHistory
{
  std::vector<std::uint64_t> step;      ///< number of the sampled step
  std::vector<double> time;             ///< s
  std::vector<double> normal_force;     ///< N/m, positive when pressed
  std::vector<double> tangential_force; ///< N/m, on the body, along the flat's motion
  std::vector<double> sticking;         ///< number of nodes that stick
  std::vector<double> slipping;         ///< number of nodes that slip
  std::vector<double> separated;        ///< number of separated nodes
  std::vector<double> friction_energy;  ///< dissipated by friction (J/m)
  std::vector<double> impact_energy;    ///< dissipated by normal forces (J/m)
  std::vector<double> load_work;        ///< integral of F_N |V| since the start (J/m)
  std::vector<MonitoredNode> nodes;     ///< monitored nodes

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &step &time &normal_force &tangential_force &sticking &slipping &separated;
    archive &friction_energy &impact_energy &load_work &nodes;
  }
};

/**
 * Replaces the samples of each rank by their sums over the ranks, the samples of all
 * nodes. Collective.
 */
void sum_over_ranks(ContactHistory &samples, const MPI_Comm communicator);

/**
 * Rotates motion and forces of the nodes: x becomes the unit vector @p direction of the
 * flat's motion, y the direction across it.
 */
void turn_along_flat(ContactHistory &samples, const std::array<double, 2> &direction);

/** Histories of the contact: resultants, and motion and forces of selected nodes. */
template <int dim>
class ContactRecorder : public ContactObserver<dim>
{
public:
  /**
   * Samples every @p interval steps (0: never), including the given @p nodes;
   * SharedNodes::none gives zeros.
   */
  ContactRecorder(const unsigned int interval,
                  const std::vector<unsigned int> &nodes,
                  const StepParameters &step);

  bool wants(const std::uint64_t step) const override
  {
    return interval > 0 && step % interval == 0;
  }
  void before(const SurfaceView<dim> &surface) override;
  void after(const SurfaceView<dim> &surface, ContactSurface<dim> &contact) override;

  /** Samples since the start or the last take(). */
  const ContactHistory &history() const
  {
    return samples;
  }

  /** Returns and clears the samples since the last call. */
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
 * Gathers the counts of all ranks on rank 0 as counts of the whole contact with
 * @p n_nodes nodes; @p places are the indices there of the first nodes of the counts.
 * @p with_loads: blocks contain loads, the same on all ranks. Collective.
 */
std::vector<NodeCounts> gather_nodes(const std::vector<NodeCounts> &blocks,
                                     const std::vector<unsigned int> &places,
                                     const std::size_t n_nodes,
                                     const bool with_loads,
                                     const MPI_Comm communicator);

/**
 * Counts states of the nodes in blocks of steps, and stores the loads of @p node_loads at
 * the end of each block.
 */
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

  /** Closes the current block. */
  void finish(ContactSurface<dim> &contact);

  /** Complete blocks and, after finish(), the last block, which may be shorter. */
  const std::vector<NodeCounts> &blocks() const
  {
    return complete_blocks;
  }

  /**
   * Saves or restores the state between two steps (Boost.Serialization). A continued run
   * keeps the saved length of blocks.
   */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &steps_per_block &n_steps &complete_blocks;
  }

private:
  const NodeLoadObserver<dim> *const node_loads;
  std::uint64_t steps_per_block;
  std::uint64_t n_steps = 0; ///< steps in the current block
  std::vector<NodeCounts> complete_blocks;
};
} // namespace mesoslip

#endif
