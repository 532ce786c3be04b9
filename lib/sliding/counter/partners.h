#ifndef mesoslip_sliding_counter_partners_h
#define mesoslip_sliding_counter_partners_h

#include "sliding/given_body.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** A line on the pairing of two contacts. */
std::string text_of(const SurfaceMeeting &meeting);

/** Pairing of the contact nodes of @p body with @p counter: partner nodes if the nodes of
 * both coincide and stay so, else weights on facets.
 * @throws UserError if the counter body is not below the whole body on its way, or is
 * not even */
template <int dim>
SurfaceMeeting meeting_of(const GivenBody<dim> &body, const GivenBody<dim> &counter);
} // namespace mesoslip

#endif
