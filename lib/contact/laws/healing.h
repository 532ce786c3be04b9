#ifndef mesoslip_contact_laws_healing_h
#define mesoslip_contact_laws_healing_h

#include "contact/laws/slip_law.h"

#include <cmath>

namespace mesoslip
{
/** What becomes of the slip that a node has accumulated. */
struct Healing
{
  /** When it is forgotten. */
  enum class Kind
  {
    none,       ///< never
    separation, ///< once the node is off the flat
    sticking,   ///< once it sticks or is off the flat
    time        ///< exponentially while it sticks or is off the flat
  };

  Kind kind   = Kind::none; ///< when
  double time = 0.;         ///< of Kind::time (s)

  /** The accumulated slip (m) after a step that began with @p slip. */
  double next_slip(const double slip, const SlipStep &step) const
  {
    if (step.touches && !step.sticks)
      return slip + step.slip_rate * step.dt;
    if (kind == Kind::time)
      return slip * std::exp(-step.dt / time);
    const bool forgets =
      kind == Kind::sticking || (kind == Kind::separation && !step.touches);
    return forgets ? 0. : slip;
  }
};
} // namespace mesoslip

#endif
