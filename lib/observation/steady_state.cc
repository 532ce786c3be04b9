#include "observation/steady_state.h"

#include "material/plausibility.h"
#include "observation/spectrum.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mesoslip
{
namespace
{
/**
 * rms over |mean| of a displacement below which sliding is steady; the same share of the
 * reference power, and for the kinetic energy of the elastic energy, counts as no
 * difference.
 */
constexpr double negligible = 1e-3;

constexpr char separation[] = "Separation";

/** Growth between parts up to which a negligible amplitude counts as steady. */
constexpr double sliding_growth = 1.5;

/** Difference, relative to the tolerance, at which the result is withdrawn. */
constexpr double withdrawal = 2.;

/** Time between two checks, relative to the time so far. */
constexpr double check_spacing = 0.02;

/** Samples from which the period is estimated at most; up to twice as many are kept. */
constexpr std::size_t period_samples = 8192;

/** Columns of the record; the displacements follow. */
enum Column : std::size_t
{
  power,
  normal_force,
  tangential_force,
  sticking,
  slipping,
  kinetic_energy,
  elastic_energy,
  first_displacement
};

double mean_of(const std::vector<double> &values)
{
  return std::accumulate(values.begin(), values.end(), 0.) /
         static_cast<double>(values.size());
}

double spread_of(const std::vector<double> &values)
{
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

/** Spread over the larger of |mean| and @p scale. */
double relative_spread(const std::vector<double> &values, const double scale = 0.)
{
  const double spread = spread_of(values);
  return spread > 0. ? spread / std::max(std::fabs(mean_of(values)), scale) : 0.;
}

/** Appends the new entries of @p part, the contribution of this rank, to @p all, summed
 * over the ranks. */
void gather_parts(const std::vector<double> &part,
                  std::vector<double> &all,
                  const MPI_Comm communicator)
{
  const std::size_t known = all.size();
  all.insert(all.end(), part.begin() + static_cast<std::ptrdiff_t>(known), part.end());
  MPI_Allreduce(MPI_IN_PLACE, all.data() + known, static_cast<int>(all.size() - known),
                MPI_DOUBLE, MPI_SUM, communicator);
}
} // namespace

std::vector<double> LimitCycleDetector::of_parts(const Parts &parts,
                                                 const RecordFunction value,
                                                 const std::size_t column) const
{
  std::vector<double> values;
  for (std::size_t k = 0; k < criterion.windows; ++k)
    values.push_back((record.*value)(column, parts.first + k * parts.length,
                                     parts.first + (k + 1) * parts.length));
  return values;
}

LimitCycleDetector::LimitCycleDetector(const LimitCycleCriterion &criterion)
  : criterion(criterion)
  , vibration_period(criterion.expected_period)
{
  Assert(criterion.periods >= 1 && criterion.windows >= 2 && criterion.tolerance > 0.,
         dealii::ExcMessage("This criterion is always met, or never."));
}

bool LimitCycleDetector::add(const CycleSample &sample)
{
  std::vector<double> values = {sample.friction_energy - last_friction_energy,
                                sample.normal_force,
                                sample.tangential_force,
                                sample.sticking,
                                sample.slipping,
                                sample.kinetic_energy,
                                sample.elastic_energy};
  values.insert(values.end(), sample.displacement.begin(), sample.displacement.end());
  if (!std::all_of(values.begin(), values.end(),
                   [](double v) { return std::isfinite(v); }))
    return false;
  if (n_samples == 0)
    first_time = next_check = sample.time;
  last_friction_energy = sample.friction_energy;
  last_time            = sample.time;
  ++n_samples;
  record.add(values);
  motion.push_back(sample.displacement.front());
  if (motion.size() >= 2 * period_samples)
    motion.erase(motion.begin(), motion.end() - period_samples);
  if (sample.time >= next_check)
    check();
  return true;
}

double LimitCycleDetector::sample_step() const
{
  return n_samples > 1 ? (last_time - first_time) / static_cast<double>(n_samples - 1)
                       : 0.;
}

void LimitCycleDetector::check()
{
  next_check = last_time + std::max(criterion.periods * vibration_period,
                                    check_spacing * (last_time - first_time));
  if (n_samples < 2)
    return;
  vibration_period = estimate_period().value_or(criterion.expected_period);
  // Once reached, the whole time since the start of the steady part is judged.
  const double bin         = sample_step() * static_cast<double>(record.stride());
  const std::size_t middle = (record.size() + 1) / 2;
  const double from =
    reached() ? std::ceil((start - first_time) / bin) : static_cast<double>(middle);
  const auto first =
    static_cast<std::size_t>(std::clamp(from, 0., static_cast<double>(record.size())));
  const auto compared = parts(first);
  if (!compared)
    return;
  difference = 0.;
  quantity   = "nothing";
  if (criterion.stays_apart && is_apart(*compared))
    kind = separation;
  else
    {
      compare_resultants(*compared);
      compare_motion(*compared);
    }
  if (reached())
    {
      if (!(difference <= withdrawal * criterion.tolerance))
        time_reached = 0.;
    }
  else if (difference <= criterion.tolerance)
    {
      time_reached = last_time;
      start        = first_time + static_cast<double>(compared->first) * bin;
    }
}

std::optional<double> LimitCycleDetector::estimate_period() const
{
  const std::size_t kept =
    std::min<std::size_t>({n_samples - n_samples / 2, period_samples, motion.size()});
  if (kept < 16)
    return std::nullopt;
  const std::vector<double> half(motion.end() - static_cast<std::ptrdiff_t>(kept),
                                 motion.end());
  const auto summary = summarize_spectrum(amplitude_spectrum(half, sample_step(), 2));
  // Larger motion with fewer than two periods is a drift rather than a vibration.
  if (!summary || summary->slow_amplitude > summary->main_amplitude)
    return std::nullopt;
  return 1. / summary->main_frequency;
}

std::optional<LimitCycleDetector::Parts>
LimitCycleDetector::parts(const std::size_t first) const
{
  if (record.size() <= first)
    return std::nullopt;
  const double period =
    vibration_period / (sample_step() * static_cast<double>(record.stride())); // in bins
  const double periods =
    std::floor(static_cast<double>(record.size() - first) / criterion.windows / period);
  // The last comparison also fails for NaN, which has no index.
  if (!(periods >= criterion.periods) || !(periods * period >= 1.) ||
      !(periods * period * criterion.windows < static_cast<double>(record.size() + 1)))
    return std::nullopt;
  const auto length = static_cast<std::size_t>(periods * period);
  return Parts{record.size() - criterion.windows * length, length};
}

bool LimitCycleDetector::is_apart(const Parts &parts) const
{
  const auto touches = [&](const Column column) {
    const std::vector<double> means = of_parts(parts, &CycleRecord::mean, column);
    return std::any_of(means.begin(), means.end(), [](double v) { return v != 0.; });
  };
  return !touches(sticking) && !touches(slipping);
}

void LimitCycleDetector::include(const double found, const char *of)
{
  if (found <= difference)
    return;
  difference = found;
  quantity   = of;
}

void LimitCycleDetector::compare_resultants(const Parts &parts)
{
  const auto means = [&](const Column column) {
    return of_parts(parts, &CycleRecord::mean, column);
  };
  const std::vector<double> pressing = means(normal_force);
  std::vector<double> friction       = means(tangential_force);
  for (std::size_t k = 0; k < friction.size(); ++k)
    friction[k] = pressing[k] > 0. ? friction[k] / pressing[k] : 0.;
  const std::vector<double> elastic = means(elastic_energy);
  include(relative_spread(means(power), negligible * mean_of(pressing) *
                                          criterion.reference_speed * sample_step()),
          "the frictional power");
  include(relative_spread(friction, negligible), "the apparent friction");
  include(spread_of(means(sticking)), "the share of sticking nodes");
  include(spread_of(means(slipping)), "the share of slipping nodes");
  include(relative_spread(elastic), "the elastic energy");
  include(relative_spread(means(kinetic_energy), negligible * mean_of(elastic)),
          "the kinetic energy");
}

void LimitCycleDetector::compare_motion(const Parts &parts)
{
  bool sliding        = true;
  double of_amplitude = 0.;
  for (std::size_t c = first_displacement; c < record.n_columns(); ++c)
    {
      const std::vector<double> mean = of_parts(parts, &CycleRecord::mean, c);
      std::vector<double> amplitude  = of_parts(parts, &CycleRecord::variance, c);
      for (double &value : amplitude)
        value = std::sqrt(value);
      include(relative_spread(mean, mean_of(amplitude)), "a mean displacement");
      of_amplitude = std::max(of_amplitude, relative_spread(amplitude));
      sliding = sliding && mean_of(amplitude) <= negligible * std::fabs(mean_of(mean)) &&
                !(amplitude.back() > sliding_growth * amplitude.front());
    }
  if (!sliding)
    include(of_amplitude, "an amplitude");
  kind = sliding ? "Steady sliding" : "Limit cycle";
}

std::string LimitCycleDetector::description() const
{
  const std::size_t n_nodes =
    record.size() > 0 ? record.n_columns() - first_displacement : 0;
  const std::string verdict =
    reached() ? brief_text(4, kind, " from ", start, " s on, found at t = ", time_reached,
                           " s, period ", vibration_period, " s")
              : brief_text(4, "No limit cycle by t = ", last_time, " s");
  const std::string largest_difference =
    reached() || !(difference >= 0.)
      ? ""
      : brief_text(4, ": ", quantity, " differs by ", 100. * difference, " %");
  if (reached() && kind == separation)
    return verdict + brief_text(6, " (the criterion: no node touched the flat in ",
                                criterion.windows * criterion.periods,
                                " periods, the second half of the run, and nothing "
                                "presses the body onto it)");
  return verdict + largest_difference +
         brief_text(6, " (the criterion: motion of ", n_nodes,
                    " contact nodes, frictional power, apparent friction, contact shares "
                    "and energies of ",
                    criterion.windows, " equal parts, of at least ", criterion.periods,
                    " periods each, of the second half of the run agree within ",
                    100. * criterion.tolerance, " %)");
}

LimitCycleWatch::LimitCycleWatch(const LimitCycleCriterion &criterion,
                                 const unsigned int n_nodes,
                                 const unsigned int energy_interval,
                                 const MPI_Comm communicator)
  : LimitCycleDetector(criterion)
  , n_nodes(n_nodes)
  , energy_interval(energy_interval)
  , communicator(communicator)
{
}

bool LimitCycleWatch::update(const ContactHistory &fresh, const EnergyAudit *energy)
{
  if (energy != nullptr)
    {
      gather_parts(energy->local_history().kinetic, kinetic_energy, communicator);
      gather_parts(energy->local_history().elastic, elastic_energy, communicator);
    }
  for (std::size_t k = 0; k < fresh.step.size(); ++k)
    {
      CycleSample sample;
      for (const MonitoredNode &node : fresh.nodes)
        sample.displacement.push_back(node.ux[k]);
      sample.time             = fresh.time[k];
      sample.friction_energy  = fresh.friction_energy[k];
      sample.normal_force     = fresh.normal_force[k];
      sample.tangential_force = fresh.tangential_force[k];
      sample.sticking         = fresh.sticking[k] / n_nodes;
      sample.slipping         = fresh.slipping[k] / n_nodes;
      if (!kinetic_energy.empty()) // the last value known at that step
        {
          const std::size_t e   = fresh.step[k] / energy_interval;
          sample.kinetic_energy = kinetic_energy[e];
          sample.elastic_energy = elastic_energy[e];
        }
      if (!add(sample))
        return false;
    }
  return true;
}
} // namespace mesoslip
