#ifndef mesoslip_exchange_rve_orientation_datasets_h
#define mesoslip_exchange_rve_orientation_datasets_h

#include "grid/cell_reader.h"
#include "io/hdf5_file.h"
#include "material/orientations.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Writes /orientation for cells in an array of shape @p cells, if there are orientations;
 * omits the ids if write_cell_planes() has written them.
 */
void write_orientations(Hdf5File &file,
                        const Orientations &orientations,
                        const Shape &cells);

/**
 * Writes the dataset @p phases of all cells of @p grid and, if there are @p oriented
 * phases, /orientation. @p materials_in returns the material indices, a few layers at a
 * time.
 */
void write_materials(Hdf5File &file,
                     const std::string &phases,
                     const UniformGrid<3> &grid,
                     const std::vector<OrientedPhase> &oriented,
                     const CellReader &materials_in);

/** Datasets of phases and, if present, orientations of cells. */
struct CellMaterials
{
  /**
   * Datasets of @p of_file; dataset @p phases has indices below @p n; @p program wrote
   * the file. @throws UserError
   */
  CellMaterials(const Hdf5File &of_file,
                const std::string &phases,
                const std::size_t n,
                const std::string &program);

  /**
   * Materials of @p count cells from number @p first on: phase indices, or indices into
   * oriented. @throws UserError unless all are valid, and consistent with the phase of
   * the orientation
   */
  std::vector<std::uint16_t>
  of_cells(const Hdf5File &file, const std::size_t first, const std::size_t count) const;

  /** Materials of the cells of @p block of a grid, x fastest. */
  template <int dim>
  std::vector<std::uint16_t> of_cells(const Hdf5File &file,
                                      const CellBlock<dim> &block) const;

  /** Phase of a material. */
  unsigned int phase_of(const std::uint16_t material) const
  {
    return oriented.empty() ? material : oriented[material].phase;
  }

  std::string phases;                  ///< name of the phase dataset
  std::size_t n_phases;                ///< number of phases
  std::string program;                 ///< program that wrote the file
  Shape shape;                         ///< shape of the phase dataset; empty without it
  std::vector<OrientedPhase> oriented; ///< distinct pairs of phase and orientation

private:
  template <typename Read>
  std::vector<std::uint16_t> checked(const Hdf5File &file, const Read &read) const;
};
} // namespace mesoslip

#endif
