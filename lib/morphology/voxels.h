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

/** A morphology of voxels with the materials it is made of. Each rank has the cells of its
 * own_planes(), all of them the rest. */
struct VoxelMorphology
{
  UniformGrid<3> grid;                ///< the whole box
  std::vector<std::uint8_t> phase_id; ///< of each cell of this rank, x fastest
  std::vector<Phase<3>> phases;       ///< by index
  std::vector<double> fractions;      ///< volume fraction of each phase
  Orientations orientations;          ///< of the cells, where they have their own

  /** Of each cell of this rank its material: its phase, or this in one of its orientations. */
  CellView material_id() const
  {
    return orientations.empty() ? CellView(phase_id) : CellView(orientations.id);
  }

  /** Lines for the log: grid, file, cells and material of each phase, phases of the cells
   * in the corners, fractions in slices across each axis. */
  std::vector<std::string> description;
  std::vector<std::string> warnings; ///< sentences for the log: phases without cells
};

/** Reads what the file says of its voxels. @throws UserError if they are not of [z][y][x],
 * are no cells of `Grid/Cells`, or have fractions and no thresholds */
void check_voxels(const MicrostructureParameters &parameters);

/** Reads the voxels, places random inclusions, or fills the box with the first phase.
 * @p parameters have passed check(). @throws UserError when it is not clear which value is
 * which phase, or when there is no room for as many inclusions. Collective. */
VoxelMorphology make_voxels(const MicrostructureParameters &parameters,
                            const MPI_Comm communicator);
} // namespace mesoslip

#endif
