#ifndef mesoslip_contact_node_counts_h
#define mesoslip_contact_node_counts_h

#include <cstdint>
#include <vector>

namespace mesoslip
{
/** Load of each node since the start; empty if not requested. */
struct NodeLoads
{
  std::vector<double> normal_force;    ///< sum over the steps (N, in 2D N/m)
  std::vector<double> friction_energy; ///< energy dissipated by friction (J, in 2D J/m)

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &normal_force &friction_energy;
  }
};

/** Number of steps of each node with stick, with slip, and with a begin of contact. */
struct NodeCounts
{
  std::uint64_t first_step = 0; ///< first step of the block, from 0
  std::uint64_t n_steps    = 0; ///< steps in the block
  std::vector<float> stick;     ///< steps in which the node stuck
  std::vector<float> slip;      ///< steps in which the node slipped
  std::vector<float> landings;  ///< steps in which contact began

  NodeLoads loads; ///< loads at the end of the block, if requested

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &first_step &n_steps &stick &slip &landings &loads;
  }
};
} // namespace mesoslip

#endif
