#ifndef mesoslip_morphology_voxel_reading_h
#define mesoslip_morphology_voxel_reading_h

#include "grid/cell_planes.h"
#include "io/voxel_file.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;
struct MicrostructureParameters;

/** Conversion of voxels of a file to phases of cells; keys of section
 * `Microstructure`. */
struct VoxelReading
{
  std::vector<long> crop_from;    ///< first voxel along x, y, z; empty: 0, 0, 0
  std::vector<long> crop_size;    ///< voxels along x, y, z; empty: all the rest
  unsigned int coarsening = 1;    ///< voxels per edge of a cell
  std::string dataset;            ///< in an HDF5 file
  std::vector<long> raw_shape;    ///< voxels of a .raw along x, y, z
  std::string raw_type = "uint8"; ///< number type of a .raw
  bool raw_big_endian  = false;   ///< most significant byte first

  /** Binds the keys of the current section for the file @p path. */
  void bind(Keys &keys, const std::string &path);

  /** The source with all settings needed to read it. */
  VoxelSource source(const std::string &path) const;
};

/** A box of voxels to read. */
struct VoxelRegion
{
  std::array<std::size_t, 3> from = {}; ///< first voxel along x, y, z
  std::array<std::size_t, 3> size = {}; ///< voxels along x, y, z
};

/**
 * The region that the crop leaves of a file of the extents @p shape, [z][y][x].
 * @throws UserError unless it lies in the file and consists of whole cells, as many as
 * `Grid/Cells`.
 */
VoxelRegion region_of_voxels(const MicrostructureParameters &parameters,
                             const std::vector<std::size_t> &shape);

/** Phases of cells that were read from voxels. */
struct CellPhases
{
  std::vector<std::uint8_t> id;  ///< per cell of this rank's planes, x fastest
  std::vector<double> fractions; ///< share of each phase among all voxels
};

/**
 * Reads the voxels of @p region plane by plane, each rank for its own_planes() of cells.
 * A cell takes the phase of most of its voxels; a tie goes to the phase that is furthest
 * below its share of the voxels, counted over the cells so far (x fastest) and this one,
 * then to the lower phase number. Collective.
 * @throws UserError naming the voxel if a value has no phase, or if the values of the
 * phases are ambiguous
 */
CellPhases read_cell_phases(const MicrostructureParameters &parameters,
                            VoxelFile &file,
                            const VoxelRegion &region,
                            const MPI_Comm communicator);
} // namespace mesoslip

#endif
