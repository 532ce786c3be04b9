#ifndef mesoslip_sliding_counter_partners_h
#define mesoslip_sliding_counter_partners_h

#include "sliding/given_body.h"

#include <vector>

namespace mesoslip
{
/** Of each contact node of @p counter the number of the contact node of @p body above it. @throws UserError unless each node has
 * a partner, or where the contact of the counter body is not even */
template <int dim>
std::vector<unsigned int> partners_in(const GivenBody<dim> &body,
                                      const GivenBody<dim> &counter);
} // namespace mesoslip

#endif
