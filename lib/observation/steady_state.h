#ifndef mesoslip_observation_steady_state_h
#define mesoslip_observation_steady_state_h

#include "observation/cycle_record.h"
#include "observation/spectrum.h"

#include <boost/serialization/string.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** When a run counts as steady. The defaults suit the paper's pin (40 kHz). */
struct LimitCycleCriterion
{
  /** Periods that a part has at least. */
  unsigned int periods = 3;

  /** Equal parts of the second half of the run that have to agree among one another. */
  unsigned int windows = 3;

  /** Largest relative difference among these parts. */
  double tolerance = 0.02;

  /** Hz; where the main frequency is looked for. */
  FrequencyBand band;

  /** s; period used while the signal shows no vibration (steady sliding). */
  double expected_period = 2.5e-5;

  /** rms over |mean| of a displacement below which it counts as steady sliding; the same
   * share of the reference power, and of the elastic energy for the kinetic one, is no
   * difference. */
  double negligible_fraction = 1e-3;

  /** W/m; P S |V|. */
  double reference_power = 0.;
};

/** What the contact and the body do at one time; forces and energies per unit thickness.
 */
struct CycleSample
{
  double time = 0.; ///< s

  /** m; u_x of some contact nodes, the reference node first. */
  std::vector<double> displacement;

  double friction_energy  = 0.; ///< J/m, since the start
  double normal_force     = 0.; ///< N/m
  double tangential_force = 0.; ///< N/m
  double sticking         = 0.; ///< share of the contact nodes
  double slipping         = 0.; ///< share of the contact nodes
  double kinetic_energy   = 0.; ///< J/m; leave at 0 when it is not observed
  double elastic_energy   = 0.; ///< J/m; leave at 0 when it is not observed
};

/**
 * Detects, while a run is going on, that its vibration has become a limit cycle (or that
 * it slides steadily): the second half of the run so far is cut into equal parts of whole
 * periods (losing less than one period each), and all of the following have to agree
 * among the parts within the tolerance:
 *
 *     mean and rms amplitude of u_x of each node   relative to the amplitude, the mean
 *                                                  also to |mean|
 *     frictional power, F_T / F_N                  relative to their mean
 *     shares of sticking and slipping nodes        as they are
 *     elastic energy, kinetic energy               relative to their mean
 *
 * As the parts grow with the run, a plateau on the way, however flat, does not pass once
 * it is shorter than half of what has been simulated, and slow beats average out. While
 * the amplitudes are negligible and do not grow they are not compared (steady sliding).
 * Later on the judgement is withdrawn if the time since the steady part began no longer
 * agrees within twice the tolerance. Memory does not grow with the run (CycleRecord).
 */
class LimitCycleDetector
{
public:
  /** With nothing seen yet. */
  explicit LimitCycleDetector(
    const LimitCycleCriterion &criterion = LimitCycleCriterion());

  /**
   * Feed one sample. Times have to be uniformly spaced and increasing.
   * @return whether the steady state is reached
   * @throws NumericalFailure if a value is not finite
   */
  bool add(const CycleSample &sample);

  /** By what has been added so far; taken back when something grows later. */
  bool reached() const
  {
    return reached_at_ > 0.;
  }

  /** Steady, without vibration. */
  bool steady_sliding() const
  {
    return reached() && sliding_;
  }

  /** s; start of the steady part; the middle of the time fed so far if it was not
   * reached. */
  double steady_from() const;

  /** s; time of the sample at which the decision fell; nothing if it did not. */
  std::optional<double> reached_at() const;

  /** s; period of the reference node's vibration; the expected one without any. */
  double period() const
  {
    return period_;
  }

  /** Largest relative difference among the parts last compared; -1 before. */
  double difference() const
  {
    return difference_;
  }

  /** The criterion and its present outcome, in one sentence, for logs and reports. */
  std::string description() const;

  /** Criteria are not stored: a detector is restored into one made with the same ones. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &record_ &motion_ &n_nodes_ &n_samples_ &first_time_ &last_time_
      &last_friction_energy_ &next_check_ &period_ &difference_ &quantity_ &sliding_
        &reached_at_ &steady_from_;
  }

private:
  /** Bins of the record: equal parts of @p length bins, the last one ends with the
   * record. */
  struct Parts
  {
    std::size_t first, length;
  };

  double sample_step() const;
  void check();

  /** Period of the latter half of the samples, or of the last 8192 of them; nothing if
   * they show no vibration. */
  std::optional<double> estimate_period() const;

  /** Nothing if the parts of the bins from @p first on would be too short. */
  std::optional<Parts> parts(std::size_t first) const;

  class PartValues;

  template <typename Function>
  PartValues of_parts(const Parts &parts, const Function &value) const;

  /** Sets difference_, quantity_ and sliding_. */
  void compare(const Parts &parts);
  void compare_resultants(const Parts &parts);
  void compare_motion(const Parts &parts);

  /** Keeps the largest difference. */
  void include(double difference, const char *quantity);

  LimitCycleCriterion criterion_;
  CycleRecord record_;
  /** Latest displacements of the reference node: bins of the record would alias. */
  std::vector<double> motion_;
  std::vector<double> values_; ///< of the sample that is added
  std::size_t n_nodes_         = 0;
  unsigned long n_samples_     = 0;
  double first_time_           = 0.;
  double last_time_            = 0.;
  double last_friction_energy_ = 0.;
  double next_check_           = 0.;
  double period_               = 0.;
  double difference_           = -1.;
  std::string quantity_; ///< that differs the most
  bool sliding_       = false;
  double reached_at_  = 0.; ///< 0: not reached
  double steady_from_ = 0.;
};
} // namespace mesoslip

#endif
