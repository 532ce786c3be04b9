#ifndef mesoslip_sliding_counter_counter_motion_h
#define mesoslip_sliding_counter_counter_motion_h

#include "contact/pair/paired_contact.h"
#include "observation/probe_recorder.h"
#include "sliding/sliding_body.h"

#include <functional>
#include <memory>

namespace mesoslip
{
struct FieldRows;

/** A counter body, which moves below the first body. */
template <int dim>
struct CounterMotion
{
  std::unique_ptr<PartnerSurface<dim>> partner; ///< moves its contact nodes
  std::unique_ptr<SlidingBody<dim>> body;       ///< the counter body
  std::unique_ptr<ProbeRecorder> probes;        ///< its probes; null without any
  std::function<FieldRows()> displacement;      ///< as in files, upright
  SurfaceMeeting meeting;                       ///< contact pairing of both bodies
  MPI_Comm communicator = MPI_COMM_SELF;        ///< ranks that hold the counter body
};
} // namespace mesoslip

#endif
