#ifndef mesoslip_observation_steady_state_h
#define mesoslip_observation_steady_state_h

#include "observation/spectrum.h"

#include <boost/serialization/vector.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** When a run counts as steady. The defaults suit the paper's pin (40 kHz). */
struct LimitCycleCriterion
{
  /** Periods a window. */
  unsigned int periods = 3;

  /** Consecutive windows that have to agree among one another. */
  unsigned int windows = 3;

  /** Largest relative difference among these windows. */
  double tolerance = 0.02;

  /** Hz; where the main frequency is looked for. */
  FrequencyBand band;

  /** s; period used while the signal shows no vibration (steady sliding). */
  double expected_period = 2.5e-5;

  /** m; rms displacement below which a window counts as steady sliding. */
  double negligible_amplitude = 0.;

  /** The same relative to the mean displacement of the window; the larger one counts. */
  double negligible_fraction = 1e-3;

  /** s; nothing before this time counts (ramps of the loading, for instance). */
  double minimum_time = 0.;
};

/** What was measured in one window of some periods. */
struct CycleWindow
{
  /** s */
  double begin = 0., end = 0.;

  /** s; period that set the length of the window. */
  double period = 0.;

  /** m; mean displacement, and rms about that mean (a sine: amplitude / sqrt 2). */
  double mean = 0., amplitude = 0.;

  /** W (per m of thickness in 2D); (E(end) - E(begin)) / (end - begin). */
  double power = 0.;

  /** Largest relative change against the previous window; -1 for the first one. */
  double change = -1.;

  /** Whether the amplitude was negligible. */
  bool sliding = false;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &begin &end &period &mean &amplitude &power &change &sliding;
  }
};

/**
 * Detects, while a run is going on, that its vibration has become a limit cycle (or that
 * it slides steadily). Uniformly sampled values of a reference displacement and of the
 * frictional energy are fed in; the record is cut into windows of some periods, the
 * period following from the main frequency of the latter half of the record so far. The
 * memory used does not grow with the run: the record is kept at 4096 to 8192 averaged
 * values.
 *
 * Differences are measured relative to the mean amplitude of the windows compared, to
 * the larger of amplitude and |mean| for the mean, and to the mean power.
 * Steady sliding asks in addition that the negligible amplitude does not grow.
 */
class LimitCycleDetector
{
public:
  explicit LimitCycleDetector(
    const LimitCycleCriterion &criterion = LimitCycleCriterion());

  /**
   * Feed one sample. Times have to be uniformly spaced and increasing.
   * @return whether the steady state is reached (with this or an earlier sample)
   * @throws NumericalFailure if a value is not finite
   */
  bool add(double time, double displacement, double friction_energy);

  /** Feed a chunk; the three arrays have the same length. @return reached() */
  bool add(const std::vector<double> &time,
           const std::vector<double> &displacement,
           const std::vector<double> &friction_energy);

  bool reached() const
  {
    return reached_;
  }

  /** Steady, without vibration. */
  bool steady_sliding() const;

  /**
   * s; start of the first of the agreeing windows. If the steady state was not reached:
   * @p fallback (the paper: 2.5e-4 s) if that leaves at least a quarter of the time fed
   * so far, otherwise half of that time.
   */
  double steady_from(double fallback = 2.5e-4) const;

  /** s; time of the sample at which the decision fell; nothing if it did not. */
  std::optional<double> reached_at() const;

  /** s; period of the last window; the expected one before the first. */
  double period() const;

  /** All windows so far, in order. */
  const std::vector<CycleWindow> &history() const
  {
    return windows_;
  }

  /** The criterion and its present outcome, in one sentence, for logs and reports. */
  std::string description(double fallback = 2.5e-4) const;

  /** Criteria are not stored: a detector is restored into one made with the same ones. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &record_ &stride_ &pending_ &pending_sum_ &n_samples_ &first_time_ &last_time_
      &window_begin_ &window_end_ &window_period_ &window_samples_ &window_mean_
        &window_square_ &window_energy_ &last_energy_ &windows_ &reached_ &reached_at_
          &steady_from_;
  }

private:
  void record(double displacement);

  void close_window(double time, double friction_energy);

  void open_window(double time, double friction_energy);

  /** Period of the latter half of the record; nothing if it shows no vibration. */
  std::optional<double> estimate_period() const;

  void decide(double time);

  LimitCycleCriterion criterion_;

  // The whole signal, averaged over stride_ samples, for the spectrum.
  std::vector<double> record_;
  unsigned long stride_    = 1;
  unsigned long pending_   = 0;
  double pending_sum_      = 0.;
  unsigned long n_samples_ = 0;
  double first_time_       = 0.;
  double last_time_        = 0.;

  // The window being filled (Welford's running mean and sum of squares).
  double window_begin_          = 0.;
  double window_end_            = 0.;
  double window_period_         = 0.;
  unsigned long window_samples_ = 0;
  double window_mean_           = 0.;
  double window_square_         = 0.;
  double window_energy_         = 0.;
  double last_energy_           = 0.;

  std::vector<CycleWindow> windows_;
  bool reached_       = false;
  double reached_at_  = 0.;
  double steady_from_ = 0.;
};

/** The same judgement over a complete history. @throws std::invalid_argument on lengths
 */
LimitCycleDetector
detect_limit_cycle(const std::vector<double> &time,
                   const std::vector<double> &displacement,
                   const std::vector<double> &friction_energy,
                   const LimitCycleCriterion &criterion = LimitCycleCriterion());
} // namespace mesoslip

#endif
