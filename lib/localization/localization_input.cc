#include "localization/localization_input.h"

#include "base/errors.h"
#include "grid/uniform_grid.h"
#include "localization/comparison.h"
#include "material/engineering_constants.h"
#include "material/plausibility.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <cmath>
#include <ostream>

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

/** What looks like another unit. */
std::vector<std::string> slips(const LocalizationParameters &parameters,
                               const UniformGrid<2> &grid)
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
  if (!parameters.direct_run.empty())
    {
      add("Surface depth", parameters.surface_depth, grid.extent(1));
      add("Edge distance", parameters.edge_distance,
          std::max(grid.extent(0), grid.extent(1)));
    }
  return implausible(ranges);
}

RunSource source_of(const DynamicsFile &run)
{
  return {run.path(), run.conditions};
}

RunSnapshots snapshots_of(const DynamicsFile &run)
{
  return {run.path(), run.snapshot_times()};
}

CellIndex cell_at(const UniformGrid<2> &grid, const PlannedProbe &probe)
{
  if (probe.position.size() != 2)
    throw UserError("Probes/" + probe.name + "/Position has " +
                    std::to_string(probe.position.size()) +
                    " numbers, but the body has two dimensions; give x and y");
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
std::string find_direct(const DynamicsFile &direct,
                        const PlannedProbe &probe,
                        const UniformGrid<2> &grid)
{
  auto names = direct.probes();
  std::stable_partition(names.begin(), names.end(),
                        [&](const std::string &name) { return name == probe.name; });
  const auto found =
    std::find_if(names.begin(), names.end(), [&](const std::string &name) {
      const auto position = direct.probe_position(name);
      return std::fabs(position[0] - probe.position[0]) <= 1e-9 * grid.extent(0) &&
             std::fabs(position[1] - probe.position[1]) <= 1e-9 * grid.extent(1);
    });
  return found != names.end() ? *found : std::string();
}
} // namespace

template <int dim>
std::vector<double> out_of_plane_ratios(const LocalizationParameters &parameters,
                                        const RveFile<dim> &rve)
{
  const std::size_t n        = rve.phases.size();
  std::vector<double> ratios = parameters.out_of_plane_ratio;
  if (ratios.size() == 1)
    ratios.assign(n, ratios[0]);
  if (ratios.empty())
    for (const Phase<dim> &phase : rve.phases)
      ratios.push_back(closest_isotropic<dim>(phase.stiffness).poisson_ratio);
  if (ratios.size() != n)
    throw UserError("Localization/Out-of-plane ratio: " + std::to_string(ratios.size()) +
                    " numbers found, but " + rve.path() + " has " + std::to_string(n) +
                    " phases; give one for each, or leave it empty");
  return ratios;
}

template std::vector<double> out_of_plane_ratios(const LocalizationParameters &,
                                                 const RveFile<2> &);
template std::vector<double> out_of_plane_ratios(const LocalizationParameters &,
                                                 const RveFile<3> &);

LocalizationInput::LocalizationInput(const LocalizationParameters &p)
  : parameters(p)
  , rve(p.rve_file)
  , homogeneous(DynamicsFile::open(p.homogeneous_run,
                                   "the homogeneous run; run contact_dynamics first"))
  , phase_id(rve.phase_id())
  , out_of_plane_ratio(out_of_plane_ratios(p, rve))
{
  if (!rve.change_note().empty())
    warnings.push_back(rve.change_note());
  check_run(homogeneous, "homogeneous run");
  const auto phases = homogeneous.phase_id();
  if (std::any_of(phases.begin(), phases.end(),
                  [&](const std::uint8_t phase) { return phase != phases[0]; }))
    throw UserError("the homogeneous run " + homogeneous.path() +
                    " is one of a heterogeneous body, whose strains are local already; "
                    "name a run with Body/Material = homogeneous");
  if (!p.direct_run.empty())
    check_direct();
  choose_window();
  for (const std::string &slip : slips(p, rve.grid))
    warnings.push_back(slip);
  plan_probes();
  choose_snapshots();
  concentration = rve.concentration(p.concentration);
}

void LocalizationInput::check_run(const DynamicsFile &run, const std::string &role)
{
  if (!run.change_note().empty())
    warnings.push_back(run.change_note());
  for (unsigned int d = 0; d < 2; ++d)
    {
      const double length = rve.grid.extent(d);
      const double shift  = run.grid.origin[d] - rve.grid.origin[d];
      if (!(std::fabs(run.grid.extent(d) - length) <= 1e-9 * length) ||
          !(std::fabs(shift) <= 1e-9 * length))
        throw UserError("the " + role + " " + run.path() + " covers " +
                        box_text(run.grid) + ", but " + rve.path() + " covers " +
                        box_text(rve.grid) + "; run contact_dynamics with this RVE file");
    }
  const std::string used = run.rve_digest();
  if (!used.empty() && used != rve.digest)
    warnings.push_back("the " + role + " " + run.path() +
                       " took its material from an RVE file with the digest " + used +
                       ", but " + rve.path() + " has " + rve.digest);
}

void LocalizationInput::check_direct()
{
  direct.emplace(DynamicsFile::open(parameters.direct_run,
                                    "the direct run; run contact_dynamics first"));
  check_run(*direct, "direct run");
  const std::string the_run  = "the direct run " + direct->path();
  const UniformGrid<2> &fine = direct->grid, &coarse = rve.grid;
  const unsigned int rx = fine.cells[0] / coarse.cells[0],
                     ry = fine.cells[1] / coarse.cells[1];
  if (fine.cells[0] != rx * coarse.cells[0] || fine.cells[1] != ry * coarse.cells[1])
    throw UserError(the_run + " has " + numbers_text(fine.cells[0], fine.cells[1]) +
                    " cells, no whole multiple of the " +
                    numbers_text(coarse.cells[0], coarse.cells[1]) + " of " + rve.path() +
                    "; run contact_dynamics with the cells of the RVE or a multiple");
  const auto id = direct->phase_id();
  if (id.empty() && rve.phases.size() > 1)
    warnings.push_back(the_run + " stores no phases: is it of the heterogeneous body?");
  for (std::size_t k = 0; k < id.size(); ++k)
    {
      const std::size_t i = k % fine.cells[0], j = k / fine.cells[0];
      if (id[k] != phase_id[j / ry * coarse.cells[0] + i / rx])
        throw UserError(the_run + " has another morphology than " + rve.path() +
                        ": its cell (" + std::to_string(i) + ", " + std::to_string(j) +
                        ") is of phase " + std::to_string(id[k]) +
                        "; run contact_dynamics with this RVE file");
    }
  differences = compare_conditions(source_of(homogeneous), source_of(*direct),
                                   parameters.allow_different_loads, notes, warnings);
}

void LocalizationInput::choose_window()
{
  if (!std::isnan(parameters.to))
    window.end = parameters.to;
  window.begin =
    std::isnan(parameters.from) ? steady_from(source_of(homogeneous)) : parameters.from;
  if (std::isnan(parameters.from) && direct)
    window.begin = std::max(window.begin, steady_from(source_of(*direct)));
}

void LocalizationInput::choose_snapshots()
{
  const bool followed = !followed_cells().empty();
  if (!parameters.fields.any() && !followed &&
      !(parameters.mean_strain && !probes.empty()))
    return;
  const bool both           = direct && (parameters.fields.any() || followed);
  const RunSnapshots ours   = snapshots_of(homogeneous);
  const RunSnapshots theirs = both ? snapshots_of(*direct) : RunSnapshots();
  const TimeWindow shared   = both ? shared_snapshots(ours, theirs, window) : window;
  snapshots                 = snapshots_in(ours, shared);
  if (both)
    direct_snapshots = snapshots_in(theirs, shared);
}

std::vector<CellIndex> LocalizationInput::followed_cells() const
{
  std::vector<CellIndex> cells;
  for (const PlannedProbe &probe : probes)
    if (!probe.recorded)
      cells.push_back({{probe.cell[0], probe.cell[1]}});
  return cells;
}

void LocalizationInput::plan_probes()
{
  const auto available = homogeneous.probes();
  for (const std::string &name :
       parameters.all_run_probes() ? available : parameters.run_probes)
    {
      if (std::find(available.begin(), available.end(), name) == available.end())
        throw UserError("Probes/Of the run names '" + name + "', but the probes of " +
                        homogeneous.path() + " are: " + to_text(available) +
                        "; give its position under Probes/Further");
      const auto position = homogeneous.probe_position(name);
      probes.push_back({{name, {position[0], position[1]}}, true, {}, {}});
    }
  for (const LocalizedProbe &probe : parameters.further_probes)
    {
      for (const PlannedProbe &other : probes)
        if (other.name == probe.name)
          throw UserError("Probes/Further: the homogeneous run has a probe " +
                          probe.name + ", too; choose another name");
      probes.push_back({probe, false, {}, {}});
    }
  for (PlannedProbe &probe : probes)
    complete(probe);
}

/** Finds the cell of a probe and reads what was recorded of it. */
void LocalizationInput::complete(PlannedProbe &probe)
{
  const CellIndex cell = cell_at(rve.grid, probe);
  probe.cell           = {cell[0], cell[1]};
  probe.phase          = phase_id[number_of_cell(probe)];
  probe.phase_name     = rve.phases[probe.phase].name;
  if (!probe.recorded)
    return;
  if (parameters.local_strain)
    {
      probe.strain = homogeneous.probe(probe.name, "strain", window);
      if (probe.strain.time.empty())
        throw UserError(homogeneous.path() + ": the probe " + probe.name +
                        " has no sample " + window_text(window) +
                        "; change Window/From and To");
    }
  if (!direct)
    return;
  const std::string name = find_direct(*direct, probe, rve.grid);
  if (name.empty())
    warnings.push_back("the direct run " + direct->path() +
                       " has no probe at the place of " + probe.name);
  else
    probe.direct = direct->probe(name, "stress", window);
}

ResourceNeed LocalizationInput::need() const
{
  const bool with_direct = direct.has_value();
  LocalizationExtent extent;
  extent.n_cells      = static_cast<double>(rve.grid.n_cells());
  extent.n_field_sets = with_direct ? 1. : 0.;
  for (const bool of_place : {true, false})
    if (of_place ? parameters.local_strain : parameters.mean_strain)
      {
        extent.n_field_sets += with_direct ? 2. : 1.;
        for (const PlannedProbe &probe : probes)
          {
            const bool recorded = probe.recorded && of_place,
                       compared =
                         probe.recorded ? !probe.direct.time.empty() : with_direct;
            extent.n_series += 1.;
            extent.n_numbers +=
              (compared ? 7. : 4.) *
              static_cast<double>(recorded ? probe.strain.time.size() : snapshots.count);
          }
      }
  return need_of<2>(extent, parameters.fields);
}

void LocalizationInput::describe(std::ostream &out) const
{
  const auto tell = [&](const DynamicsFile &run, const char *role,
                        const IndexRange &used) {
    out << role << ": " << numbers_text(run.grid.cells[0], run.grid.cells[1]) << " cells";
    if (run.has_snapshots())
      out << ", " << used.count << " snapshots";
    out << '\n';
  };
  tell(homogeneous, "Homogeneous run", snapshots);
  if (direct)
    tell(*direct, "Direct run", direct_snapshots);
  // Map, sums and fields of each variant and of the direct run.
  const double n_variants =
    (parameters.local_strain ? 1. : 0.) + (parameters.mean_strain ? 1. : 0.);
  const double numbers = 9. + 7. * n_variants + (direct ? 20. + 63. : 10. + 21.);
  const double n_cells = static_cast<double>(rve.grid.n_cells());
  out << n_cells << " cells of the RVE, " << probes.size() << " probes, about "
      << std::ceil(numbers * 8e-6 * n_cells) + 128. << " MB of memory\n"
      << bytes_text(need().bytes) << " on the disk\n";
  for (const std::string &warning : warnings)
    out << "warning: " << warning << '\n';
}
} // namespace mesoslip
