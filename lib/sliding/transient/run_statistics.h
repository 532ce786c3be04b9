#ifndef mesoslip_sliding_transient_run_statistics_h
#define mesoslip_sliding_transient_run_statistics_h

#include "observation/steady_state.h"
#include "sliding/transient/transient_checkpoint.h"
#include "sliding/transient/transient_result.h"

#include <cstdint>

namespace mesoslip
{
/** Requests of the ranks between two steps; the largest wins. */
enum class RunRequest : int
{
  go_on,
  save, ///< a checkpoint is due
  stop, ///< stopped by a signal or a file
  end,  ///< End time or limit cycle
  look  ///< a value is not finite
};

/**
 * The reference node and up to four more along a contact with nodes 0 to @p last, for
 * the detection of the limit cycle.
 */
std::vector<unsigned int> monitored_nodes(const unsigned int reference,
                                          const unsigned int last);

/** Steps between two checks of user requests and limit cycle. */
std::uint64_t control_interval(const std::uint64_t n_cells);

/**
 * @throws UserError if a run of @p n_steps with a sample for statistics every @p interval
 * steps has none from Steady from on
 */
void check_steady_from(const ContactParameters &parameters,
                       const double n_steps,
                       const unsigned int interval);

/**
 * Statistics of a run on a grid or a mesh, its limit cycle, and the decision when the
 * run ends. Collective.
 */
template <int dim>
class RunStatistics
{
public:
  /** Observes @p surfaces; references to all arguments are kept. */
  RunStatistics(const ContactParameters &parameters,
                const BodySize &size,
                const TimeStepChoice &time,
                SlidingBody<dim> &surfaces,
                const TransientCheckpoint &checkpoint,
                RunContext &context);

  /** Takes the latest samples and returns the joint request of the ranks after step @p n;
   * @p energy may be null. */
  RunRequest request(const std::uint64_t n, const EnergyAudit *energy);

  /** Puts the observations of this object and of the surfaces into @p all, complete on
   * rank 0. */
  void collect(TransientResult &all);

  /** State between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &limit_cycle &record;
  }

private:
  RunRequest own_request(const std::uint64_t n, const EnergyAudit *energy);

  const ContactParameters &parameters;
  const TimeStepChoice &time;
  SlidingBody<dim> &surfaces;
  const TransientCheckpoint &checkpoint;
  RunContext &context;
  ContactRecorder<dim> recent_contact; ///< since the last request
  TopRecorder recent_top;              ///< since the last request
  LimitCycleWatch limit_cycle;
  SteadyRecord record;
};
} // namespace mesoslip

#endif
