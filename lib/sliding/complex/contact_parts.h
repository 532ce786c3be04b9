#ifndef mesoslip_sliding_complex_contact_parts_h
#define mesoslip_sliding_complex_contact_parts_h

#include "base/serialize_members.h"
#include "eigenvalues/complex/complex_modes.h"
#include "sliding/complex/sliding_state.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** What a phase of the contact has of a mode. */
struct PartOfMode
{
  double growth_by_friction = 0.; ///< what its nodes add to the growth rate (1/s)
  double motion = 0.; ///< of the mean square motion along the flat, all phases have one

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<2>(archive, *this);
  }
};

/** The phases of the body at its contact. */
struct ContactParts
{
  std::vector<std::string> names; ///< of the phases

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
   * Of each phase the sum over the nodes that slide of its share times the node's part of the
   * growth, and times |u|^2 and area, over that sum of all phases. Empty with one phase.
   */
  std::vector<PartOfMode> of_mode(const ComplexMode &mode,
                                  const SlidingState &state) const;
};
} // namespace mesoslip

#endif
