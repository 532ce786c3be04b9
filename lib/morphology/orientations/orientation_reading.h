#ifndef mesoslip_morphology_orientations_orientation_reading_h
#define mesoslip_morphology_orientations_orientation_reading_h

#include "io/voxel_file.h"
#include "material/orientations.h"

#include <array>
#include <cstdint>
#include <map>
#include <mpi.h>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;
struct MicrostructureParameters;

/** Bunge's angles are within a turn; some programs write them within two (degrees). */
constexpr double largest_bunge_angle = 720.;

/** Where the orientations of the cells come from; keys of section `Microstructure`. */
struct OrientationReading
{
  std::string file;    ///< three angles a voxel or, with a table, its grain; empty: none
  std::string table;   ///< CSV of the angles of the grains; empty: the file has angles
  std::string dataset; ///< of an HDF5 file
  std::string raw_type = "float64"; ///< of the numbers of a .raw
  bool raw_big_endian  = false;     ///< the highest byte of a number comes first
  double step          = 0.; ///< multiples that angles are rounded to (degrees); 0: no

  /** Binds the keys of the current section. */
  void bind(Keys &keys);

  /** The file, of which a .raw has @p voxels along x, y, z. */
  VoxelSource source(const std::array<std::size_t, 3> &voxels) const;
};

/** Numbers of voxels along x, y, z of the file of voxels; without one those of cells. */
std::array<std::size_t, 3> voxels_of(const MicrostructureParameters &parameters);

/** Bunge's angles (degrees) by number of grain, of the table @p path. @throws UserError */
std::map<double, std::array<double, 3>> read_grains(const std::string &path);

/** Which phases are anisotropic, so that an orientation changes them. */
std::vector<bool> phases_that_turn(const std::vector<Phase<3>> &phases);

/** What was read of the cells. */
struct CellOrientations
{
  Orientations orientations;            ///< of the cells; id of those of this rank
  std::vector<std::string> description; ///< lines for the log
  std::vector<std::string> warnings;    ///< sentences for the log: angles like radians
};

/** Reads what the files say of themselves. @throws UserError unless they fit the voxels, and
 * one voxel is a cell */
void check_orientations(const MicrostructureParameters &parameters);

/**
 * Reads the orientations of the cells of the own_planes() of this rank, which have the phases @p
 * phase_id, in a byte each. Those of isotropic @p phases do not count. Collective. @throws UserError naming the voxel of an angle that is no
 * number or beyond 720 degrees or of a grain without angles, and when there are too many different ones
 */
CellOrientations read_cell_orientations(const MicrostructureParameters &parameters,
                                        const std::vector<std::uint8_t> &phase_id,
                                        const std::vector<Phase<3>> &phases,
                                        const MPI_Comm communicator);
} // namespace mesoslip

#endif
