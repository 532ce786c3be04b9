#include "base/errors.h"
#include "base/object_exchange.h"
#include "exchange/cell_datasets.h"
#include "exchange/loads_file.h"
#include "homogenization/conduction/conduction_volume.h"
#include "homogenization/derivatives/variations.h"
#include "homogenization/loads/load_output.h"
#include "homogenization/volume_analysis.h"
#include "io/parallel_rows.h"
#include "program/run_context.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Bytes per cell of ConductionVolume, as measured: mesh, matrix, multigrid. */
template <int dim>
constexpr double bytes_per_conducting_cell = dim == 2 ? 600. : 1200.;

/** Writes the concentration tensors of the cells for the @p condition that @p volume has
 * solved last. Collective among the ranks that have them. */
template <int dim>
void write_concentration(const VolumeElement<dim> &volume,
                         const BoundaryCondition condition,
                         const std::vector<ElasticPhase<dim>> &phases,
                         const std::string &path)
{
  constexpr std::size_t n = n_voigt<dim> * n_voigt<dim>;
  volume.write(path, {{concentration_dataset(to_string(condition)), n}}, n,
               [&](const LocalCell<dim> &cell, double *out) {
                 VoigtMatrix<dim> tensor = cell.strain.template leftCols<n_voigt<dim>>();
                 if (condition == BoundaryCondition::SUBC)
                   tensor = (phases[cell.phase].stiffness * tensor).eval();
                 std::copy_n(tensor.data(), n, out);
               });
}

/** Like write_concentration(), for the cell stress at one kelvin; in 2D
 * @p with_transverse adds sigma_zz. */
template <int dim>
void write_thermal_stress(const VolumeElement<dim> &volume,
                          const BoundaryCondition condition,
                          const std::vector<LoadedPhase<dim>> &phases,
                          const bool with_transverse,
                          const std::string &path)
{
  constexpr std::size_t n           = n_voigt<dim>;
  const std::string name            = to_string(condition);
  std::vector<CellDataset> datasets = {{thermal_stress_dataset(name), n}};
  if (with_transverse)
    datasets.push_back({transverse_thermal_stress_dataset(name), 1, n});
  volume.write(path, datasets, with_transverse ? n + 1 : n,
               [&](const LocalCell<dim> &cell, double *out) {
                 const LoadedPhase<dim> &phase = phases[cell.phase];
                 const VoigtVector<dim> strain = cell.strain.col(n),
                                        stress =
                                          phase.stiffness * strain - phase.thermal_stress;
                 out = std::copy_n(stress.data(), n, out);
                 if (with_transverse)
                   *out = phase.transverse->dot(strain) - phase.transverse_thermal;
               });
}
} // namespace

template <int dim>
std::string VolumeAnalysis<dim>::reserve_fields(const RunContext &context) const
{
  std::string loads_file;
  on_root(context.communicator(), [&]() {
    const std::string rve = context.file("rve.h5"), loads = context.file("loads.h5");
    if (parameters.write_concentration || are_cells_divided())
      reserve_concentration<dim>(rve, shape(), reserved_conditions(),
                                 parameters.write_concentration ? further_fields()
                                                                : FurtherFields());
    if (are_cells_divided())
      reserve_cells(rve, shape(), !parameters.microstructure.orientation.file.empty());
    loads_file = reserve_loads<dim>(parameters, loads, shape());
    if (parameters.loads.loads.empty() || !are_cells_divided())
      return;
    if (loads_file.empty())
      reserve_load_fields(loads, shape(), {});
    reserve_cells(loads, shape(), false);
  });
  broadcast(context.communicator(), loads_file);
  return loads_file;
}

template <int dim>
void VolumeAnalysis<dim>::begin_member(const unsigned int m,
                                       EnsembleMember<dim> &member,
                                       RveResults<dim> &results,
                                       RunContext &context)
{
  const auto scope                     = context.timer().scope("Microstructure");
  const std::vector<std::string> lines = make_morphology(m, member);
  if (!context.root())
    return;
  if (m == 0)
    {
      for (const std::vector<std::string> &some : {lines, lines_of_cells()})
        for (const std::string &line : some)
          context.log(line);
      results = morphology();
      if (are_cells_divided())
        results.first.phase_id.clear();
    }
  if (parameters.n_members == 1) // several members are told apart when all are known
    for (const std::string &warning : member.warnings)
      context.warn(warning);
}

template <int dim>
FurtherFields VolumeAnalysis<dim>::further_fields() const
{
  FurtherFields further;
  further.thermal_stress = expands();
  for (const LoadedPhase<dim> &phase :
       loaded_phases<dim>(parameters.microstructure.phases))
    further.transverse_thermal_stress =
      dim == 2 && further.thermal_stress && phase.transverse.has_value() &&
      (phase.part == 0 || further.transverse_thermal_stress);
  further.conduction = !parameters.microstructure.phases[0].conductivities.empty();
  return further;
}

template <int dim>
double VolumeAnalysis<dim>::bytes_of_conduction(const unsigned int n_ranks) const
{
  if (!further_fields().conduction)
    return 0.;
  // Members with an owner are solved side by side.
  return bytes_per_conducting_cell<dim> * static_cast<double>(n_cells()) *
         (owner(0) ? std::min(n_ranks, parameters.n_members) : 1U);
}

template <int dim>
std::vector<StiffnessChanges<dim>>
VolumeAnalysis<dim>::changes_of(const std::vector<LoadedPhase<dim>> &of_cells,
                                const std::vector<Variation<dim>> &variations) const
{
  std::vector<StiffnessChanges<dim>> changes(of_cells.size());
  for (std::size_t m = 0; m < changes.size(); ++m)
    for (std::size_t v = 0; v < variations.size(); ++v)
      if (const VoigtMatrix<dim> &of_phase = variations[v].stiffness[of_cells[m].part];
          !of_phase.isZero(0.))
        changes[m].emplace_back(v, turned(m, of_phase));
  return changes;
}

template <int dim>
void VolumeAnalysis<dim>::solve_conduction(const unsigned int m,
                                           EnsembleMember<dim> &member,
                                           RunContext &context)
{
  if (parameters.microstructure.phases[0].conductivities.empty())
    return;
  const auto scope = context.timer().scope("Conduction");
  const auto solve = [&]() {
    const ConductionCells<dim> cells = cells_for_conduction(m);
    ConductionVolume<dim> volume(cells);
    for (const BoundaryCondition condition : parameters.conditions)
      try
        {
          member.conduction.push_back(volume.solve(condition, parameters.tolerance));
          if (m == 0 && parameters.write_concentration)
            ParallelRows(context.file("rve.h5"), conduction_dataset(to_string(condition)),
                         MPI_COMM_SELF)
              .write_rows(0, volume.concentration());
        }
      catch (const NotConverged &e)
        {
          // Not passed on as NotConverged, which all ranks have to throw together.
          throw NumericalFailure(
            e.what() + std::string("; check Phases/.../Conductivity, whose values "
                                   "should not differ by many orders of magnitude"));
        }
  };
  if (owner(m)) // solved by this rank only
    solve();
  else
    on_root(context.communicator(), solve);
}

template <int dim>
void VolumeAnalysis<dim>::solve_member(const unsigned int m,
                                       const std::string &loads_file,
                                       EnsembleMember<dim> &member,
                                       RunContext &context)
{
  Timer &timer                                 = context.timer();
  const auto scope                             = timer.scope("Load cases");
  const std::vector<LoadedPhase<dim>> of_cells = materials();
  std::vector<ElasticPhase<dim>> phases;
  std::vector<unsigned int> part;
  for (const LoadedPhase<dim> &material : of_cells)
    {
      phases.push_back( // density 0: statics
        {material.stiffness, 0.,
         has_mean_dilatation<dim>(material.stiffness, parameters.mean_dilatation),
         material.thermal_stress});
      part.push_back(material.part);
    }
  const auto variations =
    variations_of<dim>(parameters.microstructure.phases, parameters.derivatives);
  const auto changes   = changes_of(of_cells, variations);
  std::uint64_t done   = m * n_cases();
  const auto case_done = [&]() { context.progress().update(++done); };
  const auto volume    = make_volume(phases, case_done, timer);
  if (m == 0 && are_cells_divided())
    {
      write_cells(context.file("rve.h5"), true);
      if (!parameters.loads.loads.empty())
        write_cells(context.file("loads.h5"), false);
    }
  for (const BoundaryCondition condition : parameters.conditions)
    {
      const VolumeSums<dim> sums = [&]() {
        const auto one = timer.scope(to_string(condition).c_str());
        return volume->solve(condition, parameters.tolerance, case_done);
      }();
      if (!volume->is_here())
        continue;
      const auto rest                   = timer.scope("Responses");
      HomogenizedResponse<dim> response = homogenize<dim>(sums, phases);
      response.derivatives =
        stiffness_derivatives(*volume, response, changes, variations.size());
      for (std::size_t k = 0; k < of_cells.size(); ++k)
        response.heat.held +=
          sums.phases[k].volume / sums.volume * of_cells[k].thermal_energy;
      gather_parts(response, sums, part, parameters.microstructure.phases.size());
      if (parameters.write_concentration && m == 0)
        {
          write_concentration(*volume, condition, phases, context.file("rve.h5"));
          if (has_expansion(phases))
            write_thermal_stress(*volume, condition, of_cells,
                                 further_fields().transverse_thermal_stress,
                                 context.file("rve.h5"));
        }
      if (!parameters.loads.loads.empty() && parameters.loads.uses(condition))
        for (LoadResult<dim> &result :
             evaluate_loads(parameters.loads, response, of_cells, *volume,
                            m == 0 ? loads_file : std::string()))
          member.loads.push_back(std::move(result));
      member.responses.push_back(std::move(response));
    }
}

template <int dim>
RveResults<dim> VolumeAnalysis<dim>::compute(RunContext &context)
{
  RveResults<dim> results;
  const unsigned int n = parameters.n_members;
  context.progress().start("Load cases", n_cases() * n);
  const std::string loads_file = reserve_fields(context);
  for (unsigned int m = 0; m < n; ++m)
    {
      EnsembleMember<dim> member;
      if (!owner(m) || *owner(m) == context.rank())
        {
          begin_member(m, member, results, context);
          solve_conduction(m, member, context);
          solve_member(m, loads_file, member, context);
          if (parameters.complex_loss)
            solve_loss(m, member, context);
        }
      results.members.push_back(std::move(member));
    }
  context.progress().finish();
  for (unsigned int m = 0; m < n; ++m)
    if (const auto rank = owner(m))
      bring_object_to_root(context.communicator(), results.members[m], *rank);
  results.first.reserved = reserved_conditions();
  if (n > 1 && context.root())
    for (const std::string &warning : morphology_warnings<dim>(results.members))
      context.warn(warning);
  return results;
}

#define MESOSLIP_INSTANTIATE(dim)                                                     \
  template std::string VolumeAnalysis<dim>::reserve_fields(const RunContext &) const; \
  template double VolumeAnalysis<dim>::bytes_of_conduction(const unsigned int) const; \
  template RveResults<dim> VolumeAnalysis<dim>::compute(RunContext &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
