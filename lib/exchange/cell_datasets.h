#ifndef mesoslip_exchange_cell_datasets_h
#define mesoslip_exchange_cell_datasets_h

#include "grid/cell_planes.h"
#include "io/hdf5_file.h"

#include <string>

namespace mesoslip
{
/** Dataset of the cell phases in rve.h5 and loads.h5. */
inline constexpr char phases_dataset[] = "/phase/id";

/** Dataset of the cell orientations. */
inline constexpr char orientations_dataset[] = "/orientation/id";

/**
 * Number of rows per chunk of a cell dataset with this @p shape; rows of a mesh are
 * short.
 */
inline std::size_t rows_together(const Shape &shape)
{
  return shape.size() == 1 ? 1024 : 1;
}

/**
 * Reserves datasets in @p file for the phases of cells (name @p phases, array of this
 * @p shape) and for their orientations.
 */
void reserve_cells(Hdf5File &file,
                   const std::string &phases,
                   const Shape &shape,
                   const bool with_orientations);

/**
 * Reserves datasets for phases and orientations of cells in an array of this @p shape, in
 * the file @p path that was created and left; write_cell_planes() fills them.
 */
void reserve_cells(const std::string &path,
                   const Shape &shape,
                   const bool with_orientations);

/**
 * Writes dataset @p name of a reserved file: each rank writes its planes, or rows of a
 * plane grid. Collective. @throws UserError
 */
void write_cell_planes(const std::string &path,
                       const std::string &name,
                       const CellPlanes &cells);
} // namespace mesoslip

#endif
