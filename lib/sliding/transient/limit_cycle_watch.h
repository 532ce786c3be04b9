#ifndef mesoslip_sliding_transient_limit_cycle_watch_h
#define mesoslip_sliding_transient_limit_cycle_watch_h

#include "contact/contact_recorder.h"
#include "dynamics/energy_audit.h"
#include "observation/steady_state.h"

#include <boost/serialization/vector.hpp>

#include <mpi.h>

#include <vector>

namespace mesoslip
{
/** Tells a LimitCycleDetector what a run has observed so far. Only rank 0 knows more. */
class LimitCycleWatch
{
public:
  /** @p n_nodes: distinct contact nodes; @p energy_interval: steps between energies. */
  LimitCycleWatch(const LimitCycleCriterion &criterion,
                  const unsigned int n_nodes,
                  const unsigned int energy_interval,
                  const MPI_Comm communicator);

  /**
   * Passes on what is new in @p contact, the samples of which come in order; @p energy
   * may be null. Collective.
   * @return false if there is a sample that is not finite (and was not passed on)
   */
  bool update(const ContactHistory &contact, const EnergyAudit *energy);

  /** With all that update() has passed on. */
  const LimitCycleDetector &detector() const
  {
    return cycle_detector;
  }

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &cycle_detector &next_step &kinetic_energy &elastic_energy;
  }

private:
  void gather_energies(const EnergyHistory &local);
  void
  take(const ContactHistory &contact, const std::size_t k, CycleSample &sample) const;

  const unsigned int n_nodes, energy_interval;
  const MPI_Comm communicator;
  LimitCycleDetector cycle_detector;
  std::uint64_t next_step = 0; ///< after the last one passed on
  /** Of all ranks, samples so far. */
  std::vector<double> kinetic_energy, elastic_energy;
};
} // namespace mesoslip

#endif
