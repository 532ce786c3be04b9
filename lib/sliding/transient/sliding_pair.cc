// Parts of SlidingBody that concern a counter body.
#include "sliding/counter/counter_motion.h"
#include "sliding/sliding_body.h"

namespace mesoslip
{
template <int dim>
SurfaceCondition<dim> &SlidingBody<dim>::contact_condition(CounterMotion<dim> *counter,
                                                           const NodesOfContact &nodes,
                                                           const MPI_Comm communicator)
{
  if (counter == nullptr || !counter->body)
    return *profile.timed<TimedSurface<dim>>(contact, "Contact and its histories");
  below = counter->body.get();
  pair  = std::make_unique<PairedContact<dim>>(
    contact, nodes, *counter->partner, counter->meeting,
    [this]() { below->time_integration().advance(1); }, setup.step, communicator);
  return *profile.timed<TimedSurface<dim>>(*pair,
                                           "Counter body, contact and its histories");
}

template <int dim>
void SlidingBody<dim>::start_together()
{
  if (!pair)
    return;
  pair->start_as_one(contact_start, below->contact_start);
  start_contact();
  below->start_contact();
}

#define MESOSLIP_INSTANTIATE(dim)                                      \
  template SurfaceCondition<dim> &SlidingBody<dim>::contact_condition( \
    CounterMotion<dim> *, const NodesOfContact &, const MPI_Comm);     \
  template void SlidingBody<dim>::start_together();
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
