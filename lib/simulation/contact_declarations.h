#ifndef mesoslip_simulation_contact_declarations_h
#define mesoslip_simulation_contact_declarations_h

#include "io/parameters.h"
#include "io/raw_parameters.h"

namespace mesoslip
{
/** Upper end of the range of whole numbers that only the machine limits. */
constexpr long most_steps_or_cells = 1000000000;

/** Sections Observation and Snapshots; @p raw knows how many probes the file has. */
void declare_observation(dealii::ParameterHandler &prm, const RawParameters &raw);

/** Sections of the analyses that are not transient. */
void declare_other_analyses(dealii::ParameterHandler &prm);

/** Section Checkpoints. */
void declare_checkpoints(dealii::ParameterHandler &prm);
} // namespace mesoslip

#endif
