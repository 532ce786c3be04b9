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

/** Bunge's angles lie within one turn; some programs write up to two (degrees). */
constexpr double largest_bunge_angle = 720.;

/** Source of the orientations of the cells; keys of section `Microstructure`. */
struct OrientationReading
{
  std::string file;    ///< three angles or, with a table, a grain per voxel; empty: none
  std::string table;   ///< CSV of the angles of the grains; empty: the file has angles
  std::string dataset; ///< in an HDF5 file
  std::string raw_type = "float64"; ///< number type of a .raw
  bool raw_big_endian  = false;     ///< most significant byte first
  double step          = 0.;        ///< angles are rounded to multiples (degrees); 0: not

  /** Binds the keys of the current section. */
  void bind(Keys &keys);

  /** The source of the file; a .raw has @p voxels along x, y, z. */
  VoxelSource source(const std::array<std::size_t, 3> &voxels) const;
};

/** Numbers of voxels along x, y, z in the file of voxels; without one the numbers of
 * cells. */
std::array<std::size_t, 3> voxels_of(const MicrostructureParameters &parameters);

/** Bunge's angles (degrees) by grain number, from the table @p path.
 * @throws UserError */
std::map<double, std::array<double, 3>> read_grains(const std::string &path);

/** Whether each phase is anisotropic, so that rotation changes it. */
std::vector<bool> phases_that_turn(const std::vector<Phase<3>> &phases);

/** Orientations read for the cells. */
struct CellOrientations
{
  Orientations orientations;            ///< all orientations; id for this rank's cells
  std::vector<std::string> description; ///< lines for the log
  std::vector<std::string> warnings;    ///< sentences for the log: angles like radians
};

/** Reads the headers of the files.
 * @throws UserError unless they fit the voxels, and a voxel is a cell */
void check_orientations(const MicrostructureParameters &parameters);

/**
 * Reads the orientations of the cells in the own_planes() of this rank, which have the
 * phases @p phase_id, one byte each. Orientations of isotropic @p phases are ignored.
 * Collective.
 * @throws UserError naming the voxel for an angle that is not a number or beyond 720
 * degrees or a grain without angles, and if there are too many different orientations
 */
CellOrientations read_cell_orientations(const MicrostructureParameters &parameters,
                                        const std::vector<std::uint8_t> &phase_id,
                                        const std::vector<Phase<3>> &phases,
                                        const MPI_Comm communicator);
} // namespace mesoslip

#endif
