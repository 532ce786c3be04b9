#include "localization/comparison.h"

#include "base/errors.h"
#include "base/exchange.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>

namespace mesoslip
{
namespace
{
/** Times of the snapshots of a run in a window; at least one. */
std::vector<double> times_in(const RunSnapshots &run, const TimeWindow &window)
{
  return times_of(run.times, snapshots_in(run, window));
}

double mean_interval(const std::vector<double> &times)
{
  return times.size() < 2
           ? 0.
           : (times.back() - times.front()) / static_cast<double>(times.size() - 1);
}

std::string span_text(const RunSnapshots &run, const std::vector<double> &times)
{
  return run.path + " are from " + to_text(times.front()) + " to " +
         to_text(times.back()) + " s";
}

/** Mean and standard deviation (divided by n) of component @p c of a series. */
std::array<double, 2> mean_and_deviation(const std::vector<double> &values,
                                         const std::size_t c,
                                         const std::size_t n_components)
{
  const double n = static_cast<double>(values.size()) / static_cast<double>(n_components);
  double mean = 0., squares = 0.;
  for (std::size_t k = c; k < values.size(); k += n_components)
    mean += values[k];
  mean /= n;
  for (std::size_t k = c; k < values.size(); k += n_components)
    squares += (values[k] - mean) * (values[k] - mean);
  return {{mean, std::sqrt(squares / n)}};
}

double relative(const double value, const double reference)
{
  return reference != 0. ? (value - reference) / reference : ComponentStatistics::unknown;
}

/** Sums over cells: their number, squares of two fields and of their difference, weights. */
using Sums = std::array<double, 5>;

/** Sums of component @p c of @p components of a field over a region. */
Sums sums_over(const std::vector<double> &localized,
               const std::vector<double> &direct,
               const std::size_t components,
               const std::size_t c,
               const CellRegion &region,
               const std::vector<double> &volume)
{
  Sums sums = {{static_cast<double>(region.cells.size())}};
  for (const std::size_t cell : region.cells)
    {
      const double a      = localized[cell * components + c];
      const double b      = direct[cell * components + c];
      const double weight = volume.empty() ? 1. : volume[cell];
      sums[1] += weight * (a * a);
      sums[2] += weight * (b * b);
      sums[3] += weight * ((a - b) * (a - b));
      sums[4] += weight;
    }
  return sums;
}

/** The error from @p sums, an array of five. */
FieldError
error_of(const std::string &quantity, const std::string &region, const double *sums)
{
  const double n = sums[4] > 0. ? sums[4] : 1.;
  return {quantity,
          region,
          static_cast<std::size_t>(sums[0]),
          std::sqrt(sums[1] / n),
          std::sqrt(sums[2] / n),
          sums[2] > 0. ? std::sqrt(sums[3] / sums[2])
                       : std::numeric_limits<double>::quiet_NaN()};
}
} // namespace

std::vector<ConditionDifference> compare_conditions(const RunSource &homogeneous,
                                                    const RunSource &direct,
                                                    const bool allow_different_loads,
                                                    std::vector<std::string> &notes,
                                                    std::vector<std::string> &warnings)
{
  for (const RunSource *run : {&homogeneous, &direct})
    if (!run->conditions)
      warnings.push_back(run->path + " does not tell its loads, as an earlier version "
                                     "wrote it: whether both runs were made under the "
                                     "same is not known");
  if (!homogeneous.conditions || !direct.conditions)
    return {};
  const auto differences =
    condition_differences(*homogeneous.conditions, *direct.conditions);
  const std::string loads    = differences_text(differences, true);
  const std::string method   = differences_text(differences, false);
  const std::string sentence = "the homogeneous run " + homogeneous.path +
                               " and the direct run " + direct.path +
                               " were made under different conditions (" + loads +
                               "), so their difference is not the error of localization";
  if (!loads.empty() && !allow_different_loads)
    throw UserError(sentence + "; run both under the same, or set "
                               "Input/Allow different loads = true");
  if (!loads.empty())
    warnings.push_back(sentence);
  if (!method.empty())
    notes.push_back("Homogeneous and direct run differ: " + method);
  return differences;
}

double steady_from(const RunSource &run)
{
  const RunConditions conditions = run.conditions.value_or(RunConditions());
  const auto analysis            = conditions.find("analysis");
  if (analysis != conditions.end() &&
      std::get<std::string>(analysis->second) == "static contact")
    return -std::numeric_limits<double>::infinity();
  const auto from = number_of(conditions, "steady_from");
  if (!from)
    throw UserError(
      "Window/From is auto, but " + run.path +
      " does not tell from when on the run is steady, as an earlier version "
      "wrote it; give a time in s, or run contact_dynamics again");
  return *from;
}

std::string window_text(const TimeWindow &window)
{
  if (!std::isfinite(window.end))
    return "after " + to_text(window.begin) + " s";
  if (!std::isfinite(window.begin))
    return "before " + to_text(window.end) + " s";
  return "between " + to_text(window.begin) + " and " + to_text(window.end) + " s";
}

IndexRange snapshots_in(const RunSnapshots &run, const TimeWindow &window)
{
  const auto &times      = run.times;
  const IndexRange range = entries_in(times, window);
  if (times.empty())
    throw UserError(run.path + ": /snapshots is empty; run contact_dynamics until "
                               "after Snapshots/From");
  if (range.count == 0)
    throw UserError(run.path + ": no snapshot lies " + window_text(window) + ", its " +
                    std::to_string(times.size()) + " go from " + to_text(times.front()) +
                    " to " + to_text(times.back()) + " s; change Window/From and To");
  return range;
}

TimeWindow shared_snapshots(const RunSnapshots &one,
                            const RunSnapshots &other,
                            const TimeWindow &window)
{
  const std::vector<double> a = times_in(one, window), b = times_in(other, window);
  if (a.size() == 1 && b.size() == 1)
    return window;
  const double slack      = 0.5 * std::max(mean_interval(a), mean_interval(b));
  const TimeWindow shared = window.intersection(
    {std::max(a.front(), b.front()) - slack, std::min(a.back(), b.back()) + slack});
  if (entries_in(a, shared).count == 0 || entries_in(b, shared).count == 0)
    throw UserError("the snapshots of the two runs have no time in common: those of " +
                    span_text(one, a) + ", those of " + span_text(other, b) +
                    "; run contact_dynamics with the same Snapshots/From and To");
  return shared;
}

std::vector<double> resample(const ProbeSeries &series, const std::vector<double> &times)
{
  const std::size_t n =
    series.values.size() / std::max<std::size_t>(series.time.size(), 1);
  std::vector<double> values;
  values.reserve(n * times.size());
  std::size_t next = 1;
  for (const double t : times)
    {
      while (next + 1 < series.time.size() && series.time[next] < t)
        ++next;
      const std::size_t last  = std::min(next, series.time.size() - 1);
      const std::size_t first = last == 0 ? 0 : last - 1;
      const double span       = series.time[last] - series.time[first];
      const double share =
        span > 0. ? std::clamp((t - series.time[first]) / span, 0., 1.) : 0.;
      for (std::size_t c = 0; c < n; ++c)
        values.push_back((1. - share) * series.values[n * first + c] +
                         share * series.values[n * last + c]);
    }
  return values;
}

std::vector<ComponentStatistics> compare_series(const std::vector<double> &stress,
                                                const std::vector<double> &direct,
                                                const std::vector<double> &resampled,
                                                const std::size_t n)
{
  std::vector<ComponentStatistics> result(n);
  for (std::size_t c = 0; c < n; ++c)
    {
      ComponentStatistics &r = result[c];
      const auto ours        = mean_and_deviation(stress, c, n);
      r.mean                 = ours[0];
      r.deviation            = ours[1];
      if (direct.empty())
        continue;
      const auto theirs  = mean_and_deviation(direct, c, n);
      r.direct_mean      = theirs[0];
      r.direct_deviation = theirs[1];
      r.error_mean       = relative(r.mean, r.direct_mean);
      r.error_deviation  = relative(r.deviation, r.direct_deviation);
      double difference = 0., norm = 0.;
      for (std::size_t k = c; k < resampled.size(); k += n)
        {
          difference += (stress[k] - resampled[k]) * (stress[k] - resampled[k]);
          norm += resampled[k] * resampled[k];
        }
      if (norm > 0.)
        r.rms_difference = std::sqrt(difference / norm);
    }
  return result;
}

template <int dim>
std::vector<CellRegion> comparison_regions(const std::vector<dealii::Point<dim>> &centres,
                                           const dealii::Point<dim> &extent,
                                           const std::vector<std::uint8_t> &phase,
                                           const std::vector<std::string> &phases,
                                           const double surface_depth,
                                           const double edge_distance)
{
  std::vector<CellRegion> regions = {
    {"all", {}}, {"surface", {}}, {"bulk", {}}, {"interior", {}}, {"surface_inner", {}}};
  const std::size_t n_places = regions.size();
  for (const std::string &of_cells : phases)
    {
      const bool taken =
        std::any_of(regions.begin(), regions.end(),
                    [&](const CellRegion &region) { return region.name == of_cells; });
      regions.push_back({(taken ? "phase_" : "") + of_cells, {}});
      regions.push_back({regions.back().name + "_interior", {}});
    }
  for (std::size_t cell = 0; cell < centres.size(); ++cell)
    {
      const auto far_from_sides = [&](const unsigned int d) {
        const double x = centres[cell][d];
        return std::min(x, extent[d] - x) >= edge_distance;
      };
      bool inner = true;
      for (unsigned int d = 0; d + 1 < dim; ++d)
        inner = inner && far_from_sides(d);
      const bool surface  = centres[cell][dim - 1] < surface_depth;
      const bool interior = inner && far_from_sides(dim - 1);
      const bool member[] = {true, surface, !surface, interior, surface && inner};
      for (std::size_t r = 0; r < n_places; ++r)
        if (member[r])
          regions[r].cells.push_back(cell);
      const std::size_t of_phase = n_places + std::size_t{2} * phase[cell];
      regions[of_phase].cells.push_back(cell);
      if (interior)
        regions[of_phase + 1].cells.push_back(cell);
    }
  return regions;
}

std::vector<FieldError> field_errors(const unsigned int dim,
                                     const FieldSelection &fields,
                                     const StressFields &localized,
                                     const StressFields &direct,
                                     const std::vector<CellRegion> &regions,
                                     const std::vector<double> &volume,
                                     const MPI_Comm communicator)
{
  std::vector<std::array<std::string, 2>> names;
  std::vector<double> all;
  for (const StressField &field : stress_fields(dim, fields))
    for (std::size_t c = 0; c < field.quantities.size(); ++c)
      for (const CellRegion &region : regions)
        {
          const Sums sums = sums_over(localized.*field.values, direct.*field.values,
                                      field.quantities.size(), c, region, volume);
          names.push_back({{field.quantities[c], region.name}});
          all.insert(all.end(), sums.begin(), sums.end());
        }
  sum_over_ranks(all, communicator);
  std::vector<FieldError> errors;
  for (std::size_t k = 0; k < names.size(); ++k)
    errors.push_back(error_of(names[k][0], names[k][1], &all[k * Sums().size()]));
  return errors;
}

StressFields difference(const StressFields &localized, const StressFields &direct)
{
  StressFields result;
  for (const StressField &field : stress_fields(2)) // the same members in 3D
    {
      const auto &ours = localized.*field.values, &theirs = direct.*field.values;
      AssertDimension(ours.size(), theirs.size());
      std::transform(ours.begin(), ours.end(), theirs.begin(),
                     std::back_inserter(result.*field.values), std::minus<>());
    }
  return result;
}

template std::vector<CellRegion> comparison_regions(const std::vector<dealii::Point<2>> &,
                                                    const dealii::Point<2> &,
                                                    const std::vector<std::uint8_t> &,
                                                    const std::vector<std::string> &,
                                                    const double,
                                                    const double);
template std::vector<CellRegion> comparison_regions(const std::vector<dealii::Point<3>> &,
                                                    const dealii::Point<3> &,
                                                    const std::vector<std::uint8_t> &,
                                                    const std::vector<std::string> &,
                                                    const double,
                                                    const double);
} // namespace mesoslip
