#ifndef mesoslip_sliding_sweep_run_end_h
#define mesoslip_sliding_sweep_run_end_h

#include "sliding/sliding_body.h"

#include <mpi.h>
#include <string>

namespace mesoslip
{
/** Path of the file with the final motion of a run in @p folder (Checkpoints/Write
 * end). */
std::string run_end_file(const std::string &folder);

/** Loads at the end of a run. */
struct LoadsAtEnd
{
  double flat_velocity = 0.; ///< m/s
  double pressure      = 0.; ///< on the top (Pa)
};

/** Final loads of the run in @p folder. Collective.
 * @throws UserError */
LoadsAtEnd loads_at_end(const std::string &folder, const MPI_Comm communicator);

/** Writes run_end_file(), from which a run of the same body may start, at @p time (s).
 * Collective.
 * @throws UserError */
template <int dim>
void write_run_end(SlidingBody<dim> &body,
                   const double time,
                   const std::string &folder,
                   const MPI_Comm communicator);

/** Gives @p body the motion at the end of the run in @p folder. Collective.
 * @throws UserError if the file is from another body, or from another number of ranks */
template <int dim>
void start_from_end(SlidingBody<dim> &body,
                    const std::string &folder,
                    const MPI_Comm communicator);
} // namespace mesoslip

#endif
