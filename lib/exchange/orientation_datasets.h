#ifndef mesoslip_exchange_orientation_datasets_h
#define mesoslip_exchange_orientation_datasets_h

#include "io/hdf5_file.h"
#include "material/orientations.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/** Writes /orientation of a file, of cells in an array of the shape @p cells, if there are
 * orientations; without their id, where write_cell_planes() has written these. */
void write_orientations(Hdf5File &file,
                        const Orientations &orientations,
                        const Shape &cells);

/** The datasets of the phases of cells and of their orientations, if there are any. */
struct CellMaterials
{
  /** Those of @p of_file, whose dataset @p phases has the phases of the cells, one of
   * @p n each; @p program wrote it. @throws UserError */
  CellMaterials(const Hdf5File &of_file,
                const std::string &phases,
                const std::size_t n,
                const std::string &program);

  /**
   * What @p count cells from number @p first on are made of: their phases, or which of
   * oriented. @throws UserError unless each is one of the phases, and of the orientation's
   */
  std::vector<std::uint16_t>
  of_cells(const Hdf5File &file, const std::size_t first, const std::size_t count) const;

  /** The orientations with the materials of all cells; empty where there are none. */
  Orientations orientations(const Hdf5File &file) const;

  /** The phase of one of the materials. */
  unsigned int phase_of(const std::uint16_t material) const
  {
    return oriented.empty() ? material : oriented[material].phase;
  }

  std::string phases;                  ///< name of their dataset
  std::size_t n_phases;                ///< number of phases
  std::string program;                 ///< that wrote the file
  Shape shape;                         ///< of the dataset of the phases; empty without it
  std::vector<OrientedPhase> oriented; ///< the distinct pairs of phase and orientation
};
} // namespace mesoslip

#endif
