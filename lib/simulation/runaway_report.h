#ifndef mesoslip_simulation_runaway_report_h
#define mesoslip_simulation_runaway_report_h

#include "dynamics/deformation.h"
#include "dynamics/stability_monitor.h"
#include "simulation/contact_parameters.h"
#include "simulation/time_step_choice.h"

namespace mesoslip
{
/**
 * Ends a run that has gone wrong before step @p n.
 * @throws NumericalFailure with energy, likely cause, step, time and node.
 */
[[noreturn]] void report_runaway(const Runaway &found,
                                 const std::uint64_t n,
                                 const TimeStepChoice &time,
                                 const ContactParameters &parameters);

/**
 * Ends a run in which a cell is inside out before step @p n.
 * @throws NumericalFailure with likely cause, step, time and cell.
 */
void require_upright_cells(const Deformation &found,
                           const std::uint64_t n,
                           const TimeStepChoice &time,
                           const ContactParameters &parameters,
                           const UniformMaterial &material);
} // namespace mesoslip

#endif
