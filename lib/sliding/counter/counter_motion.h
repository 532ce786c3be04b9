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

/** A second body that moves below the first one. */
template <int dim>
struct CounterMotion
{
  std::unique_ptr<PartnerSurface<dim>> partner; ///< moves its contact nodes
  std::unique_ptr<SlidingBody<dim>> body;       ///< all of it that moves
  std::unique_ptr<ProbeRecorder> probes;        ///< refer to the body; null without any
  std::function<FieldRows()> displacement;      ///< as files have it, upright
  SurfaceMeeting meeting;                       ///< of the contacts of both
  MPI_Comm communicator = MPI_COMM_SELF;        ///< of the ranks that have it
};
} // namespace mesoslip

#endif
