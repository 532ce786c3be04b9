#ifndef mesoslip_morphology_voxels_h
#define mesoslip_morphology_voxels_h

#include "grid/cell_planes.h"
#include "material/orientations.h"
#include "material/voigt.h"

#include <string>
#include <vector>

namespace mesoslip
{
struct MicrostructureParameters;

/** A voxel morphology with its materials. Each rank has the cells of its own_planes();
 * all other members are the same on all ranks. */
struct VoxelMorphology
{
  UniformGrid<3> grid;                ///< the whole box
  std::vector<std::uint8_t> phase_id; ///< per cell of this rank, x fastest
  std::vector<Phase<3>> phases;       ///< by phase number
  std::vector<double> fractions;      ///< volume fraction of each phase
  Orientations orientations;          ///< per cell, if cells have orientations

  /** Material of each cell of this rank: its phase, or an orientation of its phase. */
  CellView material_id() const
  {
    return orientations.empty() ? CellView(phase_id) : CellView(orientations.id);
  }

  /** Lines for the log: grid, file, cells and material of each phase, phases of the cells
   * in the corners, fractions in slices across each axis. */
  std::vector<std::string> description;
  std::vector<std::string> warnings; ///< sentences for the log: phases without cells
};

/** Reads the header of the file of voxels.
 * @throws UserError if it is not [z][y][x], does not match `Grid/Cells`, or has
 * fractional values without thresholds */
void check_voxels(const MicrostructureParameters &parameters);

/** Reads the voxels, places random inclusions, or fills the box with the first phase.
 * @p parameters have passed check().
 * @throws UserError if the values of the phases are ambiguous, or if there is no room
 * for as many inclusions. Collective. */
VoxelMorphology make_voxels(const MicrostructureParameters &parameters,
                            const MPI_Comm communicator);
} // namespace mesoslip

#endif
