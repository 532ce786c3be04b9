#include "observation/steady_state.h"

#include "io/errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>

namespace mesoslip
{
namespace
{
constexpr std::size_t record_capacity = 8192;

/** Growth that a negligible amplitude may show among the windows compared. */
constexpr double sliding_growth = 1.5;

/** Largest relative difference within windows [first, last): amplitude, mean, power. */
double disagreement(const std::vector<CycleWindow>::const_iterator first,
                    const std::vector<CycleWindow>::const_iterator last)
{
  const double n      = static_cast<double>(last - first);
  bool sliding        = true;
  double amplitude[3] = {0., first->amplitude, first->amplitude};
  double mean[3]      = {0., first->mean, first->mean};
  double power[3]     = {0., first->power, first->power};
  const auto include  = [n](double(&range)[3], const double value) {
    range[0] += value / n;
    range[1] = std::min(range[1], value);
    range[2] = std::max(range[2], value);
  };
  for (auto window = first; window != last; ++window)
    {
      include(amplitude, window->amplitude);
      include(mean, window->mean);
      include(power, window->power);
      sliding = sliding && window->sliding;
    }
  const auto relative = [](const double(&range)[3], const double scale) {
    return range[2] > range[1] ? (range[2] - range[1]) / scale : 0.;
  };
  const bool growing = (last - 1)->amplitude > sliding_growth * first->amplitude;
  const double changes =
    std::max(relative(mean, std::max(amplitude[0], std::abs(mean[0]))),
             relative(power, std::abs(power[0])));
  if (sliding && !growing)
    return changes;
  return std::max(changes, relative(amplitude, amplitude[0]));
}
} // namespace

LimitCycleDetector::LimitCycleDetector(const LimitCycleCriterion &criterion)
  : criterion_(criterion)
{
  if (criterion.periods < 1 || criterion.windows < 2 || !(criterion.tolerance > 0.) ||
      !(criterion.expected_period > 0.))
    throw std::invalid_argument(
      "LimitCycleDetector: needs at least 1 period, 2 windows, a positive tolerance and "
      "a positive expected period");
}

bool LimitCycleDetector::add(const double time,
                             const double displacement,
                             const double friction_energy)
{
  if (!std::isfinite(time + displacement + friction_energy))
    throw NumericalFailure("the reference displacement or the frictional energy is not "
                           "finite at t = " +
                           std::to_string(time) + " s");
  record(displacement);
  last_time_ = time;
  if (n_samples_ == 1)
    {
      first_time_ = time;
      open_window(time, friction_energy);
      return reached_;
    }
  ++window_samples_;
  const double difference = displacement - window_mean_;
  window_mean_ += difference / static_cast<double>(window_samples_);
  window_square_ += difference * (displacement - window_mean_);

  if (time >= window_end_ - 1e-9 * window_period_)
    {
      close_window(time, friction_energy);
      open_window(time, friction_energy);
    }
  return reached_;
}

bool LimitCycleDetector::add(const std::vector<double> &time,
                             const std::vector<double> &displacement,
                             const std::vector<double> &friction_energy)
{
  if (displacement.size() != time.size() || friction_energy.size() != time.size())
    throw std::invalid_argument("LimitCycleDetector: arrays of different lengths");
  for (std::size_t i = 0; i < time.size(); ++i)
    add(time[i], displacement[i], friction_energy[i]);
  return reached_;
}

void LimitCycleDetector::record(const double displacement)
{
  ++n_samples_;
  pending_sum_ += displacement;
  if (++pending_ < stride_)
    return;
  record_.push_back(pending_sum_ / static_cast<double>(stride_));
  pending_     = 0;
  pending_sum_ = 0.;
  if (record_.size() == record_capacity)
    {
      for (std::size_t i = 0; i < record_capacity / 2; ++i)
        record_[i] = 0.5 * (record_[2 * i] + record_[2 * i + 1]);
      record_.resize(record_capacity / 2);
      stride_ *= 2;
    }
}

std::optional<double> LimitCycleDetector::estimate_period() const
{
  const std::vector<double> half(
    record_.begin() + static_cast<std::ptrdiff_t>(record_.size() / 2), record_.end());
  if (half.size() < 16)
    return std::nullopt;
  const double step = (last_time_ - first_time_) / static_cast<double>(n_samples_ - 1) *
                      static_cast<double>(stride_);
  const auto summary =
    summarize_spectrum(amplitude_spectrum(half, step, 2), criterion_.band);
  // Fewer than two periods are rather a drift than a vibration.
  const double duration = step * static_cast<double>(half.size());
  if (!summary || !(summary->main.frequency * duration >= 2.))
    return std::nullopt;
  return 1. / summary->main.frequency;
}

void LimitCycleDetector::open_window(const double time, const double friction_energy)
{
  window_period_ = criterion_.expected_period;
  if (!windows_.empty() && !windows_.back().sliding)
    window_period_ = estimate_period().value_or(windows_.back().period);
  window_begin_   = time;
  window_end_     = time + criterion_.periods * window_period_;
  window_energy_  = friction_energy;
  window_samples_ = 0;
  window_mean_    = 0.;
  window_square_  = 0.;
}

void LimitCycleDetector::close_window(const double time, const double friction_energy)
{
  CycleWindow window;
  window.begin     = window_begin_;
  window.end       = time;
  window.period    = window_period_;
  window.mean      = window_mean_;
  window.amplitude = std::sqrt(window_square_ / static_cast<double>(window_samples_));
  window.power     = (friction_energy - window_energy_) / (time - window_begin_);
  window.sliding =
    window.amplitude <= std::max(criterion_.negligible_amplitude,
                                 criterion_.negligible_fraction * std::abs(window.mean));
  windows_.push_back(window);
  if (windows_.size() > 1)
    windows_.back().change = disagreement(windows_.end() - 2, windows_.end());
  if (!reached_)
    decide(time);
}

void LimitCycleDetector::decide(const double time)
{
  if (windows_.size() < criterion_.windows)
    return;
  const auto first = windows_.cend() - criterion_.windows;
  if (first->begin < criterion_.minimum_time ||
      !(disagreement(first, windows_.cend()) <= criterion_.tolerance))
    return;
  reached_     = true;
  reached_at_  = time;
  steady_from_ = first->begin;
}

bool LimitCycleDetector::steady_sliding() const
{
  return reached_ && windows_.back().sliding;
}

std::optional<double> LimitCycleDetector::reached_at() const
{
  return reached_ ? std::optional<double>(reached_at_) : std::nullopt;
}

double LimitCycleDetector::period() const
{
  return windows_.empty() ? criterion_.expected_period : windows_.back().period;
}

double LimitCycleDetector::steady_from(const double fallback) const
{
  if (reached_)
    return steady_from_;
  const double duration = last_time_ - first_time_;
  if (fallback >= first_time_ && last_time_ - fallback >= 0.25 * duration)
    return fallback;
  return first_time_ + 0.5 * duration;
}

std::string LimitCycleDetector::description(const double fallback) const
{
  std::ostringstream text;
  text << "limit cycle: rms amplitude, mean and frictional power of "
       << criterion_.windows << " consecutive windows of " << criterion_.periods
       << " periods agree within " << 100. * criterion_.tolerance << " %; ";
  if (reached_)
    text << (steady_sliding() ? "steady sliding" : "reached") << " at t = " << reached_at_
         << " s, steady from " << steady_from_ << " s, period " << period() << " s";
  else
    text << "not reached by t = " << last_time_ << " s, statistics from "
         << steady_from(fallback) << " s on";
  return text.str();
}

LimitCycleDetector detect_limit_cycle(const std::vector<double> &time,
                                      const std::vector<double> &displacement,
                                      const std::vector<double> &friction_energy,
                                      const LimitCycleCriterion &criterion)
{
  LimitCycleDetector detector(criterion);
  detector.add(time, displacement, friction_energy);
  return detector;
}
} // namespace mesoslip
