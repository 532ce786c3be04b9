#ifndef mesoslip_exchange_cell_datasets_h
#define mesoslip_exchange_cell_datasets_h

#include "grid/cell_planes.h"
#include "io/hdf5_file.h"

#include <string>

namespace mesoslip
{
/** Dataset of the phases of the cells of rve.h5 and loads.h5. */
inline constexpr char phases_dataset[] = "/phase/id";

/** Dataset of the orientations of cells. */
inline constexpr char orientations_dataset[] = "/orientation/id";

/** How many rows of a dataset of cells in an array of that @p shape are kept together: cells of a mesh are short
 * rows. */
inline std::size_t rows_together(const Shape &shape)
{
  return shape.size() == 1 ? 1024 : 1;
}

/** Makes room in @p file for a dataset @p phases of the phases of cells in an array of that @p shape,
 * and for their orientations. */
void reserve_cells(Hdf5File &file,
                   const std::string &phases,
                   const Shape &shape,
                   const bool with_orientations);

/** Makes room for the phases of cells in an array of that @p shape, and for their orientations, in the
 * file @p path that was begun and left; write_cell_planes() fills it. */
void reserve_cells(const std::string &path,
                   const Shape &shape,
                   const bool with_orientations);

/** Writes dataset @p name of such a file: each rank its planes, or rows of a plane grid.
 * Collective. @throws UserError */
void write_cell_planes(const std::string &path,
                       const std::string &name,
                       const CellPlanes &cells);
} // namespace mesoslip

#endif
