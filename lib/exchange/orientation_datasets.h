#ifndef mesoslip_exchange_orientation_datasets_h
#define mesoslip_exchange_orientation_datasets_h

#include "grid/cell_reader.h"
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

/** Writes the dataset @p phases of the phases of all cells of @p grid and, if there are @p oriented
 * phases, /orientation, of which @p materials_in gives the numbers, some layers at a time. */
void write_materials(Hdf5File &file,
                     const std::string &phases,
                     const UniformGrid<3> &grid,
                     const std::vector<OrientedPhase> &oriented,
                     const CellReader &materials_in);

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

  /** The same of the cells of @p block of a grid, x fastest. */
  template <int dim>
  std::vector<std::uint16_t> of_cells(const Hdf5File &file,
                                      const CellBlock<dim> &block) const;

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

private:
  template <typename Read>
  std::vector<std::uint16_t> checked(const Hdf5File &file, const Read &read) const;
};
} // namespace mesoslip

#endif
