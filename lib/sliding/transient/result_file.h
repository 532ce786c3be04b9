#ifndef mesoslip_sliding_transient_result_file_h
#define mesoslip_sliding_transient_result_file_h

#include "io/hdf5_file.h"
#include "sliding/transient/transient_result.h"

namespace mesoslip
{
/**
 * Writes the part of dynamics.h5 common to grids and meshes: /run, /history, /energy,
 * /probes, /reference, the states in /contact, /spectrum and /phase_diagram; history.csv
 * and energy.csv beside it. On rank 0.
 */
void write_result(Hdf5File &file, const TransientResult &run, const RunContext &context);

/** Writes /probes for a body in @p dim dimensions. */
void write_probes(Hdf5File &file,
                  const std::vector<ProbeHistory> &probes,
                  const unsigned int dim);

/** Content of /run of a transient run. */
RunConditions conditions_of_result(const TransientResult &run);

/** Content of /run of a transient run with the time step @p dt and its steady part from
 * @p steady_from to @p steady_to (s). */
RunConditions conditions_of_result(const ContactParameters &parameters,
                                   const double dt,
                                   const double steady_from,
                                   const double steady_to,
                                   const bool limit_cycle_reached);
} // namespace mesoslip

#endif
