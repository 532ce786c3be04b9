#include "base/errors.h"
#include "base/object_exchange.h"
#include "grid/uniform_grid.h"
#include "homogenization/divided_members.h"
#include "homogenization/loads/load_output.h"
#include "homogenization/loads/volume_cells.h"
#include "homogenization/volume_analysis.h"
#include "material/plausibility.h"
#include "program/machine.h"
#include "program/run_context.h"

#include <algorithm>
#include <ostream>

namespace mesoslip
{
namespace
{
EnsembleMember<2> compute_member(const RveParameters &parameters,
                                 const Microstructure &microstructure,
                                 const MPI_Comm communicator,
                                 const bool keep_concentration,
                                 const std::string &loads_file,
                                 const LoadCaseProgress &progress,
                                 Timer &timer)
{
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  const UniformMaterial material = make_material(microstructure);
  EnsembleMember<2> member;
  member.origin    = "seed " + std::to_string(parameters.microstructure.placement.seed);
  member.warnings  = microstructure.warnings;
  member.fractions = area_fractions(microstructure.map, microstructure.phases.size());
  const auto body  = make_body(material, parameters.solver, communicator);
  auto solutions   = solve_load_cases(*body, parameters.conditions, parameters.tolerance,
                                      communicator, progress, &timer);
  const auto scope = timer.scope("Responses");
  for (LoadCaseSolutions &solution : solutions)
    {
      if (rank == 0 || body->is_distributed())
        member.responses.push_back(
          homogenize(*body, solution, rank == 0 && keep_concentration));
      if (rank == 0 && !parameters.loads.loads.empty() &&
          parameters.loads.uses(solution.condition))
        for (LoadResult<2> &result : evaluate_loads(
               parameters.loads, member.responses.back(),
               loaded_phases<2>(parameters.microstructure.phases),
               GridCells(*body, solution, microstructure.map.grid), loads_file))
          member.loads.push_back(std::move(result));
      solution.displacement = {};
    }
  return member;
}

// A single member shares its load cases among the ranks; several are dealt out whole.
RveResults<2> compute_members(const RveParameters &parameters, RunContext &context)
{
  RveResults<2> results;
  const unsigned int n = parameters.n_members;
  results.members.resize(n);
  const unsigned int n_cases = 3 * parameters.conditions.size();
  context.progress().start("Load cases", std::uint64_t{n} * n_cases);
  for (unsigned int m = 0; m < n; ++m)
    {
      if (n > 1 && static_cast<int>(m) % context.n_ranks() != context.rank())
        continue;
      RveParameters own = parameters;
      own.microstructure.placement.seed += m;
      const Microstructure microstructure = [&]() {
        const auto scope = context.timer().scope("Microstructure");
        return make_microstructure(own.microstructure);
      }();
      if (m == 0)
        {
          context.log("Grid: " + size_text(microstructure.map.grid));
          for (const std::string &line : microstructure.description)
            context.log(line);
        }
      for (const std::string &warning : microstructure.warnings)
        if (n == 1) // those of several are told apart when all are known
          context.warn(warning);
      const auto scope           = context.timer().scope("Load cases");
      const UniformGrid<2> &grid = microstructure.map.grid;
      const std::string loads_file =
        m == 0 && context.root() ? reserve_loads<2>(parameters, context.file("loads.h5"),
                                                    {grid.cells[1], grid.cells[0]})
                                 : std::string();
      results.members[m] = compute_member(
        own, microstructure, n > 1 ? MPI_COMM_SELF : context.communicator(),
        parameters.write_concentration && m == 0, loads_file,
        [&](const unsigned int done, const unsigned int) {
          context.progress().update(m * n_cases + done);
        },
        context.timer());
      if (m == 0)
        set_first(results, microstructure);
    }
  context.progress().finish();
  for (unsigned int m = 0; n > 1 && m < n; ++m)
    bring_object_to_root(context.communicator(), results.members[m],
                         static_cast<int>(m) % context.n_ranks());
  if (n > 1)
    for (const std::string &warning : morphology_warnings<2>(results.members))
      context.warn(warning);
  return results;
}

/** Bytes of libraries that every rank loads. */
constexpr double bytes_of_rank = 150e6;

/** Bytes of a rank that has a whole volume: libraries, solver, displacements of all load
 *  cases, concentration tensors; as measured. With ml the ranks share the volume. */
struct WholeVolume
{
  double solver; ///< of every rank
  double fields; ///< of those that keep results: rank 0, or each that has members
};

WholeVolume bytes_of_whole(const RveParameters &parameters)
{
  const double n_cells = parameters.microstructure.grid.n_cells();
  const double n       = parameters.conditions.size();
  const double solver  = parameters.solver == StaticSolverKind::multigrid ? 330.
                         : parameters.solver == StaticSolverKind::jacobi  ? 100.
                                                                          : 4000.;
  const double fields  = n * (48. + (parameters.write_concentration ? 72. : 0.));
  return {n_cells * solver, n_cells * fields};
}

/** Bytes that all ranks on this machine need together. Collective. */
double bytes_here(const RveParameters &parameters, const bool divided)
{
  const double ranks = ranks_of_this_machine();
  if (divided)
    return ranks * bytes_of_rank +
           copies_on_this_machine(parameters.microstructure.grid.cells[1]) *
             bytes_of_divided(parameters);
  const WholeVolume whole = bytes_of_whole(parameters);
  if (parameters.solver == StaticSolverKind::ml)
    return ranks * bytes_of_rank + share_of_this_machine() * whole.solver + whole.fields;
  const double volumes =
    parameters.n_members > 1 ? std::min<double>(ranks, parameters.n_members) : ranks;
  return ranks * bytes_of_rank + volumes * whole.solver +
         (parameters.n_members > 1 ? volumes : 1.) * whole.fields;
}

/** Why the ranks cannot divide the rows of a volume; empty if they can. */
std::string not_divided(const RveParameters &parameters)
{
  if (parameters.microstructure.phases.size() > FlatVolume::most_phases)
    return "Homogenization/Solver = divided takes up to " +
           std::to_string(FlatVolume::most_phases) + " phases";
  return {};
}

/** Whether the ranks divide the rows, and why if that is not what the .prm asks for. */
struct Division
{
  bool divided       = false;
  std::string reason = {};
};

/** What is asked for or, instead of multigrid, what the memory allows. Collective.
 *  @throws UserError if nothing fits */
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

// What looks like another unit.
std::vector<std::string> slips_of(const MicrostructureParameters &p)
{
  const std::vector<Phase<2>> phases = make_phases<2>(p.phases);
  std::vector<PlausibleRange> ranges = plausible_phases<2>(phases);
  for (unsigned int d = 0; d < 2; ++d)
    ranges.push_back(
      plausible_length("Grid/Size along " + std::string(1, "xy"[d]), p.grid.extent(d)));
  std::vector<std::string> sentences = implausible(ranges);
  for (const std::string &one : stiffness_warnings<2>(phases))
    sentences.push_back(one);
  return sentences;
}

class GridAnalysis : public VolumeAnalysis<2>
{
public:
  GridAnalysis(const RveParameters &given, const std::string &digest_of_inputs)
    : VolumeAnalysis<2>(given, digest_of_inputs)
    , division(choose_division(given))
    , bytes(bytes_here(given, division.divided))
  {
  }

  void describe(std::ostream &out) const override
  {
    const UniformGrid<2> grid = parameters.microstructure.grid;
    out << size_text(grid) << ", " << 2 * grid.n_nodes() << " degrees of freedom\n"
        << 3 * parameters.conditions.size() * parameters.n_members
        << " load cases, about " << static_cast<unsigned long>(1e-6 * bytes) << " MB"
        << (division.divided ? ", rows divided among the ranks\n" : "\n")
        << bytes_text(need().bytes) << " on the disk\n";
    if (!division.reason.empty())
      out << division.reason << '\n';
    const Microstructure microstructure = make_microstructure(parameters.microstructure);
    for (const std::string &line : microstructure.description)
      out << line << '\n';
    for (const auto &warnings : {microstructure.warnings, slips()})
      for (const std::string &warning : warnings)
        out << "warning: " << warning << '\n';
  }

protected:
  double n_cells() const override
  {
    return static_cast<double>(parameters.microstructure.grid.n_cells());
  }

  RveContent<2> morphology() const override
  {
    const Microstructure microstructure = make_microstructure(parameters.microstructure);
    RveResults<2> results;
    set_first(results, microstructure);
    results.first.fractions =
      area_fractions(microstructure.map, microstructure.phases.size());
    return results.first;
  }

  std::vector<std::string> slips() const override
  {
    return slips_of(parameters.microstructure);
  }

  RveResults<2> compute(RunContext &context) override
  {
    if (!division.reason.empty())
      context.log(division.reason);
    return division.divided ? compute_divided_members(parameters, context)
                            : compute_members(parameters, context);
  }

  std::string advice(const NotConverged &failure) const override
  {
    if (failure.reason == NotConverged::Reason::not_finite)
      return "check the moduli of Phases and Grid/Size, which are in Pa and m: forces or "
             "displacements are beyond the range of numbers";
    const auto &edges = parameters.microstructure.grid.spacing;
    const std::string more =
      causes(failure, std::max(edges[0], edges[1]) / std::min(edges[0], edges[1]));
    if (!division.divided && parameters.solver == StaticSolverKind::multigrid)
      return more;
    return std::string("set Homogenization/Solver = multigrid") +
           (division.divided ? ", which takes more memory" : "") +
           (more.empty() ? "" : "; " + more);
  }

private:
  const Division division; ///< of the rows
  const double bytes;      ///< that ranks on this machine need
};
} // namespace

std::unique_ptr<Analysis> make_grid_analysis(const RveParameters &parameters,
                                             const std::string &digest)
{
  return std::make_unique<GridAnalysis>(parameters, digest);
}
} // namespace mesoslip
