#include "observation/steady_state.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace mesoslip
{
namespace
{
/** Growth that a negligible amplitude may show among the parts compared. */
constexpr double sliding_growth = 1.5;

/** Difference, relative to the tolerance, at which a judgement is withdrawn. */
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
} // namespace

/** The values of one quantity in the parts. */
class LimitCycleDetector::PartValues
{
public:
  explicit PartValues(std::vector<double> values)
    : values(std::move(values))
  {
  }

  double mean() const
  {
    return std::accumulate(values.begin(), values.end(), 0.) /
           static_cast<double>(values.size());
  }

  double spread() const
  {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return *most - *least;
  }

  /** Spread over the larger of |mean| and @p scale. */
  double relative(const double scale = 0.) const
  {
    return spread() > 0. ? spread() / std::max(std::fabs(mean()), scale) : 0.;
  }

  double first() const
  {
    return values.front();
  }

  double last() const
  {
    return values.back();
  }

private:
  std::vector<double> values;
};

template <typename Function>
LimitCycleDetector::PartValues LimitCycleDetector::of_parts(const Parts &parts,
                                                            const Function &value) const
{
  std::vector<double> values;
  for (unsigned int k = 0; k < criterion_.windows; ++k)
    values.push_back(
      value(parts.first + k * parts.length, parts.first + (k + 1) * parts.length));
  return PartValues(std::move(values));
}

LimitCycleDetector::LimitCycleDetector(const LimitCycleCriterion &criterion)
  : criterion_(criterion)
  , period_(criterion.expected_period)
{
  if (criterion.periods < 1 || criterion.windows < 2 || !(criterion.tolerance > 0.) ||
      !(criterion.expected_period > 0.))
    throw std::invalid_argument(
      "LimitCycleDetector: needs at least 1 period, 2 windows, a positive tolerance and "
      "a positive expected period");
}

bool LimitCycleDetector::add(const CycleSample &sample)
{
  values_ = {sample.friction_energy - last_friction_energy_,
             sample.normal_force,
             sample.tangential_force,
             sample.sticking,
             sample.slipping,
             sample.kinetic_energy,
             sample.elastic_energy};
  values_.insert(values_.end(), sample.displacement.begin(), sample.displacement.end());
  for (const double value : values_)
    if (!std::isfinite(value))
      throw NumericalFailure(
        "a displacement, force or energy of the contact is not finite at "
        "t = " +
        std::to_string(sample.time) + " s");
  if (n_samples_ == 0)
    first_time_ = next_check_ = sample.time;
  n_nodes_              = sample.displacement.size();
  last_friction_energy_ = sample.friction_energy;
  last_time_            = sample.time;
  ++n_samples_;
  record_.add(values_);
  motion_.push_back(sample.displacement.front());
  if (motion_.size() >= 2 * period_samples)
    motion_.erase(motion_.begin(), motion_.end() - period_samples);
  if (sample.time >= next_check_)
    check();
  return reached();
}

double LimitCycleDetector::sample_step() const
{
  return n_samples_ > 1 ? (last_time_ - first_time_) / static_cast<double>(n_samples_ - 1)
                        : 0.;
}

void LimitCycleDetector::check()
{
  next_check_ = last_time_ + std::max(criterion_.periods * period_,
                                      check_spacing * (last_time_ - first_time_));
  if (n_samples_ < 2)
    return;
  period_ = estimate_period().value_or(criterion_.expected_period);
  // Once reached, everything since the steady part began is judged.
  const double bin         = sample_step() * static_cast<double>(record_.stride());
  const std::size_t middle = (record_.size() + 1) / 2;
  const double from        = reached() ? std::ceil((steady_from_ - first_time_) / bin)
                                       : static_cast<double>(middle);
  const auto first         = static_cast<std::size_t>(
    std::fmin(std::fmax(from, 0.), static_cast<double>(record_.size())));
  const auto compared = parts(first);
  if (!compared)
    return;
  compare(*compared);
  if (reached())
    {
      if (!(difference_ <= withdrawal * criterion_.tolerance))
        reached_at_ = 0.;
    }
  else if (difference_ <= criterion_.tolerance)
    {
      reached_at_  = last_time_;
      steady_from_ = first_time_ + static_cast<double>(compared->first) * bin;
    }
}

std::optional<double> LimitCycleDetector::estimate_period() const
{
  const std::size_t kept =
    std::min<std::size_t>({n_samples_ - n_samples_ / 2, period_samples, motion_.size()});
  if (kept < 16)
    return std::nullopt;
  const std::vector<double> half(motion_.end() - static_cast<std::ptrdiff_t>(kept),
                                 motion_.end());
  const double step = sample_step();
  const auto summary =
    summarize_spectrum(amplitude_spectrum(half, step, 2), criterion_.band);
  // Fewer than two periods are rather a drift than a vibration.
  const double duration = step * static_cast<double>(half.size());
  if (!summary || !(summary->main.frequency * duration >= 2.))
    return std::nullopt;
  return 1. / summary->main.frequency;
}

std::optional<LimitCycleDetector::Parts>
LimitCycleDetector::parts(const std::size_t first) const
{
  if (record_.size() <= first)
    return std::nullopt;
  const double period =
    period_ / (sample_step() * static_cast<double>(record_.stride())); // in bins
  const double periods =
    std::floor(static_cast<double>(record_.size() - first) / criterion_.windows / period);
  // The last comparison also fails for what is not a number, and cannot be made an index.
  if (!(periods >= criterion_.periods) || !(periods * period >= 1.) ||
      !(periods * period * criterion_.windows < static_cast<double>(record_.size() + 1)))
    return std::nullopt;
  const auto length = static_cast<std::size_t>(periods * period);
  return Parts{record_.size() - criterion_.windows * length, length};
}

void LimitCycleDetector::compare(const Parts &parts)
{
  difference_ = 0.;
  quantity_   = "nothing";
  compare_resultants(parts);
  compare_motion(parts);
}

void LimitCycleDetector::include(const double difference, const char *quantity)
{
  if (difference <= difference_)
    return;
  difference_ = difference;
  quantity_   = quantity;
}

void LimitCycleDetector::compare_resultants(const Parts &parts)
{
  const auto means = [&](const Column column) {
    return of_parts(parts, [&](const std::size_t first, const std::size_t last) {
      return record_.mean(column, first, last);
    });
  };
  const double little = criterion_.negligible_fraction;
  include(means(power).relative(little * criterion_.reference_power * sample_step()),
          "the frictional power");
  include(of_parts(parts,
                   [&](const std::size_t first, const std::size_t last) {
                     const double pressing = record_.mean(normal_force, first, last);
                     return pressing > 0.
                              ? record_.mean(tangential_force, first, last) / pressing
                              : 0.;
                   })
            .relative(little),
          "the apparent friction");
  include(means(sticking).spread(), "the share of sticking nodes");
  include(means(slipping).spread(), "the share of slipping nodes");
  const PartValues elastic = means(elastic_energy);
  include(elastic.relative(), "the elastic energy");
  include(means(kinetic_energy).relative(little * elastic.mean()), "the kinetic energy");
}

void LimitCycleDetector::compare_motion(const Parts &parts)
{
  sliding_            = true;
  double of_amplitude = 0.;
  for (std::size_t c = first_displacement; c < first_displacement + n_nodes_; ++c)
    {
      const PartValues mean =
        of_parts(parts, [&](const std::size_t first, const std::size_t last) {
          return record_.mean(c, first, last);
        });
      const PartValues amplitude =
        of_parts(parts, [&](const std::size_t first, const std::size_t last) {
          return std::sqrt(record_.variance(c, first, last));
        });
      include(mean.relative(amplitude.mean()), "a mean displacement");
      of_amplitude = std::max(of_amplitude, amplitude.relative());
      sliding_ =
        sliding_ &&
        amplitude.mean() <= criterion_.negligible_fraction * std::fabs(mean.mean()) &&
        !(amplitude.last() > sliding_growth * amplitude.first());
    }
  if (!sliding_)
    include(of_amplitude, "an amplitude");
}

std::optional<double> LimitCycleDetector::reached_at() const
{
  return reached() ? std::optional<double>(reached_at_) : std::nullopt;
}

double LimitCycleDetector::steady_from() const
{
  return reached() ? steady_from_ : 0.5 * (first_time_ + last_time_);
}

std::string LimitCycleDetector::description() const
{
  std::ostringstream text;
  text << "limit cycle: motion of " << n_nodes_
       << " contact nodes, frictional power, apparent "
       << "friction, contact shares and energies of " << criterion_.windows
       << " equal parts (of at least " << criterion_.periods
       << " periods) of the second half of the run agree within "
       << 100. * criterion_.tolerance << " %; ";
  text.precision(4);
  if (reached())
    text << (steady_sliding() ? "steady sliding" : "reached") << " at t = " << reached_at_
         << " s, steady from " << steady_from_ << " s, period " << period_ << " s";
  else
    {
      text << "not reached by t = " << last_time_ << " s";
      if (difference_ >= 0.)
        text << " (" << quantity_ << " differs by " << 100. * difference_ << " %)";
    }
  return text.str();
}
} // namespace mesoslip
