#ifndef mesoslip_localization_mesh_mesh_localization_h
#define mesoslip_localization_mesh_mesh_localization_h

#include "localization/localization_input.h"
#include "program/program.h"

#include <memory>

namespace mesoslip
{
/**
 * Eqs 22 to 24 where volume or body are meshes, in any combination with grids, or where
 * the body is larger than the volume: each rank has some of the cells of the volume and
 * takes the strain there from snapshots that rank 0 reads. The strain at a place is that of
 * CellStrain. @p canonical is the text of the parameters that determine the result.
 * Collective. @throws UserError
 */
template <int dim>
std::unique_ptr<Analysis> make_mesh_localization(const LocalizationParameters &parameters,
                                                 const std::string &canonical);
} // namespace mesoslip

#endif
