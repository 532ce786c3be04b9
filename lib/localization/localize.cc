#include "localization/localization_program.h"

#include "base/timer.h"
#include "localization/mean_concentration.h"
#include "parameters/parameters.h"

#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
std::vector<VoigtMatrix<2>> stiffnesses(const RveFile<2> &rve)
{
  std::vector<VoigtMatrix<2>> result;
  for (const Phase<2> &phase : rve.phases)
    result.push_back(phase.stiffness);
  return result;
}

/** Over all cells of [..][3][3] tensors. */
VoigtMatrix<2> mean_concentration(const std::vector<double> &concentration)
{
  VoigtMatrix<2> sum = VoigtMatrix<2>::Zero();
  for (std::size_t k = 0; k < concentration.size(); k += 9)
    sum += Eigen::Map<const VoigtMatrix<2>>(concentration.data() + k);
  return sum * (9. / static_cast<double>(concentration.size()));
}

/** C_phase L of all cells, and a warning if L is not what it should be. */
StressMap make_map(LocalizationInput &input)
{
  const std::vector<double> L = std::move(input.concentration);
  const std::string warning   = concentration_warning<2>(
    input.rve.path(), input.parameters.concentration, mean_concentration(L));
  if (!warning.empty())
    input.warnings.push_back(warning);
  return {input.rve.grid, input.phase_id, stiffnesses(input.rve),
          input.out_of_plane_ratio, L};
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
  Localizer(LocalizationInput &input, const LocalizationMonitor &monitor)
    : input(input)
    , parameters(input.parameters)
    , monitor(monitor)
    , map(make_map(input))
  {
  }

  LocalizationResult run()
  {
    result.fields      = parameters.fields;
    result.is_compared = input.direct.has_value();
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
  SnapshotHistories pass(const DynamicsFile &run,
                         const std::string &role,
                         const SnapshotWork &work,
                         const IndexRange &range)
  {
    if (!work.any())
      return {};
    if (monitor.start)
      monitor.start("snapshots of the " + role, range.count);
    auto passed = pass_snapshots(
      run, range, input.rve.grid, work,
      [this](const std::size_t done) {
        if (monitor.update)
          monitor.update(done);
      },
      monitor.timer);
    std::ostringstream line;
    line << range.count << " snapshots of the " << role << ", " << passed.time.front()
         << " to " << passed.time.back() << " s";
    input.notes.push_back(line.str());
    return passed;
  }

  void pass_direct()
  {
    const StressMap identity(input.rve.grid, input.phase_id, stiffnesses(input.rve),
                             input.out_of_plane_ratio, {});
    StressStatistics statistics(identity, parameters.fields);
    SnapshotWork work;
    work.local       = parameters.fields.any() ? &statistics : nullptr;
    work.cells       = input.followed_cells();
    direct_histories = pass(*input.direct, "direct run", work, input.direct_snapshots);
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
    work.mean_history = parameters.mean_strain && !input.probes.empty();
    if (parameters.local_strain)
      work.cells = input.followed_cells();
    histories = pass(input.homogeneous, "homogeneous run", work, input.snapshots);
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

  /** Macroscopic strain of a probe; @p followed is its number among the followed. */
  ProbeSeries macroscopic(const std::string &variant,
                          const PlannedProbe &probe,
                          const std::size_t followed) const
  {
    if (variant == "mean strain")
      return {histories.time, histories.mean};
    return probe.recorded ? probe.strain
                          : ProbeSeries{histories.time, histories.cells[followed]};
  }

  ProbeSeries direct_stress(const PlannedProbe &probe, const std::size_t followed) const
  {
    if (!input.direct || probe.recorded)
      return probe.direct;
    return {direct_histories.time, stresses(input.rve.phases[probe.phase].stiffness,
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
    if (shared)
      series = std::move(ours);
    else
      input.warnings.push_back("the series of the probe " + name +
                               " in the two runs have no time in common: no comparison");
    direct = shared ? std::move(theirs) : ProbeSeries();
  }

  ProbeResult
  evaluate(const LocalizedProbe &probe, ProbeSeries series, ProbeSeries direct)
  {
    ProbeResult r = {probe, {}};
    // Two static states are compared whatever their times.
    if (!direct.time.empty() && (series.time.size() > 1 || direct.time.size() > 1))
      restrict_to_common(series, direct, probe.name);
    r.stress = stresses(map.matrix(probe.cell[0], probe.cell[1]), series.values);
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
    for (const PlannedProbe &probe : input.probes)
      {
        variant.probes.push_back(evaluate(probe, macroscopic(name, probe, followed),
                                          direct_stress(probe, followed)));
        followed += probe.recorded ? 0 : 1;
      }
    if (input.direct && parameters.fields.any())
      {
        variant.difference = difference(fields, result.direct);
        variant.errors =
          field_errors(2, parameters.fields, fields, result.direct, regions());
      }
    variant.fields = std::move(fields);
    result.variants.push_back(std::move(variant));
  }

  std::vector<CellRegion> regions() const
  {
    const UniformGrid<2> &grid = input.rve.grid;
    std::vector<std::string> names;
    for (const Phase<2> &phase : input.rve.phases)
      names.push_back(phase.name);
    return comparison_regions<2>(centres_of(grid), {grid.extent(0), grid.extent(1)},
                                 input.phase_id, names, parameters.surface_depth,
                                 parameters.edge_distance);
  }

  /** Probes and fields are sampled differently: how far apart are their means? */
  void tell_sampling()
  {
    const VariantResult &variant = result.variants.front();
    double largest               = 0.;
    std::size_t samples          = 0;
    if (variant.name == "local strain" && !variant.fields.mean_stress.empty())
      for (std::size_t k = 0; k < input.probes.size(); ++k)
        if (input.probes[k].recorded)
          {
            const std::size_t cell = input.number_of_cell(input.probes[k]);
            const double of_field  = variant.fields.mean_stress[3 * cell + 1];
            const double of_probe  = variant.probes[k].statistics[1].mean;
            largest = std::max(largest, std::fabs(of_probe / of_field - 1.));
            samples = variant.probes[k].time.size();
          }
    if (samples == 0)
      return;
    std::ostringstream line;
    line.precision(3);
    line << "Mean sigma_yy of a probe (" << samples
         << " samples at a point) and of its cell in the fields ("
         << input.snapshots.count << " snapshots) differ by up to " << 100. * largest
         << " %";
    input.notes.push_back(line.str());
  }

  LocalizationInput &input;
  const LocalizationParameters &parameters;
  const LocalizationMonitor &monitor;
  const StressMap map;
  SnapshotHistories histories, direct_histories;
  StressFields local_fields, mean_fields;
  LocalizationResult result;
};
} // namespace

LocalizationResult localize(LocalizationInput &input, const LocalizationMonitor &monitor)
{
  auto scope = optional_scope(monitor.timer, "Stress map");
  Localizer localizer(input, monitor);
  scope.reset();
  return localizer.run();
}
} // namespace mesoslip
