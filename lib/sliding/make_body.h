#ifndef mesoslip_sliding_make_body_h
#define mesoslip_sliding_make_body_h

#include "elasticity/uniform_material.h"
#include "exchange/body_description.h"
#include "sliding/contact_parameters.h"

namespace mesoslip
{
/**
 * The body that parameters and RVE file describe, if there is the memory for its fields.
 * The coefficient of a bottom node follows from those of the two cells beside it by
 * FrictionParameters::node_rule: their mean weighted with the stiffness D22 (as the
 * pressure is shared when both cells are compressed alike, eq. 18), the plain mean, the
 * largest or the smallest.
 * @throws UserError naming key or file
 */
BodyDescription make_body(const ContactParameters &parameters);

/** The grid of the body with the materials of its cells. @throws UserError */
UniformMaterial make_material(const BodyDescription &body, const bool periodic);

/** Width (m) of the bottom that belongs to a node; half a cell at the ends. */
double
tributary_width(const UniformGrid<2> &grid, const unsigned int node, const bool periodic);
} // namespace mesoslip

#endif
