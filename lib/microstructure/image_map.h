#ifndef mesoslip_microstructure_image_map_h
#define mesoslip_microstructure_image_map_h

#include "grid/phase_map.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** A raster of values, row 0 on top, x fastest. */
struct ValueRaster
{
  unsigned int        n_columns = 0;
  unsigned int        n_rows    = 0;
  std::vector<double> values;
};

/**
 * The morphology drawn in a raster; the top row of the raster is the top of the box.
 *
 * Value `values[p]` means phase p; with an empty list the distinct values of the
 * raster in ascending order do. Pixels are cells, or an integer multiple of them in each
 * direction (a pixel becomes a block of cells, or the pixel at the centre of a cell, the
 * upper right one of the middle four, is taken). Throws UserError, naming @p source, when
 * sizes do not fit, a value belongs to no phase or there are more than 256.
 */
PhaseMap<2>
map_from_raster(const UniformGrid<2>      &grid,
                const ValueRaster         &raster,
                const std::vector<double> &values,
                const std::string         &source);

/** map_from_raster() of a PNG (grey or palette values) or of a plain-text array. */
PhaseMap<2>
read_phase_map(const UniformGrid<2>      &grid,
               const std::string         &file,
               const std::vector<double> &values = {});
} // namespace mesoslip

#endif
