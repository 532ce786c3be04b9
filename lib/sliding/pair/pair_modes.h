#ifndef mesoslip_sliding_pair_pair_modes_h
#define mesoslip_sliding_pair_pair_modes_h

#include "eigenvalues/vibration_modes.h"
#include "sliding/pair/pair_body.h"

namespace mesoslip
{
/**
 * The lowest modes of two bodies with absolute displacements, whose constraints @p held are those of their supports. They vibrate
 * apart, or @p touching: contact nodes that no support holds follow what they meet along the normal, and slide without friction.
 * Other options as for vibration_modes(). A vibration with omega^2 below 1e-9 (wave_speed / height)^2, or below what round-off
 * of the highest one leaves, is a rigid motion. @throws std::invalid_argument if there are not as many modes; NotConverged
 */
template <int dim>
VibrationModes<dim> pair_modes(const PairBody<dim> &pair,
                               const DofMask &held,
                               const bool touching,
                               const double wave_speed,
                               const VibrationModesOptions &options);
} // namespace mesoslip

#endif
