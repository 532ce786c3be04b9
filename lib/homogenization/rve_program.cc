#include "homogenization/rve_program.h"

#include "base/digest.h"
#include "base/errors.h"
#include "base/exchange.h"
#include "base/version.h"
#include "exchange/rve_file.h"
#include "grid/uniform_grid.h"
#include "homogenization/ensemble.h"
#include "material/engineering_constants.h"
#include "material/plausibility.h"
#include "parameters/keys.h"
#include "program/run_context.h"

#include <filesystem>
#include <ostream>

namespace mesoslip
{
namespace
{
// To be raised when the same parameters come to have other results: an rve.h5 of before
// is then made again. 2: ensembles on several ranks had been wrong. 3: cells coarser than
// the pixels of an image took the pixel at their centre, and gamma changed a PNG.
constexpr double revision = 3.;

// What determines rve.h5: the computation, the parameters that matter and the content of
// the input file.
std::string inputs_digest(const Keys &keys, const RveParameters &parameters)
{
  Digest digest;
  digest.add(version).add(revision);
  digest.add(canonical_parameters(keys, {"Output folder", "Homogenization/Reuse"}));
  if (!parameters.microstructure.file.empty())
    digest.add_file(parameters.microstructure.file);
  return digest.hex();
}

// As this program has written it, with this digest.
bool is_up_to_date(const std::string &path, const std::string &digest)
{
  if (!std::filesystem::exists(path))
    return false;
  try
    {
      const RveFile file(path);
      return file.digest == digest && file.change_note().empty();
    }
  catch (const UserError &)
    {
      return false; // Something else of that name, or damaged: it is made again.
    }
}

EnsembleMember compute_member(const RveParameters &parameters,
                              const Microstructure &microstructure,
                              const MPI_Comm communicator,
                              const bool keep_concentration,
                              const LoadCaseProgress &progress,
                              Timer &timer)
{
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  const UniformMaterial material = make_material(microstructure);
  EnsembleMember member;
  member.seed      = parameters.microstructure.placement.seed;
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
      solution.displacement = {};
    }
  return member;
}

// A single member shares its load cases among the ranks; several are dealt out whole.
RveResults compute(const RveParameters &parameters, RunContext &context)
{
  RveResults results;
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
      const auto scope   = context.timer().scope("Load cases");
      results.members[m] = compute_member(
        own, microstructure, n > 1 ? MPI_COMM_SELF : context.communicator(),
        parameters.write_concentration && m == 0,
        [&](const unsigned int done, const unsigned int) {
          context.progress().update(m * n_cases + done);
        },
        context.timer());
      if (m == 0)
        results.microstructure = microstructure;
    }
  context.progress().finish();
  for (unsigned int m = 0; n > 1 && m < n; ++m)
    bring_object_to_root(context.communicator(), results.members[m],
                         static_cast<int>(m) % context.n_ranks());
  if (n > 1)
    for (const std::string &warning : morphology_warnings(results.members))
      context.warn(warning);
  return results;
}

/** Bytes of rve.h5: the phases, and the concentration tensors of the first morphology. */
ResourceNeed rve_file_size(const RveParameters &parameters)
{
  const double n_cells = static_cast<double>(parameters.microstructure.grid.n_cells());
  const double tensors = parameters.write_concentration
                           ? 72. * static_cast<double>(parameters.conditions.size())
                           : 0.;
  return {n_cells * (1. + tensors),
          "set Homogenization/Write concentration = false, or reduce Grid/Cells"};
}

// Libraries, solver, displacements of all load cases, concentration tensors; as measured.
unsigned long estimated_megabytes(const RveParameters &parameters)
{
  const double n_cells = parameters.microstructure.grid.n_cells();
  const double n       = parameters.conditions.size();
  const double solver  = parameters.solver == StaticSolverKind::multigrid ? 330.
                         : parameters.solver == StaticSolverKind::jacobi  ? 100.
                                                                          : 4000.;
  const double fields  = n * (48. + (parameters.write_concentration ? 72. : 0.));
  return 150 + static_cast<unsigned long>(n_cells * (solver + fields) * 1e-6);
}

// What looks like another unit.
std::vector<std::string> slips(const MicrostructureParameters &p)
{
  const std::vector<Phase<2>> phases = make_phases(p.phases);
  std::vector<PlausibleRange> ranges = plausible_phases(phases);
  for (unsigned int d = 0; d < 2; ++d)
    ranges.push_back(
      plausible_length("Grid/Size along " + std::string(1, "xy"[d]), p.grid.extent(d)));
  std::vector<std::string> sentences = implausible(ranges);
  if (const std::string stiffness = stiffness_warning(phases); !stiffness.empty())
    sentences.push_back(stiffness);
  return sentences;
}

/** What helps a solve that failed. */
std::string advice(const NotConverged::Reason reason, const StaticSolverKind solver)
{
  if (reason == NotConverged::Reason::not_finite)
    return "check the moduli of Phases and Grid/Size, which are in Pa and m: forces or "
           "displacements are beyond the range of numbers";
  if (solver != StaticSolverKind::multigrid)
    return "set Homogenization/Solver = multigrid";
  return reason == NotConverged::Reason::broke_down
           ? "set Homogenization/Solver = jacobi"
           : "loosen Homogenization/Tolerance or set Homogenization/Solver = jacobi";
}

class RveHomogenization : public Analysis
{
public:
  explicit RveHomogenization(Keys &keys)
  {
    parameters.bind(keys);
    parameters.check();
    digest = inputs_digest(keys, parameters);
    require_memory({1e6 * static_cast<double>(estimated_megabytes(parameters)),
                    "reduce Grid/Cells or choose Homogenization/Solver = jacobi"});
  }

  ResourceNeed need() const override
  {
    return rve_file_size(parameters);
  }

  void describe(std::ostream &out) const override;
  void run(RunContext &context) override;

private:
  RveParameters parameters;
  std::string digest;
};

void RveHomogenization::describe(std::ostream &out) const
{
  const UniformGrid<2> grid = parameters.microstructure.grid;
  out << size_text(grid) << ", " << 2 * grid.n_nodes() << " degrees of freedom\n"
      << 3 * parameters.conditions.size() * parameters.n_members << " load cases, about "
      << estimated_megabytes(parameters) << " MB\n";
  const Microstructure microstructure = make_microstructure(parameters.microstructure);
  for (const std::string &line : microstructure.description)
    out << line << '\n';
  for (const auto &warnings : {microstructure.warnings, slips(parameters.microstructure)})
    for (const std::string &warning : warnings)
      out << "Warning: " << warning << '\n';
}

void RveHomogenization::run(RunContext &context)
{
  bool reuse =
    context.root() && parameters.reuse && is_up_to_date(context.file("rve.h5"), digest);
  broadcast_object(context.communicator(), reuse);
  if (reuse)
    {
      context.log("rve.h5 is up to date: nothing that determines it has changed");
      if (context.root() && restore_rve_summary(context))
        log_stiffness(context);
      return;
    }

  context.remove_results({"rve.h5", "rve.xdmf", "stiffness.csv",
                          "engineering_constants.csv", "phase_means.csv", "ensemble.csv",
                          "rectangles.csv"});
  for (const std::string &slip : slips(parameters.microstructure))
    context.warn(slip);
  RveResults results;
  try
    {
      results = compute(parameters, context);
    }
  catch (const NotConverged &e)
    {
      throw NumericalFailure(std::string(e.what()) + "; " +
                             advice(e.reason, parameters.solver));
    }
  if (!context.root())
    return;
  for (const std::string &warning : result_warnings(results.members, parameters))
    context.warn(warning);
  const auto scope  = context.timer().scope("Output");
  results.effective = mean_stiffness(results.members, effective_conditions(parameters));
  if (!parameters.effective_full)
    results.effective = orthotropic_part(results.effective);
  write_rve_tables(parameters, results, context);
  write_rve_summary(parameters, results, context);
  write_rve_file(parameters, results, digest, context);
}
} // namespace

Application rve_homogenization_program()
{
  return {"rve_homogenization",
          "Effective stiffness and concentration tensors of a representative volume.",
          [](Keys &keys) { RveParameters().bind(keys); },
          [](Keys &keys) { return std::make_unique<RveHomogenization>(keys); }};
}
} // namespace mesoslip
