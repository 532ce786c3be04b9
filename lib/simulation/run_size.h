#ifndef mesoslip_simulation_run_size_h
#define mesoslip_simulation_run_size_h

#include "elasticity/uniform_material.h"
#include "io/resources.h"
#include "simulation/contact_parameters.h"

namespace mesoslip
{
/**
 * Snapshots that a transient run of @p n_steps takes, at most one a step.
 * @throws UserError when they begin after the end
 */
double n_snapshots(const ContactParameters &parameters, const double n_steps);

/** Memory of the fields, to be checked before they are created.*/
ResourceNeed field_memory(const ContactAnalysis analysis, const UniformGrid<2> &grid);

/**
 * Steps of a transient run, estimated from above: with the bound of a single cell for the
 * time step, or the time step given.
 */
double largest_number_of_steps(const ContactParameters &parameters,
                               const UniformMaterial &material);

/** Time (s) in which a longitudinal wave crosses the height of the body, in its fastest
 * material.*/
double crossing_time(const UniformMaterial &material);

/**
 * "Time/Rayleigh beta = ... makes <shortened> 20 times shorter than without damping; is
 * it in s?" where the critical time step of a single cell would be more than ten times
 * longer without it; otherwise empty.
 */
std::string damping_warning(const ContactParameters &parameters,
                            const UniformMaterial &material,
                            const std::string &shortened);

/** Memory of the histories, which are kept until the end of a transient run. */
ResourceNeed history_memory(const ContactParameters &parameters,
                            const UniformMaterial &material,
                            const double n_steps);

/** Disk space of dynamics.h5 and the checkpoints of a transient run, when it is largest.
 */
ResourceNeed dynamics_file_size(const ContactParameters &parameters,
                                const UniformMaterial &material,
                                const double n_steps);
} // namespace mesoslip

#endif
