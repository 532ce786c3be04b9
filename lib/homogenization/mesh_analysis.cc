#include "base/errors.h"
#include "base/object_exchange.h"
#include "exchange/rve_file.h"
#include "homogenization/loads/load_output.h"
#include "homogenization/loads/volume_cells.h"
#include "homogenization/mesh_volume.h"
#include "homogenization/volume_analysis.h"
#include "io/parallel_rows.h"
#include "material/plausibility.h"
#include "program/machine.h"
#include "program/run_context.h"

#include <algorithm>
#include <filesystem>
#include <ostream>

namespace mesoslip
{
namespace
{
/** Bytes that a node costs all ranks together, measured with ML: cells, matrix, hierarchy, load
 * cases. */
template <int dim>
constexpr double bytes_per_node = dim == 2 ? 3400. : 15000.;
/** More where several boundary conditions or members are computed one after the other. */
template <int dim>
constexpr double bytes_of_several = dim == 2 ? 1200. : 6000.;

template <int dim>
class MeshVolumeAnalysis : public VolumeAnalysis<dim>
{
public:
  MeshVolumeAnalysis(const RveParameters &given, const std::string &digest_of_inputs)
    : VolumeAnalysis<dim>(given, digest_of_inputs)
  {
    on_root(MPI_COMM_WORLD, [this]() { read_all(); });
    broadcast_object(MPI_COMM_WORLD, sizes);
    require_memory({share_of_this_machine() * bytes_of_volume(),
                    "take a coarser mesh or more machines"});
  }

  void describe(std::ostream &out) const override
  {
    for (const MeshMorphology<dim> &volume : volumes)
      {
        for (const std::string &line : volume.description)
          out << line << '\n';
        for (const std::string &line : periodicity_lines(volume.mesh))
          out << line << '\n';
        for (const std::string &warning : volume.warnings)
          out << "warning: " << warning << '\n';
      }
    out << n_cases() * volumes.size() << " load cases, about "
        << static_cast<unsigned long>(150 + 1e-6 * bytes_of_volume())
        << " MB, divided among the ranks\n"
        << bytes_text(this->need().bytes) << " on the disk\n";
    for (const std::string &warning : slips())
      out << "warning: " << warning << '\n';
  }

protected:
  double n_cells() const override
  {
    return static_cast<double>(sizes[1]);
  }

  std::vector<std::string> slips() const override
  {
    const auto phases = make_phases<dim>(parameters.microstructure.phases);
    auto sentences    = implausible(plausible_phases<dim>(phases));
    for (const std::string &one : stiffness_warnings<dim>(phases))
      sentences.push_back(one);
    return sentences;
  }

  RveResults<dim> compute(RunContext &context) override
  {
    RveResults<dim> results;
    context.progress().start("Load cases", n_cases() * parameters.n_members);
    if (parameters.write_concentration)
      {
        for (const BoundaryCondition condition : parameters.conditions)
          results.first.reserved.push_back(to_string(condition));
        std::sort(results.first.reserved.begin(), results.first.reserved.end());
        on_root(context.communicator(), [&]() {
          reserve_concentration<dim>(context.file("rve.h5"), sizes[1],
                                     results.first.reserved);
        });
      }
    constexpr std::size_t cells_together = 1024;
    on_root(context.communicator(), [&]() {
      loads_file = reserve_loads<dim>(parameters, context.file("loads.h5"), {sizes[1]},
                                      cells_together);
    });
    broadcast(context.communicator(), loads_file);
    for (unsigned int m = 0; m < parameters.n_members; ++m)
      results.members.push_back(compute_member(m, context));
    context.progress().finish();
    if (!context.root())
      return results;
    if (parameters.n_members > 1)
      for (const std::string &warning : morphology_warnings<dim>(results.members))
        context.warn(warning);
    results.first.mesh     = &volumes[0].mesh;
    results.first.phases   = volumes[0].phases;
    results.first.phase_id = phase_id();
    results.n_nodes        = sizes[0];
    return results;
  }

  RveContent<dim> morphology() const override
  {
    RveContent<dim> content;
    content.mesh      = &volumes[0].mesh;
    content.phases    = volumes[0].phases;
    content.fractions = volumes[0].fractions;
    content.phase_id  = phase_id();
    return content;
  }

  std::string advice(const NotConverged &failure) const override
  {
    // The worst angles of the cells are among the lines on the mesh.
    return failure.reason == NotConverged::Reason::not_finite
             ? "check the moduli of Phases and Mesh/Scale: forces or displacements are "
               "beyond the range of numbers"
             : this->causes(failure, 1.);
  }

private:
  using VolumeAnalysis<dim>::parameters;

  std::uint64_t n_cases() const
  {
    return n_voigt<dim> * parameters.conditions.size();
  }

  /** What the first mesh takes on all ranks together (bytes). */
  double bytes_of_volume() const
  {
    const bool several = parameters.conditions.size() > 1 || parameters.n_members > 1;
    const double more  = several ? bytes_of_several<dim> : 0.;
    return (bytes_per_node<dim> + more) * static_cast<double>(sizes[0]);
  }

  /** Phase of each cell of the first mesh; on rank 0. */
  std::vector<std::uint8_t> phase_id() const
  {
    std::vector<std::uint8_t> id;
    for (const auto &cell : volumes[0].mesh.cells)
      id.push_back(static_cast<std::uint8_t>(cell.material_id));
    return id;
  }

  // Whatever may be wrong with a later mesh is found before the first is computed.
  void read_all()
  {
    const bool periodic = std::count(parameters.conditions.begin(),
                                     parameters.conditions.end(), BoundaryCondition::PBC);
    for (const std::string &file : parameters.mesh.files)
      {
        volumes.push_back(
          read_mesh<dim>(parameters.mesh, file, parameters.microstructure.phases));
        require_volume(volumes.back().mesh, periodic);
      }
    sizes = {volumes[0].mesh.points.size(), volumes[0].mesh.cells.size()};
  }

  EnsembleMember<dim> compute_member(const unsigned int m, RunContext &context)
  {
    EnsembleMember<dim> member;
    Mesh<dim> none;
    std::vector<ElasticPhase<dim>> phases;
    for (const auto &phase : make_phases<dim>(parameters.microstructure.phases))
      phases.push_back({phase.stiffness, phase.density});
    if (context.root())
      {
        const MeshMorphology<dim> &morphology = volumes[m];
        member.origin =
          "mesh " + std::filesystem::path(morphology.file).filename().string();
        member.warnings  = morphology.warnings;
        member.fractions = morphology.fractions;
        if (m == 0)
          {
            for (const std::string &line : morphology.description)
              context.log(line);
            context.log(std::string("Solver: conjugate gradients with the multigrid ") +
                        AlgebraicMultigrid::name());
          }
        if (parameters.n_members == 1)
          for (const std::string &warning : morphology.warnings)
            context.warn(warning);
      }
    const auto scope   = context.timer().scope("Load cases");
    std::uint64_t done = m * n_cases();
    MeshVolume<dim> volume(context.root() ? volumes[m].mesh : none, phases,
                           context.communicator());
    for (const BoundaryCondition condition : parameters.conditions)
      {
        const auto part = context.timer().scope(to_string(condition).c_str());
        member.responses.push_back(
          homogenize<dim>(volume.solve(condition, parameters.tolerance,
                                       [&]() { context.progress().update(++done); }),
                          phases));
        if (parameters.write_concentration && m == 0)
          write_concentration(volume.concentration(), condition, context);
        if (!parameters.loads.loads.empty() && parameters.loads.uses(condition))
          for (LoadResult<dim> &result : evaluate_loads<dim>(
                 parameters.loads, member.responses.back(),
                 loaded_phases<dim>(parameters.microstructure.phases),
                 MeshCells<dim>(volume), m == 0 ? loads_file : std::string()))
            member.loads.push_back(std::move(result));
      }
    return member;
  }

  /** All ranks write their blocks of cells. */
  static void write_concentration(const typename MeshVolume<dim>::CellTensors &tensors,
                                  const BoundaryCondition condition,
                                  const RunContext &context)
  {
    ParallelRows rows(context.file("rve.h5"), concentration_dataset(to_string(condition)),
                      context.communicator());
    rows.write_rows(tensors.first, tensors.values);
  }

  std::vector<MeshMorphology<dim>> volumes; ///< on rank 0
  std::string loads_file;                   ///< where fields of loads go; empty: nowhere
  std::vector<std::uint64_t> sizes = {0,
                                      0}; ///< points and cells of the first, everywhere
};
} // namespace

template <int dim>
std::unique_ptr<Analysis> make_mesh_analysis(const RveParameters &parameters,
                                             const std::string &digest)
{
  return std::make_unique<MeshVolumeAnalysis<dim>>(parameters, digest);
}

template std::unique_ptr<Analysis> make_mesh_analysis<2>(const RveParameters &,
                                                         const std::string &);
template std::unique_ptr<Analysis> make_mesh_analysis<3>(const RveParameters &,
                                                         const std::string &);
} // namespace mesoslip
