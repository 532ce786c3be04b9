#ifndef mesoslip_sliding_plausible_input_h
#define mesoslip_sliding_plausible_input_h

#include "elasticity/uniform_material.h"
#include "sliding/contact_parameters.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Sentences on a pressure of a static contact analysis that looks like another unit. */
std::vector<std::string> implausible_static_load(const ContactParameters &parameters,
                                                 const UniformMaterial &material);

/** "A wave takes 0.008 ms from the flat to the top, the run 1 ms". */
std::string crossing_text(const ContactParameters &parameters,
                          const UniformMaterial &material);

/**
 * The same on the times, loads, velocities, friction law, damping and intervals of a
 * transient run, loads given as expressions included; and on sliding with nothing that
 * stops the waves of the grid.
 */
std::vector<std::string> implausible_run(const ContactParameters &parameters,
                                         const UniformMaterial &material);
} // namespace mesoslip

#endif
