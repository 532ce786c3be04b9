#include "localization/probe_series.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
/** sigma = M eps + @p thermal for [k][components] strains. */
template <int dim>
std::vector<double> stresses(const VoigtMatrix<dim> &M,
                             const std::vector<double> &strain,
                             const VoigtVector<dim> &thermal = VoigtVector<dim>::Zero())
{
  std::vector<double> stress(strain.size());
  for (std::size_t k = 0; k < strain.size(); k += n_voigt<dim>)
    Eigen::Map<VoigtVector<dim>>(stress.data() + k) =
      M * Eigen::Map<const VoigtVector<dim>>(strain.data() + k) + thermal;
  return stress;
}

/** The entries of a series in a window. */
ProbeSeries cut(const ProbeSeries &series, const TimeWindow &window)
{
  const IndexRange range = entries_in(series.time, window);
  const auto n           = static_cast<std::ptrdiff_t>(
    series.values.size() / std::max<std::size_t>(series.time.size(), 1));
  const auto first = series.values.begin() + n * static_cast<std::ptrdiff_t>(range.first);
  return {times_of(series.time, range),
          {first, first + n * static_cast<std::ptrdiff_t>(range.count)}};
}

/** The series of all probes, and their comparison. */
template <int dim>
class ProbeEvaluation
{
public:
  ProbeEvaluation(LocalizationInput<dim> &of_root,
                  const ProbeHistories<dim> &given,
                  LocalizationResult &of_all)
    : input(of_root)
    , histories(given)
    , result(of_all)
  {
  }

  void run()
  {
    note_times(input.times);
    for (VariantResult &variant : result.variants)
      {
        std::size_t followed = 0;
        for (std::size_t p = 0; p < input.probes.size(); ++p)
          {
            const PlannedProbe &probe = input.probes[p];
            variant.probes.push_back(evaluate(
              probe, histories.matrices[p], histories.thermal[p],
              macroscopic(variant, probe, followed), direct_stress(probe, followed)));
            followed += probe.recorded ? 0 : 1;
          }
      }
  }

private:
  /** Extends the window of the result (initially empty) by the times of the averaged
   * snapshots, or of the probes if there are no snapshots. */
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
  ProbeSeries macroscopic(const VariantResult &variant,
                          const PlannedProbe &probe,
                          const std::size_t followed) const
  {
    if (variant.name == "mean strain")
      return {input.times, histories.homogeneous.mean};
    return probe.recorded
             ? probe.strain
             : ProbeSeries{input.times, histories.homogeneous.cells[followed]};
  }

  ProbeSeries direct_stress(const PlannedProbe &probe, const std::size_t followed) const
  {
    if (!input.files.direct || probe.recorded)
      return probe.direct;
    return {input.direct_times,
            stresses<dim>(input.files.rve.constituents()[probe.material].stiffness,
                          histories.direct.cells[followed])};
  }

  /** Cuts both series to their common time; drops the direct one if there is none. */
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

  ProbeResult evaluate(const LocalizedProbe &probe,
                       const VoigtMatrix<dim> &matrix,
                       const VoigtVector<dim> &thermal,
                       ProbeSeries series,
                       ProbeSeries direct)
  {
    ProbeResult r = {probe, {}};
    // Two static states are compared regardless of their times.
    if (!direct.time.empty() && (series.time.size() > 1 || direct.time.size() > 1))
      restrict_to_common(series, direct, probe.name);
    r.stress = stresses<dim>(matrix, series.values, thermal);
    if (!direct.time.empty())
      r.direct_stress = resample(direct, series.time);
    r.statistics = compare_series(r.stress, direct.values, r.direct_stress, n_voigt<dim>);
    r.time       = std::move(series.time);
    if (input.times.empty())
      note_times(r.time);
    return r;
  }

  LocalizationInput<dim> &input;
  const ProbeHistories<dim> &histories;
  LocalizationResult &result;
};
} // namespace

template <int dim>
void evaluate_probes(LocalizationInput<dim> &input,
                     const ProbeHistories<dim> &histories,
                     LocalizationResult &result)
{
  ProbeEvaluation<dim>(input, histories, result).run();
}

template <int dim>
void note_sampling(LocalizationInput<dim> &input,
                   const VariantResult &variant,
                   const std::vector<double> &of_field)
{
  constexpr unsigned int normal = dim - 1;
  double largest                = 0.;
  std::size_t samples           = 0;
  for (std::size_t p = 0; p < input.probes.size(); ++p)
    if (input.probes[p].recorded)
      {
        const double of_probe = variant.probes[p].statistics[normal].mean;
        largest               = std::max(largest, std::fabs(of_probe / of_field[p] - 1.));
        samples               = variant.probes[p].time.size();
      }
  if (samples == 0)
    return;
  const std::string component = voigt_names<dim>[normal];
  std::ostringstream line;
  line.precision(3);
  line << "Mean sigma_" << component << " of a probe (" << samples
       << " samples at a point) and of its cell in the fields ("
       << input.plan.snapshots.count << " snapshots) differ by up to " << 100. * largest
       << " %";
  input.notes.push_back(line.str());
}

#define MESOSLIP_INSTANTIATE(dim)                                                      \
  template void evaluate_probes(LocalizationInput<dim> &, const ProbeHistories<dim> &, \
                                LocalizationResult &);                                 \
  template void note_sampling(LocalizationInput<dim> &, const VariantResult &,         \
                              const std::vector<double> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
