#ifndef mesoslip_contact_node_counts_h
#define mesoslip_contact_node_counts_h

#include <cstdint>
#include <vector>

namespace mesoslip
{
/** What each node took of the load since the start; empty where nobody wants it. */
struct NodeLoads
{
  std::vector<double> normal_force;    ///< sum over the steps (N, in 2D N/m)
  std::vector<double> friction_energy; ///< dissipated (J, in 2D J/m)

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &normal_force &friction_energy;
  }
};

/** Number of steps that each node stuck or slipped in, and in which contact began. */
struct NodeCounts
{
  std::uint64_t first_step = 0; ///< first step of the block, from 0
  std::uint64_t n_steps    = 0; ///< in the block
  std::vector<float> stick;     ///< steps that stuck
  std::vector<float> slip;      ///< steps that slipped
  std::vector<float> landings;  ///< steps in which contact began

  NodeLoads loads; ///< to the end of the block, where they are wanted

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &first_step &n_steps &stick &slip &landings &loads;
  }
};
} // namespace mesoslip

#endif
