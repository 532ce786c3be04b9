#ifndef mesoslip_contact_laws_healing_h
#define mesoslip_contact_laws_healing_h

#include "contact/laws/coefficient_law.h"

#include <cmath>

namespace mesoslip
{
/** Healing of the accumulated slip of a node. */
struct Healing
{
  /** When the accumulated slip is reset. */
  enum class Kind
  {
    none,       ///< never
    separation, ///< when the node leaves the flat
    sticking,   ///< when it sticks or leaves the flat
    time        ///< exponential decay while it sticks or is off the flat
  };

  Kind kind   = Kind::none; ///< kind of healing
  double time = 0.;         ///< decay time of Kind::time (s)

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
