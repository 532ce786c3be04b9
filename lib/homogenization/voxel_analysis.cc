#include "base/errors.h"
#include "base/exchange.h"
#include "elasticity/brick/brick_matrices.h"
#include "exchange/rve_file.h"
#include "homogenization/volume_analysis.h"
#include "homogenization/voxel_volume.h"
#include "io/parallel_rows.h"
#include "material/plausibility.h"
#include "morphology/voxels.h"
#include "program/run_context.h"

#include <ostream>

namespace mesoslip
{
namespace
{
/** Bytes of a node, divided among the ranks: phases, multigrid, vectors, load cases; as
 *  measured. */
constexpr double bytes_per_voxel = 340.;
/** More where a phase is not isotropic. */
constexpr double anisotropic_bytes = 90.;

class VoxelAnalysis : public VolumeAnalysis<3>
{
public:
  VoxelAnalysis(const RveParameters &given, const std::string &digest_of_inputs)
    : VolumeAnalysis<3>(given, digest_of_inputs)
  {
    require_memory(
      {divided_bytes() / dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
       "reduce Grid/Cells or take more ranks"});
    on_root(MPI_COMM_WORLD,
            [this]() { volume = make_voxels(parameters.microstructure); });
  }

  void describe(std::ostream &out) const override
  {
    for (const std::string &line : volume.description)
      out << line << '\n';
    out << n_cases() << " load cases, about "
        << 150 + static_cast<unsigned long>(1e-6 * divided_bytes())
        << " MB, divided among the ranks\n";
    for (const std::vector<std::string> &sentences : {volume.warnings, slips()})
      for (const std::string &warning : sentences)
        out << "Warning: " << warning << '\n';
  }

protected:
  double n_cells() const override
  {
    return static_cast<double>(parameters.microstructure.box.n_cells());
  }

  std::vector<std::string> slips() const override
  {
    const auto phases = make_phases<3>(parameters.microstructure.phases);
    auto ranges       = plausible_phases<3>(phases);
    for (unsigned int d = 0; d < 3; ++d)
      ranges.push_back(plausible_length("Grid/Size along " + std::string(1, "xyz"[d]),
                                        parameters.microstructure.box.extent(d)));
    auto sentences = implausible(ranges);
    if (const std::string one = stiffness_warning<3>(phases); !one.empty())
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
    if (context.root())
      for (const std::string &warning : volume.warnings)
        context.warn(warning);
    if (parameters.write_concentration)
      {
        for (const BoundaryCondition condition : parameters.conditions)
          results.first.reserved.push_back(to_string(condition));
        on_root(context.communicator(), [&]() {
          reserve_concentration(context.file("rve.h5"), volume.map.grid,
                                results.first.reserved);
        });
      }
    results.members.push_back(compute_member(context));
    context.progress().finish();
    results.first.grid     = volume.map.grid;
    results.first.phases   = volume.phases;
    results.first.phase_id = volume.map.id;
    results.n_nodes        = parameters.microstructure.box.n_nodes();
    return results;
  }

  std::string advice(const NotConverged::Reason reason) const override
  {
    return reason == NotConverged::Reason::not_finite
             ? "check the moduli of Phases and Grid/Size, which are in Pa and m: forces "
               "or "
               "displacements are beyond the range of numbers"
             : "loosen Homogenization/Tolerance";
  }

private:
  std::uint64_t n_cases() const
  {
    return n_voigt<3> * parameters.conditions.size();
  }

  double divided_bytes() const
  {
    double bytes = bytes_per_voxel;
    for (const auto &phase : make_phases<3>(parameters.microstructure.phases))
      if (!is_isotropic(phase.stiffness))
        bytes = bytes_per_voxel + anisotropic_bytes;
    return bytes * static_cast<double>(parameters.microstructure.box.n_nodes());
  }

  EnsembleMember<3> compute_member(RunContext &context)
  {
    EnsembleMember<3> member;
    member.origin    = "voxels";
    member.warnings  = volume.warnings;
    member.fractions = volume.fractions;
    std::vector<ElasticPhase<3>> phases;
    for (const auto &phase : make_phases<3>(parameters.microstructure.phases))
      phases.push_back({phase.stiffness, phase.density});
    const auto scope   = context.timer().scope("Load cases");
    std::uint64_t done = 0;
    VoxelVolume solver(volume.map, phases, context.communicator());
    for (const BoundaryCondition condition : parameters.conditions)
      {
        const auto part = context.timer().scope(to_string(condition).c_str());
        member.responses.push_back(
          homogenize<3>(solver.solve(condition, parameters.tolerance,
                                     [&]() { context.progress().update(++done); }),
                        phases));
        if (parameters.write_concentration)
          write_concentration(solver, condition, context);
      }
    return member;
  }

  /** All ranks write what they have, plane by plane. */
  static void write_concentration(const VoxelVolume &solver,
                                  const BoundaryCondition condition,
                                  const RunContext &context)
  {
    ParallelRows rows(context.file("rve.h5"), concentration_dataset(to_string(condition)),
                      context.communicator());
    const auto [first, n]   = solver.planes();
    const unsigned int most = dealii::Utilities::MPI::max(n, context.communicator());
    for (unsigned int k = 0; k < most; ++k)
      rows.write(k < n ? first + k : 0, 0,
                 k < n ? solver.concentration(k) : std::vector<double>());
  }

  VoxelMorphology volume; ///< on rank 0
};
} // namespace

std::unique_ptr<Analysis> make_voxel_analysis(const RveParameters &parameters,
                                              const std::string &digest)
{
  return std::make_unique<VoxelAnalysis>(parameters, digest);
}
} // namespace mesoslip
