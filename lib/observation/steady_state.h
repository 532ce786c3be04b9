#ifndef mesoslip_observation_steady_state_h
#define mesoslip_observation_steady_state_h

#include "contact/contact_recorder.h"
#include "dynamics/energy_audit.h"
#include "observation/steady_record.h"

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** When a run counts as steady. */
struct LimitCycleCriterion
{
  unsigned int periods = 3;    ///< that a part has at least
  unsigned int windows = 3;    ///< equal parts of the second half of the run
  double tolerance     = 0.02; ///< largest relative difference among the parts

  /** Speed of the flat (m/s); times the mean normal force it is what frictional power is compared with. */
  double reference_speed = 0.;


  /** Period (s) while the signal shows no vibration; runs set that of their body. */
  double expected_period = 2.5e-5;
};

/** What the contact and the body do at one time; forces and energies per unit thickness.
 */
struct CycleSample
{
  double time = 0.; ///< s
  std::vector<double>
    displacement;               ///< u_x of contact nodes, the reference node first (m)
  double friction_energy  = 0.; ///< since the start (J/m)
  double normal_force     = 0.; ///< N/m
  double tangential_force = 0.; ///< N/m
  double sticking         = 0.; ///< fraction of the contact nodes
  double slipping         = 0.; ///< fraction of the contact nodes
  double kinetic_energy   = 0.; ///< J/m; 0 when it is not observed
  double elastic_energy   = 0.; ///< J/m; 0 when it is not observed
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
   * Takes one sample; times have to be uniformly spaced and increasing.
   * @return false, and nothing is taken, if a value is not finite
   */
  bool add(const CycleSample &sample);

  /** By what has been added so far; withdrawn when something grows later. */
  bool reached() const
  {
    return time_reached > 0.;
  }

  /** Time (s) of the sample at which the decision fell; 0 if it did not. */
  double reached_at() const
  {
    return time_reached;
  }

  /** Start (s) of the steady part; the middle of the time so far if it was not reached. */
  double steady_from() const
  {
    return reached() ? start : 0.5 * (first_time + last_time);
  }

  /** Period (s) of the reference node's vibration; an expected one without any. */
  double period() const
  {
    return vibration_period;
  }

  /** The present outcome, then the criterion, in one sentence, for logs and reports. */
  std::string description() const;

  /** Criteria are not stored: a detector is restored into one made with the same ones. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &record &motion &n_samples &first_time &last_time &last_friction_energy;
    archive &next_check &vibration_period &difference &quantity &sliding;
    archive &time_reached &start;
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

  /** CycleRecord::mean() or variance() of a column, first and behind the last bin. */
  using RecordFunction = double (CycleRecord::*)(std::size_t,
                                                 std::size_t,
                                                 std::size_t) const;

  /** The value of each part. */
  std::vector<double> of_parts(const Parts &parts,
                               const RecordFunction value,
                               const std::size_t column) const;

  void compare_resultants(const Parts &parts);
  /** Also whether the body slides steadily. */
  void compare_motion(const Parts &parts);

  /** Keeps the largest difference. */
  void include(double found, const char *of);

  LimitCycleCriterion criterion;
  CycleRecord record;
  /** Latest displacements of the reference node: bins of the record would alias. */
  std::vector<double> motion;
  unsigned long n_samples     = 0;
  double first_time           = 0.;
  double last_time            = 0.;
  double last_friction_energy = 0.;
  double next_check           = 0.;
  double vibration_period;
  double difference = -1.; ///< largest among the parts last compared; -1: none
  std::string quantity;    ///< that differs the most
  bool sliding        = false;
  double time_reached = 0.; ///< 0: not reached
  double start        = 0.; ///< of the steady part
};

/** A detector that is told what a run observes. Only that of rank 0 knows more. */
class LimitCycleWatch : public LimitCycleDetector
{
public:
  /** @p n_nodes: distinct contact nodes; @p energy_interval: steps between energies. */
  LimitCycleWatch(const LimitCycleCriterion &criterion,
                  const unsigned int n_nodes,
                  const unsigned int energy_interval,
                  const MPI_Comm communicator);

  /**
   * Passes on the samples in @p fresh, each of a run once and in their order; @p energy
   * may be null. Collective.
   * @return false if there is a sample that is not finite (and was not passed on)
   */
  bool update(const ContactHistory &fresh, const EnergyAudit *energy);

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int version)
  {
    LimitCycleDetector::serialize(archive, version);
    archive &kinetic_energy &elastic_energy;
  }

private:
  const unsigned int n_nodes, energy_interval;
  const MPI_Comm communicator;
  /** Of all ranks, samples so far. */
  std::vector<double> kinetic_energy, elastic_energy;
};
} // namespace mesoslip

#endif
