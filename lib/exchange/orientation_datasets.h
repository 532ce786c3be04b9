#ifndef mesoslip_exchange_orientation_datasets_h
#define mesoslip_exchange_orientation_datasets_h

#include "io/hdf5_file.h"
#include "material/orientations.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Writes /orientation of a file, of cells in an array of the shape @p cells, if there are
 * orientations. */
void write_orientations(Hdf5File &file,
                        const Orientations &orientations,
                        const Shape &cells);

/**
 * Reads it; empty where there is none. The phases of the cells, of which there are
 * @p n_phases, are in the dataset @p phases; @p program wrote the file. @throws UserError also unless each cell has an orientation of its
 * phase
 */
Orientations read_orientations(const Hdf5File &file,
                               const std::string &phases,
                               const std::size_t n_phases,
                               const std::string &program);
} // namespace mesoslip

#endif
