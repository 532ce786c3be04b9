#ifndef mesoslip_sliding_pair_pair_modes_h
#define mesoslip_sliding_pair_pair_modes_h

#include "eigenvalues/vibration_modes.h"
#include "sliding/pair/pair_body.h"

namespace mesoslip
{
/**
 * The lowest modes of two bodies with absolute displacements, under the constraints
 * @p held of their supports. The bodies vibrate separately or, if @p touching, contact
 * nodes that no support holds follow the opposite surface along the normal and slide
 * without friction. Options as for vibration_modes(). A mode with omega^2 below 1e-9
 * (wave_speed / height)^2, or below the round-off of the highest mode, is a rigid
 * motion.
 * @throws std::invalid_argument if there are fewer modes; NotConverged
 */
template <int dim>
VibrationModes<dim> pair_modes(const PairBody<dim> &pair,
                               const DofMask &held,
                               const bool touching,
                               const double wave_speed,
                               const VibrationModesOptions &options);
} // namespace mesoslip

#endif
