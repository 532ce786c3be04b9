#ifndef mesoslip_simulation_run_report_h
#define mesoslip_simulation_run_report_h

#include "elasticity/uniform_material.h"
#include "simulation/contact_parameters.h"
#include "simulation/scene.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Grid, materials and friction coefficients, and which keys or file they are from;
 * lines. */
std::vector<std::string> body_text(const ContactParameters &parameters,
                                   const Scene &scene);

/** "A wave takes 0.008 ms from the flat to the top, the run 1 ms". */
std::string crossing_text(const ContactParameters &parameters,
                          const UniformMaterial &material);

/** What looks like a slip of units in the body and the load of a static contact analysis;
 *  sentences. */
std::vector<std::string> body_warnings(const ContactParameters &parameters,
                                       const Scene &scene);

/** The same of a transient run: its times, loads, velocities, law and damping, and
 * sliding with nothing that stops the waves of the grid. */
std::vector<std::string> transient_warnings(const ContactParameters &parameters,
                                            const UniformMaterial &material);
} // namespace mesoslip

#endif
