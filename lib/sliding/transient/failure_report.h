#ifndef mesoslip_sliding_transient_failure_report_h
#define mesoslip_sliding_transient_failure_report_h

#include "dynamics/deformation.h"
#include "dynamics/stability_monitor.h"
#include "sliding/contact_parameters.h"
#include "sliding/transient/run_plan.h"

#include <string>

namespace mesoslip
{
/** Largest norm of the strain, and rotation (rad), that the theory is good for. */
constexpr double largest_small_strain = 0.05;

/** A sentence if strain or rotation is beyond small, with the likely cause; or empty. */
std::string large_strain_warning(const Deformation &found,
                                 const ContactParameters &parameters,
                                 const UniformMaterial &material,
                                 const std::string &when);

/** "cell (12, 0) around x = 1.25 mm, y = 0.05 mm is turned inside out, ..."; or empty. */
std::string inverted_cell_text(const Deformation &found,
                               const ContactParameters &parameters,
                               const UniformMaterial &material);

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
