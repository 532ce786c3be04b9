#include "homogenization/divided_members.h"

#include "base/exchange.h"
#include "exchange/cell_datasets.h"
#include "exchange/datasets.h"
#include "exchange/loads_file.h"
#include "homogenization/loads/load_output.h"
#include "homogenization/loads/volume_cells.h"
#include "io/parallel_rows.h"
#include "program/run_context.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Bytes of a cell, divided among the ranks: phases, multigrid, vectors, load cases; as
 *  measured. */
constexpr double bytes_per_cell = 125.;
/** Of the morphology, which rank 0 makes. */
constexpr double bytes_of_morphology = 3.;

/** What a member is when its morphology is made, on rank 0. */
EnsembleMember<2> member_of(const RveParameters &parameters,
                            const Microstructure &microstructure)
{
  EnsembleMember<2> member;
  member.origin    = "seed " + std::to_string(parameters.microstructure.placement.seed);
  member.warnings  = microstructure.warnings;
  member.fractions = area_fractions(microstructure.map, microstructure.phases.size());
  return member;
}

/** Solves the load cases of a member, whose @p phase_id rank 0 has, and evaluates them; fields are
 *  written of the first, those of loads to @p loads_file. */
void solve_member(const RveParameters &parameters,
                  std::vector<std::uint8_t> &&phase_id,
                  const unsigned int number,
                  const std::string &loads_file,
                  EnsembleMember<2> &member,
                  RunContext &context)
{
  const auto scope             = context.timer().scope("Load cases");
  const auto &phase_parameters = parameters.microstructure.phases;
  const UniformGrid<2> &grid   = parameters.microstructure.grid;
  const LoadParameters &loads  = parameters.loads;
  std::uint64_t done           = 3 * parameters.conditions.size() * number;
  std::vector<ElasticPhase<2>> phases;
  for (const Phase<2> &phase : make_phases<2>(phase_parameters))
    phases.push_back({phase.stiffness, phase.density});
  FlatVolume volume(grid, CellView(phase_id), phases, context.communicator());
  std::vector<std::uint8_t>().swap(phase_id); // each rank has its rows
  if (number == 0)
    write_cells(parameters, volume.materials(), std::nullopt, context);
  for (const BoundaryCondition condition : parameters.conditions)
    {
      const auto part = context.timer().scope(to_string(condition).c_str());
      member.responses.push_back(
        homogenize<2>(volume.solve(condition, parameters.tolerance,
                                   [&]() { context.progress().update(++done); }),
                      phases));
      if (parameters.write_concentration && number == 0)
        write_concentration(volume, condition, context);
      if (!loads.loads.empty() && loads.uses(condition))
        for (LoadResult<2> &result : evaluate_loads<2>(
               loads, member.responses.back(), loaded_phases<2>(phase_parameters),
               VoxelCells<2>(volume, grid, context.communicator()),
               number == 0 ? loads_file : std::string()))
          member.loads.push_back(std::move(result));
    }
}
} // namespace

double bytes_of_divided(const RveParameters &parameters)
{
  return (bytes_per_cell + bytes_of_morphology) *
         static_cast<double>(parameters.microstructure.grid.n_nodes());
}

void set_first(RveResults<2> &results, const Microstructure &microstructure)
{
  results.first.grid     = microstructure.map.grid;
  results.first.phases   = microstructure.phases;
  results.first.phase_id = microstructure.map.id;
  results.rectangles     = microstructure.rectangles;
  results.n_nodes        = microstructure.map.grid.n_nodes();
}

template <int dim>
std::string reserve_fields(const RveParameters &parameters,
                           const UniformGrid<dim> &grid,
                           RveContent<dim> &content,
                           const RunContext &context)
{
  if (parameters.write_concentration)
    for (const BoundaryCondition condition : parameters.conditions)
      content.reserved.push_back(to_string(condition));
  // As those that rank 0 writes alone.
  std::sort(content.reserved.begin(), content.reserved.end());
  std::string loads_file;
  on_root(context.communicator(), [&]() {
    const Shape cells     = shape_of_cells(grid);
    const std::string rve = context.file("rve.h5"), loads = context.file("loads.h5");
    reserve_concentration(rve, grid, content.reserved);
    reserve_cells(rve, cells, !parameters.microstructure.orientation.file.empty());
    if (parameters.loads.loads.empty())
      return;
    loads_file = reserve_loads<dim>(parameters, loads, cells);
    if (loads_file.empty())
      reserve_load_fields(loads, cells, 1, {});
    reserve_cells(loads, cells, false);
  });
  broadcast(context.communicator(), loads_file);
  return loads_file;
}

void write_cells(const RveParameters &parameters,
                 const CellPlanes &phases,
                 const std::optional<CellPlanes> &orientations,
                 const RunContext &context)
{
  write_cell_planes(context.file("rve.h5"), phases_dataset, phases);
  if (orientations)
    write_cell_planes(context.file("rve.h5"), orientations_dataset, *orientations);
  if (!parameters.loads.loads.empty())
    write_cell_planes(context.file("loads.h5"), phases_dataset, phases);
}

template <typename Volume>
void write_concentration(const Volume &volume,
                         const BoundaryCondition condition,
                         const RunContext &context)
{
  ParallelRows rows(context.file("rve.h5"), concentration_dataset(to_string(condition)),
                    context.communicator());
  const auto [first, n]   = volume.planes();
  const unsigned int most = mpi::max(n, context.communicator());
  for (unsigned int k = 0; k < most; ++k)
    rows.write(k < n ? first + k : 0, 0,
               k < n ? volume.concentration(k) : std::vector<double>());
}

RveResults<2> compute_divided_members(const RveParameters &parameters,
                                      RunContext &context)
{
  RveResults<2> results;
  const unsigned int n = parameters.n_members;
  context.progress().start("Load cases",
                           std::uint64_t{3} * n * parameters.conditions.size());
  const std::string loads_file =
    reserve_fields<2>(parameters, parameters.microstructure.grid, results.first, context);
  for (unsigned int m = 0; m < n; ++m)
    {
      RveParameters own = parameters;
      own.microstructure.placement.seed += m;
      Microstructure microstructure;
      EnsembleMember<2> member;
      on_root(context.communicator(), [&]() {
        const auto scope = context.timer().scope("Microstructure");
        microstructure   = make_microstructure(own.microstructure);
        member           = member_of(own, microstructure);
        if (m == 0)
          {
            context.log("Grid: " + size_text(microstructure.map.grid));
            for (const std::string &line : microstructure.description)
              context.log(line);
            set_first(results, microstructure);
            results.first.phase_id.clear(); // the ranks write them
          }
        for (const std::string &warning : microstructure.warnings)
          if (n == 1) // those of several are told apart when all are known
            context.warn(warning);
      });
      solve_member(own, std::move(microstructure.map.id), m, loads_file, member, context);
      results.members.push_back(std::move(member));
    }
  context.progress().finish();
  if (n > 1 && context.root())
    for (const std::string &warning : morphology_warnings<2>(results.members))
      context.warn(warning);
  return results;
}

template std::string reserve_fields<2>(const RveParameters &,
                                       const UniformGrid<2> &,
                                       RveContent<2> &,
                                       const RunContext &);
template std::string reserve_fields<3>(const RveParameters &,
                                       const UniformGrid<3> &,
                                       RveContent<3> &,
                                       const RunContext &);
template void
write_concentration(const FlatVolume &, const BoundaryCondition, const RunContext &);
template void
write_concentration(const VoxelVolume &, const BoundaryCondition, const RunContext &);
} // namespace mesoslip
