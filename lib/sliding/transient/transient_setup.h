#ifndef mesoslip_sliding_transient_transient_setup_h
#define mesoslip_sliding_transient_transient_setup_h

#include "observation/probe_recorder.h"
#include "observation/steady_state.h"
#include "sliding/contact_parameters.h"
#include "sliding/scene.h"
#include "sliding/sliding_body.h"
#include "sliding/transient/run_plan.h"

#include <vector>

namespace mesoslip
{
/**
 * @name What the parts of a transient run are made from, by parameters and scene
 * @{
 */
/** Column of the reference contact node M. */
unsigned int reference_node(const ContactParameters &parameters,
                            const UniformGrid<2> &grid);

/** Supports, flat, load, and what is observed. */
SlidingSetup sliding_setup(const ContactParameters &parameters,
                           const Scene &scene,
                           const TimeStepChoice &time);

/** Whether the top takes tangential forces; otherwise they are those of the contact. */
bool transmits_tangential_force(const TopSetup &top);

/** Instruction set and number of time steps in flight. */
SweepOptions sweep_options(const ContactParameters &parameters);

/** Tolerance, periods and windows asked for, with the contact nodes that are watched. */
LimitCycleCriterion limit_cycle_criterion(const ContactParameters &parameters,
                                          const UniformGrid<2> &grid);

/** Positions of the probes, moved to the nearest node where that is wanted. */
std::vector<ProbeRecorder::Point> probe_points(const ObservationParameters &observation,
                                               const UniformGrid<2> &grid);

/** Velocity of the body at the start (m/s), zero where it is held. */
void set_initial_velocity(const ContactParameters &parameters,
                          const NodeRows &rows,
                          NodalField<double> &w);
/** @} */
} // namespace mesoslip

#endif
