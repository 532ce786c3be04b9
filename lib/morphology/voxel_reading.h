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

/** How voxels of a file become the phases of cells; keys of section `Microstructure`. */
struct VoxelReading
{
  std::vector<long> crop_from;    ///< first voxel along x, y, z; empty: 0, 0, 0
  std::vector<long> crop_size;    ///< voxels along x, y, z; empty: all from there on
  unsigned int coarsening = 1;    ///< voxels of an edge of a cell
  std::string dataset;            ///< of an HDF5 file
  std::vector<long> raw_shape;    ///< voxels of a .raw along x, y, z
  std::string raw_type = "uint8"; ///< of its numbers
  bool raw_big_endian  = false;   ///< their first byte is the highest

  /** Binds the keys of the current section for the file @p path. */
  void bind(Keys &keys, const std::string &path);

  /** The file with what has to be known to read it. */
  VoxelSource source(const std::string &path) const;
};

/** The voxels that are read: those of a box. */
struct VoxelRegion
{
  std::array<std::size_t, 3> from = {}; ///< first one along x, y, z
  std::array<std::size_t, 3> size = {}; ///< their numbers
};

/**
 * The voxels that the crop leaves of a file of the extents @p shape, [z][y][x]. @throws
 * UserError unless they lie in the file and are whole cells, those of `Grid/Cells`.
 */
VoxelRegion region_of_voxels(const MicrostructureParameters &parameters,
                             const std::vector<std::size_t> &shape);

/** Phases of cells that were read from voxels. */
struct CellPhases
{
  std::vector<std::uint8_t> id;  ///< of each cell of the planes of this rank, x fastest
  std::vector<double> fractions; ///< of each phase among all voxels
};

/**
 * Reads the voxels of @p region plane by plane, each rank those of its own_planes() of cells. A cell of several voxels takes the phase
 * that most of them have; where several have as many, the one that lies furthest below its
 * share of the voxels, counted over the cells so far (x fastest) and this one, then the
 * first of them. Collective. @throws UserError naming the voxel when a value has no phase, or when it is
 * not clear which value is which phase
 */
CellPhases read_cell_phases(const MicrostructureParameters &parameters,
                            VoxelFile &file,
                            const VoxelRegion &region,
                            const MPI_Comm communicator);
} // namespace mesoslip

#endif
