#ifndef mesoslip_sliding_supports_grid_columns_h
#define mesoslip_sliding_supports_grid_columns_h

#include "sliding/sliding_body.h"

#include <deque>

namespace mesoslip
{
/** Restricts a column of nodes to the rows of this rank; without a platen including ghost
 * rows. */
void restrict_side(LoadedSide &side, const NodeRows &rows);

/** The columns of the loaded @p sides; arguments as for SideColumn. */
std::deque<SideColumn> make_columns(std::deque<SideSurface<2>> &sides,
                                    const SlidingSetup &setup,
                                    const UniformMaterial &material,
                                    const UniformMaterial *damping,
                                    const NodeRows &rows,
                                    NodalField<double> &u,
                                    NodalField<double> &w);

/** The columns that @p platens move; arguments as for PlatenColumn. */
std::deque<PlatenColumn> make_platen_columns(std::deque<RigidPlaten<2>> &platens,
                                             const SlidingSetup &setup,
                                             const UniformMaterial &material,
                                             const UniformMaterial *damping,
                                             const NodeRows &rows,
                                             NodalField<double> &u,
                                             NodalField<double> &w);
} // namespace mesoslip

#endif
