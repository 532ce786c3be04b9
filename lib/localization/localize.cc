#include "localization/localize.h"

#include "base/errors.h"
#include "localization/localization_input.h"
#include "localization/stress_map.h"
#include "parameters/parameters.h"

#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
/** Largest entry of <L> - I that goes without a warning. */
constexpr double largest_defect = 1e-6;

std::vector<VoigtMatrix<2>> stiffnesses(const RveFile &rve)
{
  std::vector<VoigtMatrix<2>> result;
  for (const Phase<2> &phase : rve.phases())
    result.push_back(phase.stiffness);
  return result;
}

/** sigma = M eps for [k][3] strains. */
std::vector<double> stresses(const VoigtMatrix<2> &M, const std::vector<double> &strain)
{
  std::vector<double> stress(strain.size());
  for (std::size_t k = 0; k < strain.size(); k += 3)
    Eigen::Map<VoigtVector<2>>(stress.data() + k) =
      M * Eigen::Map<const VoigtVector<2>>(strain.data() + k);
  return stress;
}

/** The entries of a series in a window. */
ProbeSeries cut(const ProbeSeries &series, const TimeWindow &window)
{
  const IndexRange range = entries_in(series.time, window);
  const auto first       = static_cast<std::ptrdiff_t>(range.first);
  const auto last        = first + static_cast<std::ptrdiff_t>(range.count);
  return {{series.time.begin() + first, series.time.begin() + last},
          {series.values.begin() + 3 * first, series.values.begin() + 3 * last}};
}

/** One localization, from the files to the result. */
class Localizer
{
public:
  Localizer(const LocalizationParameters &p, const LocalizationMonitor &m)
    : parameters(p)
    , monitor(m)
    , input(p)
    , probes(plan_probes(p, input))
    , phase_stiffness(stiffnesses(input.rve))
    , map(make_map())
  {
    for (const std::string &warning : input.warnings)
      if (monitor.warn)
        monitor.warn(warning);
    for (const std::string &note : input.notes)
      if (monitor.log)
        monitor.log(note);
    result.differences = input.differences;
    result.grid        = input.rve.grid();
    result.dofs        = 2 * input.homogeneous.grid().n_nodes();
    for (const Phase<2> &phase : input.rve.phases())
      result.phase_names.push_back(phase.name);
    result.digests = {input.rve.digest(), input.homogeneous.digest(),
                      input.direct ? input.direct->digest() : ""};
  }

  LocalizationResult run()
  {
    const bool from_snapshots = parameters.fields.any() || !followed_cells().empty();
    snapshot_window           = from_snapshots ? input.snapshot_window() : input.window;
    if (input.direct)
      pass_direct();
    pass_homogeneous();
    const auto scope = optional_scope(monitor.timer, "Probes and errors");
    if (parameters.local_strain)
      add_variant("local strain", local_fields);
    if (parameters.mean_strain)
      add_variant("mean strain", mean_fields);
    tell_sampling();
    return std::move(result);
  }

private:
  StressMap make_map()
  {
    const auto L        = input.rve.concentration(parameters.concentration);
    const double defect = mean_defect(L);
    if (!(defect <= largest_defect))
      input.warnings.push_back(
        input.rve.path() + ": the mean of the concentration tensors " +
        parameters.concentration + " differs from the identity by " + to_text(defect) +
        "; rve_homogenization should be run with a smaller tolerance");
    return StressMap(input.rve.grid(), input.phase_id, phase_stiffness,
                     input.out_of_plane_ratio, L);
  }

  /** Cells of the probes that are followed through the snapshots. */
  std::vector<CellIndex> followed_cells() const
  {
    std::vector<CellIndex> cells;
    for (const PlannedProbe &probe : probes)
      if (!probe.recorded)
        cells.push_back(probe.cell);
    return cells;
  }

  SnapshotHistories pass(const RunFile &run,
                         const std::string &role,
                         const SnapshotWork &work,
                         std::size_t &n_snapshots)
  {
    const IndexRange range = snapshots_in(run, snapshot_window);
    n_snapshots            = range.count;
    if (monitor.start)
      monitor.start("snapshots of the " + role, range.count);
    auto passed =
      pass_snapshots(run, range, result.grid, work, monitor.update, monitor.timer);
    if (monitor.log)
      {
        std::ostringstream line;
        line << range.count << " snapshots of the " << role << ", " << passed.time.front()
             << " to " << passed.time.back() << " s";
        monitor.log(line.str());
      }
    return passed;
  }

  void pass_direct()
  {
    const StressMap identity(result.grid, input.phase_id, phase_stiffness,
                             input.out_of_plane_ratio, {});
    StressStatistics statistics(identity, parameters.fields);
    SnapshotWork work;
    work.local = parameters.fields.any() ? &statistics : nullptr;
    work.cells = followed_cells();
    if (!work.any())
      return;
    direct_histories = pass(*input.direct, "direct run", work, result.n_direct_snapshots);
    if (work.local != nullptr)
      result.direct = statistics.fields();
  }

  void pass_homogeneous()
  {
    const bool fields = parameters.fields.any();
    StressStatistics local(map, parameters.fields), uniform(map, parameters.fields);
    SnapshotWork work;
    work.local        = fields && parameters.local_strain ? &local : nullptr;
    work.uniform      = fields && parameters.mean_strain ? &uniform : nullptr;
    work.mean_history = parameters.mean_strain && !probes.empty();
    if (parameters.local_strain)
      work.cells = followed_cells();
    if (!work.any())
      return;
    histories = pass(input.homogeneous, "homogeneous run", work, result.n_snapshots);
    note_times(histories.time);
    if (work.local != nullptr)
      local_fields = local.fields();
    if (work.uniform != nullptr)
      mean_fields = uniform.fields();
  }

  /** Widens the window of the result, which is empty at first. */
  void note_times(const std::vector<double> &times)
  {
    if (times.empty())
      return;
    const bool first = !std::isfinite(result.window.begin);
    result.window.begin =
      first ? times.front() : std::min(result.window.begin, times.front());
    result.window.end = first ? times.back() : std::max(result.window.end, times.back());
  }

  /** Macroscopic strain of probe @p p; @p followed is its number among the followed. */
  ProbeSeries macroscopic(const std::string &variant,
                          const PlannedProbe &probe,
                          const std::size_t followed) const
  {
    if (variant == "mean strain")
      return {histories.time, histories.mean};
    if (!probe.recorded)
      return {histories.time, histories.cells[followed]};
    return input.homogeneous.probe(probe.name, "strain", input.window);
  }

  ProbeSeries direct_stress(const PlannedProbe &probe, const std::size_t followed) const
  {
    if (!input.direct || (probe.recorded && probe.direct_name.empty()))
      return {};
    if (probe.recorded)
      return input.direct->probe(probe.direct_name, "stress", input.window);
    const std::size_t cell =
      probe.cell[0] + std::size_t(probe.cell[1]) * result.grid.cells[0];
    return {direct_histories.time, stresses(phase_stiffness[input.phase_id[cell]],
                                            direct_histories.cells[followed])};
  }

  /** Cuts both to the time they share; without any, drops the direct one. */
  void
  restrict_to_common(ProbeSeries &series, ProbeSeries &direct, const std::string &name)
  {
    const TimeWindow common =
      TimeWindow{series.time.front(), series.time.back()}.intersection(
        {direct.time.front(), direct.time.back()});
    ProbeSeries ours = cut(series, common), theirs = cut(direct, common);
    const bool shared = !ours.time.empty() && !theirs.time.empty();
    if (!shared && monitor.warn)
      monitor.warn("the series of the probe " + name +
                   " in the two runs have no time in common: no comparison");
    if (shared)
      series = std::move(ours);
    direct = shared ? std::move(theirs) : ProbeSeries();
  }

  ProbeResult evaluate(const PlannedProbe &probe, ProbeSeries series, ProbeSeries direct)
  {
    ProbeResult r;
    r.name     = probe.name;
    r.position = probe.position;
    r.cell     = probe.cell;
    r.phase = input.phase_id[r.cell[0] + std::size_t(r.cell[1]) * result.grid.cells[0]];
    r.phase_name = input.rve.phases()[r.phase].name;
    if (series.time.empty())
      throw UserError(input.homogeneous.path() + ": the probe " + r.name +
                      " has no sample between " + to_text(input.window.begin) + " and " +
                      to_text(input.window.end) + " s; change Window/From and To");
    // Two static states are compared whatever their times.
    if (!direct.time.empty() && (series.time.size() > 1 || direct.time.size() > 1))
      restrict_to_common(series, direct, r.name);
    r.stress = stresses(map.matrix(r.cell[0], r.cell[1]), series.values);
    if (!direct.time.empty())
      r.direct_stress = resample(direct, series.time);
    r.statistics = compare_series(r.stress, direct.values, r.direct_stress);
    r.time       = std::move(series.time);
    note_times(r.time);
    return r;
  }

  void add_variant(const std::string &name, StressFields &fields)
  {
    VariantResult variant;
    variant.name         = name;
    std::size_t followed = 0;
    for (const PlannedProbe &probe : probes)
      {
        variant.probes.push_back(evaluate(probe, macroscopic(name, probe, followed),
                                          direct_stress(probe, followed)));
        followed += probe.recorded ? 0 : 1;
      }
    if (result.direct.n_samples > 0)
      {
        variant.difference = difference(fields, result.direct);
        variant.errors     = field_errors(
              fields, result.direct,
              comparison_regions(result.grid, input.phase_id, result.phase_names,
                                 parameters.surface_depth, parameters.edge_distance));
      }
    variant.fields = std::move(fields);
    result.variants.push_back(std::move(variant));
  }

  /** Probes and fields are sampled differently: how far apart are their means? */
  void tell_sampling() const
  {
    const VariantResult &variant = result.variants.front();
    double largest               = 0.;
    std::size_t samples          = 0;
    for (std::size_t k = 0; k < probes.size() && !variant.fields.mean_stress.empty(); ++k)
      if (probes[k].recorded && variant.name == "local strain")
        {
          const ProbeResult &probe = variant.probes[k];
          const std::size_t cell =
            probe.cell[0] + std::size_t(probe.cell[1]) * result.grid.cells[0];
          const double of_field = variant.fields.mean_stress[3 * cell + 1];
          largest =
            std::max(largest, std::fabs(probe.statistics[1].mean / of_field - 1.));
          samples = probe.time.size();
        }
    std::ostringstream line;
    line.precision(3);
    line << "Mean sigma_yy of a probe (" << samples
         << " samples at a point) and of its cell "
         << "in the fields (" << result.n_snapshots << " snapshots) differ by up to "
         << 100. * largest << " %";
    if (samples > 0 && monitor.log)
      monitor.log(line.str());
  }

  const LocalizationParameters &parameters;
  const LocalizationMonitor &monitor;
  LocalizationInput input;
  const std::vector<PlannedProbe> probes;
  const std::vector<VoigtMatrix<2>> phase_stiffness;
  const StressMap map;
  TimeWindow snapshot_window; ///< that of both runs
  SnapshotHistories histories, direct_histories;
  StressFields local_fields, mean_fields;
  LocalizationResult result;
};
} // namespace

LocalizationResult localize(const LocalizationParameters &parameters,
                            const LocalizationMonitor &monitor)
{
  auto scope = optional_scope(monitor.timer, "Input");
  Localizer localizer(parameters, monitor);
  scope.reset();
  if (monitor.begin)
    monitor.begin();
  return localizer.run();
}

std::string describe_localization(const LocalizationParameters &parameters)
{
  LocalizationInput input(parameters);
  const auto probes = plan_probes(parameters, input);
  std::ostringstream text;
  const auto tell = [&](const RunFile &run, const char *role) {
    text << role << ": " << run.grid().cells[0] << " x " << run.grid().cells[1]
         << " cells";
    if (run.has_snapshots())
      text << ", " << snapshots_in(run, input.snapshot_window()).count << " snapshots";
    text << '\n';
  };
  tell(input.homogeneous, "Homogeneous run");
  if (input.direct)
    tell(*input.direct, "Direct run");
  const double numbers =
    9. + 10. * (input.direct ? 2. : 1.) + 7. * (parameters.local_strain ? 1. : 0.) +
    7. * (parameters.mean_strain ? 1. : 0.) + 21. * (input.direct ? 3. : 1.);
  text << input.rve.grid().n_cells() << " cells of the RVE, " << probes.size()
       << " probes, about "
       << std::ceil(numbers * 8e-6 * static_cast<double>(input.rve.grid().n_cells())) +
            128.
       << " MB of memory\n";
  for (const std::string &warning : input.warnings)
    text << "warning: " << warning << '\n';
  return text.str();
}
} // namespace mesoslip
