#include "base/errors.h"
#include "base/exchange.h"
#include "exchange/cell_datasets.h"
#include "exchange/datasets.h"
#include "homogenization/divided_members.h"
#include "homogenization/loads/volume_cells.h"
#include "homogenization/volume_analysis.h"
#include "material/plausibility.h"
#include "material/stiffness.h"
#include "morphology/voxels.h"
#include "program/machine.h"
#include "program/run_context.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace mesoslip
{
namespace
{
/** Bytes of a node, divided among the ranks: phases, multigrid, vectors, load cases; as
 *  measured. */
constexpr double bytes_per_voxel = 210.;
/** More where a phase is not isotropic. */
constexpr double anisotropic_bytes = 30.;
/** More where orientations are read: two bytes more for each cell, and in the solver one more. */
constexpr double orientation_bytes = 5.;
/** More for MUBC, whose multigrid is made anew while load cases are kept, with three diagonals. */
constexpr double mixed_bytes = 25.;

/** What all ranks together need (bytes). */
double bytes_of_solver(const RveParameters &parameters)
{
  const MicrostructureParameters &microstructure = parameters.microstructure;
  double bytes                                   = bytes_per_voxel;
  for (const auto &phase : make_phases<3>(microstructure.phases))
    if (!is_isotropic(phase.stiffness))
      bytes = bytes_per_voxel + anisotropic_bytes;
  if (!microstructure.orientation.file.empty())
    bytes += orientation_bytes;
  if (std::find(parameters.conditions.begin(), parameters.conditions.end(),
                BoundaryCondition::MUBC) != parameters.conditions.end())
    bytes += mixed_bytes;
  return bytes * static_cast<double>(microstructure.box.n_nodes());
}

/** The response of phases from that of the materials @p of_materials, which are these in
 *  some orientations, with the sums that it follows from. */
HomogenizedResponse<3> response_of_phases(HomogenizedResponse<3> of_materials,
                                          const VolumeSums<3> &sums,
                                          const std::vector<OrientedPhase> &materials,
                                          const std::size_t n_phases)
{
  std::vector<VoigtMatrix<3>> means(n_phases, VoigtMatrix<3>::Zero());
  std::vector<double> volumes(n_phases, 0.);
  for (std::size_t m = 0; m < materials.size(); ++m)
    {
      means[materials[m].phase] += sums.phases[m].volume * of_materials.phase_means[m];
      volumes[materials[m].phase] += sums.phases[m].volume;
    }
  for (std::size_t p = 0; p < n_phases; ++p)
    if (volumes[p] > 0.)
      means[p] /= volumes[p];
  of_materials.phase_means = means;
  return of_materials;
}

class VoxelAnalysis : public VolumeAnalysis<3>
{
public:
  VoxelAnalysis(const RveParameters &given, const std::string &digest_of_inputs)
    : VolumeAnalysis<3>(given, digest_of_inputs)
    , volume(make_voxels(given.microstructure, MPI_COMM_WORLD))
  {
  }

  void describe(std::ostream &out) const override
  {
    for (const std::string &line : volume.description)
      out << line << '\n';
    out << n_cases() << " load cases, about "
        << 150 + static_cast<unsigned long>(1e-6 * bytes_of_solver(parameters))
        << " MB, divided among the ranks\n"
        << bytes_text(need().bytes) << " on the disk\n";
    for (const std::vector<std::string> &sentences : {volume.warnings, slips()})
      for (const std::string &warning : sentences)
        out << "warning: " << warning << '\n';
  }

  unsigned int useful_ranks() const override
  {
    // Some seconds of one core; eight planes hide what ranks tell each other.
    constexpr double long_solve = 6e6;
    if (n_cells() * n_cases() < long_solve)
      return 1;
    return std::max(1U, parameters.microstructure.box.cells[2] / 8);
  }

protected:
  void write_cells_of_draft(const std::string &path) const override
  {
    on_root(MPI_COMM_WORLD, [&]() {
      reserve_cells(path, shape_of_cells(volume.grid), !volume.orientations.empty());
    });
    write_cell_planes(path, phases_dataset, phases_of_cells());
    if (const auto orientations = orientations_of_cells())
      write_cell_planes(path, orientations_dataset, *orientations);
  }

  double n_cells() const override
  {
    return static_cast<double>(parameters.microstructure.box.n_cells());
  }

  RveContent<3> morphology() const override
  {
    RveContent<3> content;
    content.grid            = volume.grid;
    content.phases          = volume.phases;
    content.fractions       = volume.fractions;
    content.orientations    = volume.orientations;
    content.orientations.id = {}; // the ranks write them, as phase_id
    return content;
  }

  std::vector<std::string> slips() const override
  {
    const auto phases = make_phases<3>(parameters.microstructure.phases);
    auto ranges       = plausible_phases<3>(phases);
    for (unsigned int d = 0; d < 3; ++d)
      ranges.push_back(plausible_length("Grid/Size along " + std::string(1, "xyz"[d]),
                                        parameters.microstructure.box.extent(d)));
    auto sentences = implausible(ranges);
    for (const std::string &one : stiffness_warnings<3>(phases))
      sentences.push_back(one);
    return sentences;
  }

  RveResults<3> compute(RunContext &context) override
  {
    RveResults<3> results;
    context.progress().start("Load cases", n_cases());
    if (context.root())
      for (const std::string &line : volume.description)
        context.log(line);
    if (context.root() && parameters.n_members == 1) // those of several come at the end
      for (const std::string &warning : volume.warnings)
        context.warn(warning);
    results.first = morphology();
    loads_file    = reserve_fields<3>(parameters, parameters.microstructure.box,
                                   results.first, context);
    for (unsigned int m = 0; m < parameters.n_members; ++m)
      {
        if (m > 0)
          {
            volume = VoxelMorphology(); // not two at once
            volume =
              make_voxels(parameters.microstructure.member(m), context.communicator());
          }
        else
          write_cells(parameters, phases_of_cells(), orientations_of_cells(), context);
        results.members.push_back(compute_member(m, context));
      }
    context.progress().finish();
    if (parameters.n_members > 1 && context.root())
      for (const std::string &warning : morphology_warnings<3>(results.members))
        context.warn(warning);
    results.n_nodes = parameters.microstructure.box.n_nodes();
    return results;
  }

  std::string advice(const NotConverged &failure) const override
  {
    const auto &edges              = parameters.microstructure.box.spacing;
    const auto [shortest, longest] = std::minmax_element(edges.begin(), edges.end());
    return failure.reason == NotConverged::Reason::not_finite
             ? "check the moduli of Phases and Grid/Size, which are in Pa and m: forces "
               "or "
               "displacements are beyond the range of numbers"
             : causes(failure, *longest / *shortest);
  }

private:
  std::uint64_t n_cases() const
  {
    return std::uint64_t{n_voigt<3>} * parameters.conditions.size() *
           parameters.n_members;
  }

  /** Member number @p m, whose morphology is made; all ranks share it. */
  EnsembleMember<3> compute_member(const unsigned int m, RunContext &context)
  {
    const MicrostructureParameters &p = parameters.microstructure;
    EnsembleMember<3> member;
    member.origin    = p.is_random() ? "seed " + std::to_string(p.seed() + m) : "voxels";
    member.warnings  = volume.warnings;
    member.fractions = volume.fractions;
    const std::vector<OrientedPhase> &materials = volume.orientations.materials;
    std::vector<ElasticPhase<3>> phases;
    for (const auto &phase : oriented_phases(make_phases<3>(p.phases), materials))
      phases.push_back({phase.stiffness, phase.density});
    auto loaded = loaded_phases<3>(p.phases);
    if (!materials.empty())
      loaded.clear();
    for (std::size_t k = 0; k < materials.size(); ++k)
      loaded.push_back({materials[k].phase, phases[k].stiffness, {}});
    const auto scope   = context.timer().scope("Load cases");
    std::uint64_t done = n_cases() / parameters.n_members * m;
    VoxelVolume solver(CellPlanes(p.box, volume.material_id(), context.communicator()),
                       phases);
    for (const BoundaryCondition condition : parameters.conditions)
      {
        const auto part          = context.timer().scope(to_string(condition).c_str());
        const VolumeSums<3> sums = solver.solve(
          condition, parameters.tolerance, [&]() { context.progress().update(++done); });
        member.responses.push_back(homogenize<3>(sums, phases));
        if (!materials.empty())
          member.responses.back() =
            response_of_phases(member.responses.back(), sums, materials, p.phases.size());
        if (parameters.write_concentration && m == 0)
          write_concentration(solver, condition, context);
        if (!parameters.loads.loads.empty() && parameters.loads.uses(condition))
          for (LoadResult<3> &result :
               evaluate_loads(parameters.loads, member.responses.back(), loaded,
                              VoxelCells<3>(solver, p.box, context.communicator()),
                              m == 0 ? loads_file : std::string()))
            member.loads.push_back(std::move(result));
      }
    return member;
  }

  CellPlanes phases_of_cells() const
  {
    return {volume.grid, CellView(volume.phase_id), MPI_COMM_WORLD};
  }

  std::optional<CellPlanes> orientations_of_cells() const
  {
    if (volume.orientations.empty())
      return std::nullopt;
    return CellPlanes(volume.grid, CellView(volume.orientations.id), MPI_COMM_WORLD);
  }

  VoxelMorphology volume; ///< of the member at hand
  std::string loads_file; ///< where fields of loads go; empty: nowhere
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
