#ifndef mesoslip_sliding_flat_flat_way_h
#define mesoslip_sliding_flat_flat_way_h

#include "sliding/contact_parameters.h"

namespace mesoslip
{
/** An interval (m). */
struct Interval
{
  double from = 0.; ///< lower end
  double to   = 0.; ///< upper end
};

/** Range of the flat's displacement along its direction in a run (m). */
Interval way_of_flat(const ContactParameters &parameters);
} // namespace mesoslip

#endif
