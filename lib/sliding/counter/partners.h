#ifndef mesoslip_sliding_counter_partners_h
#define mesoslip_sliding_counter_partners_h

#include "sliding/given_body.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** A line on how two bodies meet. */
std::string text_of(const SurfaceMeeting &meeting);

/** What the contact nodes of @p body meet of @p counter: partners where the nodes of both are at the same places and stay there, else
 * weights of their facets. @throws UserError where the counter body is not below all of the body on its way, or not even */
template <int dim>
SurfaceMeeting meeting_of(const GivenBody<dim> &body, const GivenBody<dim> &counter);
} // namespace mesoslip

#endif
