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
/** Criterion for a steady run. */
struct LimitCycleCriterion
{
  unsigned int periods = 3;    ///< least number of periods in a part
  unsigned int windows = 3;    ///< equal parts of the second half of the run
  double tolerance     = 0.02; ///< largest relative difference between the parts

  /** Speed of the flat (m/s); times the mean normal force it is the reference for
   * frictional power. */
  double reference_speed = 0.;

  /** Whether nothing presses a body that has left the flat back onto it. */
  bool stays_apart = false;

  /** Period (s) assumed while the signal shows no vibration; runs set an estimate for
   * their body. */
  double expected_period = 2.5e-5;
};

/** State of contact and body at one time; forces and energies per unit thickness. */
struct CycleSample
{
  double time = 0.; ///< s
  std::vector<double>
    displacement;               ///< u_x of contact nodes, the reference node first (m)
  double friction_energy  = 0.; ///< dissipated since the start (J/m)
  double normal_force     = 0.; ///< N/m
  double tangential_force = 0.; ///< N/m
  double sticking         = 0.; ///< fraction of the contact nodes
  double slipping         = 0.; ///< fraction of the contact nodes
  double kinetic_energy   = 0.; ///< J/m; 0 if it is not observed
  double elastic_energy   = 0.; ///< J/m; 0 if it is not observed
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
 * agrees within twice the tolerance. A body that nothing presses onto the flat is
 * separated for certain when no node touches the flat in any part; its motion is not
 * compared. Memory does not grow with the run (CycleRecord).
 */
class LimitCycleDetector
{
public:
  /** Starts without samples. */
  explicit LimitCycleDetector(
    const LimitCycleCriterion &criterion = LimitCycleCriterion());

  /**
   * Adds a sample; times have to be uniformly spaced and increasing.
   * @return false, and the sample is rejected, if a value is not finite
   */
  bool add(const CycleSample &sample);

  /** Whether the limit cycle is reached according to the samples so far; withdrawn if a
   * quantity grows later. */
  bool reached() const
  {
    return time_reached > 0.;
  }

  /** Time (s) of the decision; 0 if it is not reached. */
  double reached_at() const
  {
    return time_reached;
  }

  /** Start (s) of the steady part; the middle of the time so far if it is not reached. */
  double steady_from() const
  {
    return reached() ? start : 0.5 * (first_time + last_time);
  }

  /** Period (s) of the reference node's vibration; the expected period if there is
   * none. */
  double period() const
  {
    return vibration_period;
  }

  /** Current result, then the criterion, in one sentence, for logs and reports. */
  std::string description() const;

  /** The criterion is not stored: restore into a detector with the same criterion. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &record &motion &n_samples &first_time &last_time &last_friction_energy;
    archive &next_check &vibration_period &difference &quantity &kind;
    archive &time_reached &start;
  }

private:
  /** Parts of the record: equal numbers @p length of bins, the last part ends with the
   * record. */
  struct Parts
  {
    std::size_t first, length;
  };

  double sample_step() const;
  void check();

  /** Period of the latter half of the samples, or of the last 8192 of them; empty if they
   * show no vibration. */
  std::optional<double> estimate_period() const;

  /** Parts of the bins from @p first on; empty if they would be too short. */
  std::optional<Parts> parts(std::size_t first) const;

  /** CycleRecord::mean() or variance() of a column over the bins [first, last). */
  using RecordFunction = double (CycleRecord::*)(std::size_t,
                                                 std::size_t,
                                                 std::size_t) const;

  /** Evaluates @p value of a column for each part. */
  std::vector<double> of_parts(const Parts &parts,
                               const RecordFunction value,
                               const std::size_t column) const;

  /** Whether no node touches the flat in any part. */
  bool is_apart(const Parts &parts) const;

  void compare_resultants(const Parts &parts);
  /** Also detects steady sliding. */
  void compare_motion(const Parts &parts);

  /** Updates the largest difference. */
  void include(double found, const char *of);

  LimitCycleCriterion criterion;
  CycleRecord record;
  /** Latest displacements of the reference node: the bins of the record would alias. */
  std::vector<double> motion;
  unsigned long n_samples     = 0;
  double first_time           = 0.;
  double last_time            = 0.;
  double last_friction_energy = 0.;
  double next_check           = 0.;
  double vibration_period;
  double difference = -1.;  ///< largest among the parts last compared; -1: none
  std::string quantity;     ///< quantity with the largest difference
  std::string kind;         ///< "Steady sliding", "Limit cycle" or "Separation"
  double time_reached = 0.; ///< 0: not reached
  double start        = 0.; ///< start of the steady part
};

/** A detector fed with the observations of a run; its result is valid on rank 0. */
class LimitCycleWatch : public LimitCycleDetector
{
public:
  /** @p n_nodes: contact nodes without periodic copies; @p energy_interval: steps between
   * energies. */
  LimitCycleWatch(const LimitCycleCriterion &criterion,
                  const unsigned int n_nodes,
                  const unsigned int energy_interval,
                  const MPI_Comm communicator);

  /**
   * Adds the samples in @p fresh, each of a run once and in order; @p energy may be
   * null. Collective.
   * @return false if a sample is not finite (and was not added)
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
  /** Energies of all ranks, samples so far. */
  std::vector<double> kinetic_energy, elastic_energy;
};
} // namespace mesoslip

#endif
