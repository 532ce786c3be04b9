#ifndef mesoslip_sliding_supports_grid_columns_h
#define mesoslip_sliding_supports_grid_columns_h

#include "sliding/sliding_body.h"

#include <deque>

namespace mesoslip
{
/** Of a whole column what concerns the rows of this rank, of sides that no platen moves ghost rows as well. */
void restrict_side(LoadedSide &side, const NodeRows &rows);

/** The columns of the loaded @p sides; arguments as of SideColumn. */
std::deque<SideColumn> make_columns(std::deque<SideSurface<2>> &sides,
                                    const SlidingSetup &setup,
                                    const UniformMaterial &material,
                                    const UniformMaterial *damping,
                                    const NodeRows &rows,
                                    NodalField<double> &u,
                                    NodalField<double> &w);

/** The columns that @p platens move; arguments as of PlatenColumn. */
std::deque<PlatenColumn> make_platen_columns(std::deque<RigidPlaten<2>> &platens,
                                             const SlidingSetup &setup,
                                             const UniformMaterial &material,
                                             const UniformMaterial *damping,
                                             const NodeRows &rows,
                                             NodalField<double> &u,
                                             NodalField<double> &w);
} // namespace mesoslip

#endif
