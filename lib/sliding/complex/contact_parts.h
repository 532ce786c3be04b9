#ifndef mesoslip_sliding_complex_contact_parts_h
#define mesoslip_sliding_complex_contact_parts_h

#include "base/serialize_members.h"
#include "eigenvalues/complex/complex_modes.h"
#include "sliding/complex/sliding_state.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Contribution of a phase of the contact to a mode. */
struct PartOfMode
{
  double growth_by_friction = 0.; ///< contribution of its nodes to the growth rate (1/s)
  double motion = 0.; ///< share of the mean square motion; the sum over phases is 1

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<2>(archive, *this);
  }
};

/** The phases of the body at its contact. */
struct ContactParts
{
  std::vector<std::string> names; ///< phase names

  /** For each phase, its share of the tributary area of each node of ElasticBody::surface(). */
  std::vector<std::vector<double>> shares;

  /** Whether there is more than one phase. */
  bool differ() const
  {
    return names.size() > 1;
  }

  /** Share of each phase in the area of the nodes that slide in @p state. */
  std::vector<double> of_contact(const SlidingState &state) const;

  /**
   * Contributions by phase. Growth: sum over the sliding nodes of the phase's share
   * times the node's part of the growth. Motion: sum of share times |u|^2 times area,
   * over the same sum of all phases. Empty with one phase.
   */
  std::vector<PartOfMode> of_mode(const ComplexMode &mode,
                                  const SlidingState &state) const;
};
} // namespace mesoslip

#endif
