#include "localization/localization_input.h"

#include "base/errors.h"
#include "material/engineering_constants.h"
#include "material/plausibility.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
std::string box_text(const UniformGrid<2> &grid)
{
  std::string text;
  for (unsigned int d = 0; d < 2; ++d)
    text += (d == 0 ? "[" : " x [") + to_text(grid.origin[d]) + ", " +
            to_text(grid.origin[d] + grid.extent(d)) + "]";
  return text + " m";
}

std::string cells_text(const UniformGrid<2> &grid)
{
  return std::to_string(grid.cells[0]) + " x " + std::to_string(grid.cells[1]);
}

void check_box(const RunFile &run, const std::string &role, const RveFile &rve)
{
  for (unsigned int d = 0; d < 2; ++d)
    {
      const double length = rve.grid().extent(d);
      const double shift  = run.grid().origin[d] - rve.grid().origin[d];
      if (!(std::fabs(run.grid().extent(d) - length) <= 1e-9 * length) ||
          !(std::fabs(shift) <= 1e-9 * length))
        throw UserError("the " + role + " " + run.path() + " covers " +
                        box_text(run.grid()) + ", but " + rve.path() + " covers " +
                        box_text(rve.grid()) +
                        "; run contact_dynamics with this RVE file");
    }
}

void check_digest(const RunFile &run,
                  const std::string &role,
                  const RveFile &rve,
                  std::vector<std::string> &warnings)
{
  const std::string used = run.rve_digest();
  if (!used.empty() && used != rve.digest())
    warnings.push_back("the " + role + " " + run.path() +
                       " took its material from an RVE file with the digest " + used +
                       ", but " + rve.path() + " has " + rve.digest());
}

/** The cell of the RVE's morphology at a cell of a refined grid. */
std::size_t
coarse_cell(const UniformGrid<2> &fine, const UniformGrid<2> &coarse, const std::size_t k)
{
  const std::size_t i = k % fine.cells[0], j = k / fine.cells[0];
  const std::size_t rx = fine.cells[0] / coarse.cells[0];
  const std::size_t ry = fine.cells[1] / coarse.cells[1];
  return j / ry * coarse.cells[0] + i / rx;
}

void check_direct(const RunFile &direct,
                  const RveFile &rve,
                  const std::vector<std::uint8_t> &phase_id,
                  std::vector<std::string> &warnings)
{
  const UniformGrid<2> &fine = direct.grid(), &coarse = rve.grid();
  for (unsigned int d = 0; d < 2; ++d)
    if (fine.cells[d] % coarse.cells[d] != 0)
      throw UserError("the direct run " + direct.path() + " has " + cells_text(fine) +
                      " cells, no whole multiple of the " + cells_text(coarse) + " of " +
                      rve.path() +
                      "; run contact_dynamics with the cells of the RVE or a multiple");
  const auto id = direct.phase_id();
  if (id.empty() && rve.phases().size() > 1)
    warnings.push_back("the direct run " + direct.path() +
                       " stores no phases: is it of the heterogeneous body?");
  for (std::size_t k = 0; k < id.size(); ++k)
    if (id[k] != phase_id[coarse_cell(fine, coarse, k)])
      throw UserError(
        "the direct run " + direct.path() + " has another morphology than " + rve.path() +
        ": its cell (" + std::to_string(k % fine.cells[0]) + ", " +
        std::to_string(k / fine.cells[0]) + ") is of phase " + std::to_string(id[k]) +
        "; run contact_dynamics with this RVE file");
}

std::vector<double> out_of_plane_ratios(const LocalizationParameters &parameters,
                                        const RveFile &rve)
{
  const std::size_t n        = rve.phases().size();
  std::vector<double> ratios = parameters.out_of_plane_ratio;
  if (ratios.size() == 1)
    ratios.assign(n, ratios[0]);
  if (ratios.empty())
    for (const Phase<2> &phase : rve.phases())
      ratios.push_back(closest_isotropic<2>(phase.stiffness).poisson_ratio);
  if (ratios.size() != n)
    throw UserError("Localization/Out-of-plane ratio: " + std::to_string(ratios.size()) +
                    " numbers found, but " + rve.path() + " has " + std::to_string(n) +
                    " phases; give one for each, or leave it empty");
  return ratios;
}

/** What looks like another unit. */
std::vector<std::string> slips(const LocalizationParameters &parameters,
                               const UniformGrid<2> &grid,
                               const bool compared)
{
  std::vector<PlausibleRange> ranges;
  for (const double ratio : parameters.out_of_plane_ratio)
    ranges.push_back({"Localization/Out-of-plane ratio", ratio, "", -1.,
                      "less than any Poisson's ratio, which it is in plane strain", 1.,
                      "more than any Poisson's ratio, which it is in plane strain"});
  const auto add = [&](const char *key, const double length, const double side) {
    ranges.push_back({std::string("Comparison/") + key, length, "m", 0., "", side,
                      "more than the body's " + quantity_text(side, "m") +
                        ", so that no cell is left to be compared apart; is it in m?"});
  };
  if (compared)
    {
      add("Surface depth", parameters.surface_depth, grid.extent(1));
      add("Edge distance", parameters.edge_distance,
          std::max(grid.extent(0), grid.extent(1)));
    }
  return implausible(ranges);
}

TimeWindow choose_window(const LocalizationParameters &parameters,
                         const RunFile &homogeneous,
                         const std::optional<RunFile> &direct)
{
  TimeWindow window;
  if (!std::isnan(parameters.to))
    window.end = parameters.to;
  if (!std::isnan(parameters.from))
    window.begin = parameters.from;
  else
    window.begin = direct ? std::max(steady_from(homogeneous), steady_from(*direct))
                          : steady_from(homogeneous);
  return window;
}

CellIndex cell_at(const UniformGrid<2> &grid, const PlannedProbe &probe)
{
  CellIndex cell = {};
  for (unsigned int d = 0; d < 2; ++d)
    {
      // As contact_dynamics: a point between two cells belongs to the upper one.
      const double s = probe.position[d] / grid.spacing[d] + 1e-9;
      if (!(s >= 0. && s <= grid.cells[d] + 2e-9))
        throw UserError("the probe " + probe.name + " at (" + to_text(probe.position[0]) +
                        ", " + to_text(probe.position[1]) +
                        ") m lies outside the body, which reaches from (0, 0) to (" +
                        to_text(grid.extent(0)) + ", " + to_text(grid.extent(1)) + ") m");
      cell[d] = std::min(static_cast<unsigned int>(s), grid.cells[d] - 1);
    }
  return cell;
}

/** The direct run's probe at the place of @p probe, the one of equal name first. */
std::string
find_direct(const RunFile &direct, const PlannedProbe &probe, const UniformGrid<2> &grid)
{
  const auto there = [&](const std::string &name) {
    const auto position = direct.probe_position(name);
    return std::fabs(position[0] - probe.position[0]) <= 1e-9 * grid.extent(0) &&
           std::fabs(position[1] - probe.position[1]) <= 1e-9 * grid.extent(1);
  };
  const auto names = direct.probes();
  if (std::find(names.begin(), names.end(), probe.name) != names.end() &&
      there(probe.name))
    return probe.name;
  const auto found = std::find_if(names.begin(), names.end(), there);
  return found != names.end() ? *found : std::string();
}
} // namespace

LocalizationInput::LocalizationInput(const LocalizationParameters &parameters)
  : rve(RveFile::open(parameters.rve_file))
  , homogeneous(parameters.homogeneous_run, "homogeneous run")
  , phase_id(rve.phase_id())
  , out_of_plane_ratio(out_of_plane_ratios(parameters, rve))
{
  const auto warn_of_changes = [this](const std::string &note) {
    if (!note.empty())
      warnings.push_back(note);
  };
  warn_of_changes(rve.change_note());
  warn_of_changes(homogeneous.change_note());
  check_box(homogeneous, "homogeneous run", rve);
  check_digest(homogeneous, "homogeneous run", rve, warnings);
  const auto phases = homogeneous.phase_id();
  if (std::any_of(phases.begin(), phases.end(),
                  [&](const std::uint8_t p) { return p != phases[0]; }))
    throw UserError("the homogeneous run " + homogeneous.path() +
                    " is one of a heterogeneous body, whose strains are local already; "
                    "name a run with Body/Material = homogeneous");
  if (!parameters.direct_run.empty())
    {
      direct.emplace(parameters.direct_run, "direct run");
      warn_of_changes(direct->change_note());
      check_box(*direct, "direct run", rve);
      check_digest(*direct, "direct run", rve, warnings);
      check_direct(*direct, rve, phase_id, warnings);
      const RunComparison comparison =
        compare_conditions(homogeneous, *direct, parameters.allow_different_loads);
      differences = comparison.differences;
      notes       = comparison.notes;
      warnings.insert(warnings.end(), comparison.warnings.begin(),
                      comparison.warnings.end());
    }
  window = choose_window(parameters, homogeneous, direct);
  for (const std::string &slip : slips(parameters, rve.grid(), direct.has_value()))
    warnings.push_back(slip);
}

TimeWindow LocalizationInput::snapshot_window() const
{
  return direct && homogeneous.has_snapshots() && direct->has_snapshots()
           ? shared_snapshots(homogeneous, *direct, window)
           : window;
}

std::vector<PlannedProbe> plan_probes(const LocalizationParameters &parameters,
                                      LocalizationInput &input)
{
  const auto available = input.homogeneous.probes();
  std::vector<PlannedProbe> planned;
  for (const std::string &name :
       parameters.all_run_probes() ? available : parameters.run_probes)
    {
      if (std::find(available.begin(), available.end(), name) == available.end())
        throw UserError("Probes/Of the run names '" + name + "', but the probes of " +
                        input.homogeneous.path() + " are: " + to_text(available) +
                        "; give its position under Probes/Further");
      planned.push_back({name, input.homogeneous.probe_position(name), {}, true, ""});
    }
  for (const ProbeRequest &probe : parameters.further_probes)
    {
      for (const PlannedProbe &other : planned)
        if (other.name == probe.name)
          throw UserError("Probes/Further: the homogeneous run has a probe " +
                          probe.name + ", too; choose another name");
      planned.push_back({probe.name, probe.position, {}, false, ""});
    }
  for (PlannedProbe &probe : planned)
    {
      probe.cell = cell_at(input.rve.grid(), probe);
      if (!probe.recorded || !input.direct)
        continue;
      probe.direct_name = find_direct(*input.direct, probe, input.rve.grid());
      if (probe.direct_name.empty())
        input.warnings.push_back("the direct run " + input.direct->path() +
                                 " has no probe at the place of " + probe.name);
    }
  return planned;
}

IndexRange snapshots_in(const RunFile &run, const TimeWindow &window)
{
  const auto times       = run.snapshot_times();
  const IndexRange range = entries_in(times, window);
  if (times.empty())
    throw UserError(run.path() + ": /snapshots is empty; run contact_dynamics until "
                                 "after Snapshots/From");
  if (range.count == 0)
    throw UserError(run.path() + ": no snapshot lies between " + to_text(window.begin) +
                    " and " + to_text(window.end) + " s, its " +
                    std::to_string(times.size()) + " go from " + to_text(times.front()) +
                    " to " + to_text(times.back()) + " s; change Window/From and To");
  return range;
}
} // namespace mesoslip
