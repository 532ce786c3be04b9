#ifndef mesoslip_sliding_supports_side_platen_h
#define mesoslip_sliding_supports_side_platen_h

#include "dynamics/supports/side_nodes.h"
#include "dynamics/supports/side_support.h"

#include <array>
#include <vector>

namespace mesoslip
{
/** Axis of the normal of a plane side with these nodes.
 * @throws UserError if the side is not plane, or inclined */
unsigned int
normal_of(const SideSupport &side, const SideNodes &nodes, const unsigned int dim);

/** Components in which the platen of a side moves: along its @p normal, and across it
 * where there are springs.
 * @throws UserError for a dashpot without a spring across the normal */
std::array<bool, 3> moves_of_platen(const SideSupport &side,
                                    const unsigned int normal,
                                    const unsigned int dim);

/** Gives area and push of all @p nodes of a side to the nodes that its platen moves
 * (@p own).
 * @throws UserError if there are none */
void carry_whole_side(SideNodes &nodes,
                      const std::vector<bool> &own,
                      const SideSupport &side);
} // namespace mesoslip

#endif
