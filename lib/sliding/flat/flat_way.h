#ifndef mesoslip_sliding_flat_flat_way_h
#define mesoslip_sliding_flat_flat_way_h

#include "sliding/contact_parameters.h"

namespace mesoslip
{
/** From one end to the other (m). */
struct Interval
{
  double from = 0., to = 0.;
};

/** What the flat moves along its direction in a run (m). */
Interval way_of_flat(const ContactParameters &parameters);
} // namespace mesoslip

#endif
