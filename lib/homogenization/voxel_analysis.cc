#include "exchange/cell_datasets.h"
#include "homogenization/volume_analysis.h"
#include "homogenization/volumes/voxel_volume.h"
#include "material/stiffness.h"
#include "morphology/voxels.h"
#include "program/machine.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Bytes per node, divided among the ranks, as measured: phases, multigrid, vectors, load
 * cases. */
constexpr double bytes_per_voxel = 210.;
/** Additional bytes per voxel if a phase is not isotropic. */
constexpr double anisotropic_bytes = 30.;
/** Additional bytes per voxel with orientations: two for the material of each cell, one
 * in the solver. */
constexpr double orientation_bytes = 5.;
/** Additional bytes per voxel with thermal expansion: the case of heat and its forces. */
constexpr double heat_bytes = 42.;
/** Additional bytes per voxel for MUBC: the multigrid is rebuilt while load cases are
 * kept, with three diagonals. */
constexpr double mixed_bytes = 25.;

/** Memory of the solver on all ranks together (bytes). */
double bytes_of_solver(const RveParameters &parameters)
{
  const MicrostructureParameters &microstructure = parameters.microstructure;
  double bytes                                   = bytes_per_voxel;
  for (const auto &phase : make_phases<3>(microstructure.phases))
    if (!is_isotropic(phase.stiffness))
      bytes = bytes_per_voxel + anisotropic_bytes;
  if (!microstructure.orientation.file.empty())
    bytes += orientation_bytes;
  for (const PhaseParameters &phase : microstructure.phases)
    if (phase.expands())
      {
        bytes += heat_bytes;
        break;
      }
  if (std::find(parameters.conditions.begin(), parameters.conditions.end(),
                BoundaryCondition::MUBC) != parameters.conditions.end())
    bytes += mixed_bytes;
  return bytes * static_cast<double>(microstructure.box.n_nodes());
}

class VoxelAnalysis : public VolumeAnalysis<3>
{
public:
  VoxelAnalysis(const RveParameters &given, const std::string &digest_of_inputs)
    : VolumeAnalysis<3>(given, digest_of_inputs, given.microstructure.box)
    , volume(make_voxels(given.microstructure, MPI_COMM_WORLD))
  {
  }

  unsigned int useful_ranks() const override
  {
    // Some seconds on one core; with eight planes per rank computation hides
    // communication.
    constexpr double long_solve = 6e6;
    const auto n_solves =
      static_cast<double>(6 * parameters.conditions.size() * parameters.n_members);
    if (static_cast<double>(n_cells()) * n_solves < long_solve)
      return 1;
    return std::max(1U, grid->cells[2] / 8);
  }

protected:
  std::string memory() const override
  {
    return std::to_string(
             150 + static_cast<unsigned long>(1e-6 * bytes_of_solver(parameters))) +
           " MB, divided among the ranks";
  }

  std::vector<std::string>
  describe_morphologies(std::vector<std::string> &warnings) const override
  {
    warnings = volume.warnings;
    return volume.description;
  }

  RveResults<3> morphology() const override
  {
    RveResults<3> results;
    RveContent<3> &content  = results.first;
    content.grid            = volume.grid;
    content.phases          = volume.phases;
    content.fractions       = volume.fractions;
    content.orientations    = volume.orientations;
    content.orientations.id = {}; // the ranks write them like phase_id
    results.n_nodes         = grid->n_nodes();
    return results;
  }

  bool are_cells_divided() const override
  {
    return true;
  }

  void write_cells(const std::string &path, const bool with_orientations) const override
  {
    const auto planes = [this](const CellView &id) {
      return CellPlanes(volume.grid, id, MPI_COMM_WORLD);
    };
    write_cell_planes(path, phases_dataset, planes(CellView(volume.phase_id)));
    if (with_orientations && !volume.orientations.empty())
      write_cell_planes(path, orientations_dataset,
                        planes(CellView(volume.orientations.id)));
  }

  std::vector<std::string> make_morphology(const unsigned int m,
                                           EnsembleMember<3> &member) override
  {
    const MicrostructureParameters &p = parameters.microstructure;
    if (m > 0)
      {
        volume = VoxelMorphology(); // avoids two in memory
        volume = make_voxels(p.member(m), MPI_COMM_WORLD);
      }
    member.origin    = p.is_random() ? "seed " + std::to_string(p.seed() + m) : "voxels";
    member.warnings  = volume.warnings;
    member.fractions = volume.fractions;
    return volume.description;
  }

  std::vector<LoadedPhase<3>> materials() const override
  {
    if (volume.orientations.empty())
      return VolumeAnalysis<3>::materials();
    const std::vector<OrientedPhase> &oriented = volume.orientations.materials;
    const std::vector<LoadedPhase<3>> phases   = VolumeAnalysis<3>::materials();
    std::vector<LoadedPhase<3>> loaded;
    for (const OrientedPhase &material : oriented)
      {
        loaded.push_back(phases[material.phase]);
        loaded.back().stiffness      = material.turned(loaded.back().stiffness);
        loaded.back().thermal_stress = material.turned(loaded.back().thermal_stress);
      }
    return loaded;
  }

  VoigtMatrix<3> turned(const std::size_t material,
                        const VoigtMatrix<3> &of_phase) const override
  {
    return volume.orientations.empty()
             ? of_phase
             : volume.orientations.materials[material].turned(of_phase);
  }

  std::unique_ptr<VolumeElement<3>>
  make_volume(const std::vector<ElasticPhase<3>> &phases,
              const std::function<void()> & /*case_done*/,
              Timer & /*timer*/) override
  {
    return std::make_unique<VoxelVolume<3>>(
      *grid, CellPlanes(*grid, volume.material_id(), MPI_COMM_WORLD), phases);
  }

  ConductionCells<3> cells_for_conduction(const unsigned int m) const override
  {
    // Each rank has only its planes, so rank 0 reads or makes the whole volume again.
    const VoxelMorphology whole =
      make_voxels(parameters.microstructure.member(m), MPI_COMM_SELF);
    ConductionCells<3> cells = conduction_cells(whole.grid);
    const CellView material  = whole.material_id();
    for (std::size_t k = 0; k < cells.mesh.cells.size(); ++k)
      cells.mesh.cells[k].material_id = material[k];
    const std::vector<OrientedPhase> &oriented = whole.orientations.materials;
    for (const PhaseParameters &phase : parameters.microstructure.phases)
      cells.conductivity.push_back(phase.conductivity<3>());
    if (whole.orientations.empty())
      return cells;
    const std::vector<Tensor2<3>> of_phases = std::move(cells.conductivity);
    cells.conductivity.clear();
    for (const OrientedPhase &one : oriented)
      {
        const Eigen::Matrix3d R = one.rotation();
        cells.conductivity.emplace_back(R * of_phases[one.phase] * R.transpose());
      }
    return cells;
  }

private:
  VoxelMorphology volume; ///< current member
};
} // namespace

void require_voxel_memory(const RveParameters &parameters)
{
  const MicrostructureParameters &p = parameters.microstructure;
  const double bytes =
    copies_on_this_machine(p.box.cells[2]) * bytes_of_solver(parameters);
  const auto &cells = p.box.cells;
  const bool file   = p.type == MicrostructureParameters::Type::voxels;
  require_memory({bytes, cells_that_fit({cells.begin(), cells.end()}, bytes) +
                           "; reduce Grid/Cells" +
                           (file ? " with Microstructure/Coarsening or Crop size" : "") +
                           ", or take more machines"});
}

std::unique_ptr<Analysis> make_voxel_analysis(const RveParameters &parameters,
                                              const std::string &digest)
{
  return std::make_unique<VoxelAnalysis>(parameters, digest);
}
} // namespace mesoslip
