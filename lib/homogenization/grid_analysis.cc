#include "base/errors.h"
#include "base/exchange.h"
#include "exchange/cell_datasets.h"
#include "homogenization/volume_analysis.h"
#include "homogenization/volumes/grid_volume.h"
#include "homogenization/volumes/voxel_volume.h"
#include "program/machine.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Bytes per cell if the ranks divide the rows, as measured: phases, multigrid, vectors,
 * load cases; and its morphology, which rank 0 makes. */
constexpr double bytes_per_divided_cell = 125. + 3.;

/** Bytes of libraries per rank. */
constexpr double bytes_of_rank = 150e6;

/** Bytes of a replicated volume on a rank, as measured: libraries, solver, displacements
 * of all load cases. With ml the ranks share the volume. */
struct WholeVolume
{
  double solver; ///< per rank
  double fields; ///< per rank that keeps results: rank 0, or each rank with members
};

/** Additional bytes per cell with thermal expansion. */
constexpr double bytes_of_heat = 28.;

bool expands(const RveParameters &parameters)
{
  const auto &phases = parameters.microstructure.phases;
  return std::any_of(phases.begin(), phases.end(),
                     [](const PhaseParameters &phase) { return phase.expands(); });
}

WholeVolume bytes_of_whole(const RveParameters &parameters)
{
  const double n_cells = parameters.microstructure.grid.n_cells();
  const double n       = parameters.conditions.size();
  const double solver  = parameters.solver == StaticSolverKind::multigrid ? 330.
                         : parameters.solver == StaticSolverKind::jacobi  ? 100.
                                                                          : 4000.;
  const double fields  = n * (expands(parameters) ? 64. : 48.);
  return {n_cells * solver, n_cells * fields};
}

/** Memory of all ranks on this machine (bytes). Collective. */
double bytes_here(const RveParameters &parameters, const bool divided)
{
  const double ranks = ranks_of_this_machine();
  if (divided)
    return ranks * bytes_of_rank +
           copies_on_this_machine(parameters.microstructure.grid.cells[1]) *
             (bytes_per_divided_cell + (expands(parameters) ? bytes_of_heat : 0.)) *
             static_cast<double>(parameters.microstructure.grid.n_nodes());
  const WholeVolume whole = bytes_of_whole(parameters);
  if (parameters.solver == StaticSolverKind::ml)
    return ranks * bytes_of_rank + share_of_this_machine() * whole.solver + whole.fields;
  const double volumes =
    parameters.n_members > 1 ? std::min<double>(ranks, parameters.n_members) : ranks;
  return ranks * bytes_of_rank + volumes * whole.solver +
         (parameters.n_members > 1 ? volumes : 1.) * whole.fields;
}

/** Reason why the ranks cannot divide the rows of a volume; empty if they can. */
std::string not_divided(const RveParameters &parameters)
{
  if (parameters.microstructure.phases.size() > VoxelVolume<2>::most_phases)
    return "Homogenization/Solver = divided takes up to " +
           std::to_string(VoxelVolume<2>::most_phases) + " phases";
  return {};
}

/** Whether the ranks divide the rows, and the reason if the choice differs from
 * the .prm. */
struct Division
{
  bool divided       = false;
  std::string reason = {};
};

/** The division asked for or, instead of multigrid, the division that the memory allows.
 * Collective.
 * @throws UserError if nothing fits */
Division choose_division(const RveParameters &parameters)
{
  const bool asked          = parameters.solver == StaticSolverKind::divided;
  const std::string refusal = not_divided(parameters);
  if (asked && !refusal.empty())
    throw UserError(refusal + "; set it to multigrid or leave those out");
  const double memory = memory_of_machine(), parts = bytes_here(parameters, true),
               whole = asked ? parts : bytes_here(parameters, false);
  // All ranks have to choose the same.
  const auto fits_everywhere = [memory](const double bytes) {
    return mpi::min(!(memory > 0.) || bytes <= memory ? 1 : 0, MPI_COMM_WORLD) == 1;
  };
  const bool whole_fits = fits_everywhere(whole), parts_fit = fits_everywhere(parts);
  if (whole_fits)
    return {asked, {}};
  if (refusal.empty() && parts_fit && parameters.solver == StaticSolverKind::multigrid)
    return {true, "Homogenization/Solver: divided, as multigrid would need about " +
                    bytes_text(whole) + " on this machine, which has " +
                    bytes_text(memory) + "; divided needs about " + bytes_text(parts)};
  std::string remedy = "reduce Grid/Cells";
  if (!refusal.empty())
    remedy += " (" + refusal + ")";
  else if (asked || !parts_fit)
    remedy += " or take more machines, among which Homogenization/Solver = divided "
              "divides the " +
              bytes_text(parts) + " that it needs";
  else
    remedy +=
      " or set Homogenization/Solver = divided, which needs about " + bytes_text(parts);
  require_memory({whole, remedy});
  throw UserError(
    "another machine of these ranks has too little memory for the volume; " + remedy);
}

class GridAnalysis : public VolumeAnalysis<2>
{
public:
  GridAnalysis(const RveParameters &given, const std::string &digest_of_inputs)
    : VolumeAnalysis<2>(given, digest_of_inputs, given.microstructure.grid)
    , division(choose_division(given))
    , bytes(bytes_here(given, division.divided))
  {
  }

protected:
  std::string memory() const override
  {
    return std::to_string(static_cast<unsigned long>(1e-6 * bytes)) + " MB" +
           (division.divided ? ", rows divided among the ranks" : "");
  }

  std::vector<std::string>
  describe_morphologies(std::vector<std::string> &warnings) const override
  {
    const Microstructure made      = make_microstructure(parameters.microstructure);
    warnings                       = made.warnings;
    std::vector<std::string> lines = {size_text(*grid) + ", " +
                                      std::to_string(2 * grid->n_nodes()) +
                                      " degrees of freedom"};
    if (!division.reason.empty())
      lines.push_back(division.reason);
    lines.insert(lines.end(), made.description.begin(), made.description.end());
    return lines;
  }

  RveResults<2> morphology() const override
  {
    const Microstructure drawn =
      microstructure ? Microstructure() : make_microstructure(parameters.microstructure);
    const Microstructure &made = microstructure ? *microstructure : drawn;
    RveResults<2> results;
    results.first.grid      = made.map.grid;
    results.first.phases    = made.phases;
    results.first.phase_id  = made.map.id;
    results.first.fractions = area_fractions(made.map, made.phases.size());
    results.rectangles      = made.rectangles;
    results.n_nodes         = made.map.grid.n_nodes();
    return results;
  }

  bool are_cells_divided() const override
  {
    return division.divided;
  }

  void write_cells(const std::string &path,
                   const bool /*with_orientations*/) const override
  {
    write_cell_planes(path, phases_dataset, planes());
  }

  // A single member shares its load cases among the ranks; several are dealt out whole.
  std::optional<int> owner(const unsigned int m) const override
  {
    if (division.divided || parameters.n_members == 1)
      return std::nullopt;
    return static_cast<int>(m % mpi::n_mpi_processes(MPI_COMM_WORLD));
  }

  std::vector<std::string> make_morphology(const unsigned int m,
                                           EnsembleMember<2> &member) override
  {
    MicrostructureParameters own = parameters.microstructure;
    own.placement.seed += m;
    const auto make = [&]() {
      microstructure  = make_microstructure(own);
      member.origin   = "seed " + std::to_string(own.placement.seed);
      member.warnings = microstructure->warnings;
      member.fractions =
        area_fractions(microstructure->map, microstructure->phases.size());
    };
    microstructure = Microstructure(); // avoids two in memory
    if (division.divided)
      on_root(MPI_COMM_WORLD, make);
    else
      make();
    std::vector<std::string> lines = microstructure->description;
    lines.insert(lines.begin(), "Grid: " + size_text(*grid));
    if (!division.reason.empty())
      lines.insert(lines.begin(), division.reason);
    return lines;
  }

  std::unique_ptr<VolumeElement<2>>
  make_volume(const std::vector<ElasticPhase<2>> &phases,
              const std::function<void()> &case_done,
              Timer &timer) override
  {
    if (!division.divided)
      return std::make_unique<GridVolume>(
        *grid, make_material(microstructure->map, phases), parameters.solver,
        parameters.conditions, parameters.tolerance,
        parameters.n_members > 1 ? MPI_COMM_SELF : MPI_COMM_WORLD, case_done, &timer);
    if (microstructure)
      rows = scatter_planes(in_space(*grid), CellView(microstructure->map.id),
                            phases.size(), MPI_COMM_WORLD);
    microstructure.reset(); // each rank has its rows
    return std::make_unique<VoxelVolume<2>>(*grid, planes(), phases);
  }

  ConductionCells<2> cells_for_conduction(const unsigned int /*m*/) const override
  {
    const std::vector<std::uint8_t> &id = microstructure->map.id; // current member
    ConductionCells<2> cells            = conduction_cells(*grid);
    for (std::size_t k = 0; k < id.size(); ++k)
      cells.mesh.cells[k].material_id = id[k];
    for (const PhaseParameters &phase : parameters.microstructure.phases)
      cells.conductivity.push_back(phase.conductivity<2>());
    return cells;
  }

  std::string advice(const NotConverged &failure) const override
  {
    const std::string more = VolumeAnalysis<2>::advice(failure);
    if (failure.reason == NotConverged::Reason::not_finite ||
        (!division.divided && parameters.solver == StaticSolverKind::multigrid))
      return more;
    return std::string("set Homogenization/Solver = multigrid") +
           (division.divided ? ", which takes more memory" : "") +
           (more.empty() ? "" : "; " + more);
  }

private:
  /** Materials of the locally owned rows of cells. */
  CellPlanes planes() const
  {
    return {in_space(*grid), rows.view(), MPI_COMM_WORLD};
  }

  const Division division;                      ///< division of the rows
  const double bytes;                           ///< needed by the ranks of this machine
  std::optional<Microstructure> microstructure; ///< current member
  CellIndices rows;                             ///< phases of locally owned rows
};
} // namespace

std::unique_ptr<Analysis> make_grid_analysis(const RveParameters &parameters,
                                             const std::string &digest)
{
  return std::make_unique<GridAnalysis>(parameters, digest);
}
} // namespace mesoslip
