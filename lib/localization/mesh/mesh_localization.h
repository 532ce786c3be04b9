#ifndef mesoslip_localization_mesh_mesh_localization_h
#define mesoslip_localization_mesh_mesh_localization_h

#include "localization/localization_input.h"
#include "program/program.h"

#include <memory>

namespace mesoslip
{
/**
 * Eqs 22 to 24 where volume or body are meshes, in any combination with grids, are
 * three-dimensional, or the body is larger than the volume. Each rank has some of the cells of
 * the volume, whole rows or planes of a grid, reads what belongs to them and writes their
 * fields. Of grids no rank has more, of meshes rank 0 has all points and cells, and each rank reads
 * a block of the points of the snapshots. The strain at a place is that of CellStrain. @p canonical is the text
 * of the parameters that determine the result. Collective. @throws UserError
 */
template <int dim>
std::unique_ptr<Analysis> make_mesh_localization(const LocalizationParameters &parameters,
                                                 const std::string &canonical);
} // namespace mesoslip

#endif
