#ifndef mesoslip_sliding_transient_transient_h
#define mesoslip_sliding_transient_transient_h

#include "sliding/body_analysis.h"
#include "sliding/counter/counter_output.h"
#include "sliding/run_plan.h"
#include "sliding/transient/run_needs.h"

#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/**
 * Explicit dynamics of the body on the moving flat: runs, observes, and leaves
 * dynamics.h5, tables and the summary in the output folder. With RunContext::resume() it
 * continues from the checkpoint there, if all keys that decide the result are the same.
 */
template <int dim>
class TransientAnalysis : public BodyAnalysis<dim>
{
public:
  /** @p keys identify the run. Collective. @throws UserError */
  TransientAnalysis(std::unique_ptr<GivenBody<dim>> given, const Keys &keys);

  ResourceNeed need() const override
  {
    return needs.disk;
  }

  void describe(std::ostream &out) const override;

  unsigned int useful_ranks() const override;

  bool resumable() const override
  {
    return true;
  }

  void write_draft(const std::string &folder) const override;

  /**
   * @throws Interrupted after writing a checkpoint and the results so far
   * @throws NumericalFailure if the run diverges; the last checkpoint stays
   */
  void run(RunContext &context) override;

private:
  using BodyAnalysis<dim>::body;
  using BodyAnalysis<dim>::facts;
  using BodyAnalysis<dim>::parameters;

  TimeStepChoice time_step() const;
  bool has_counter_file() const;
  std::unique_ptr<CounterOutput<dim>>
  counter_output(RunContext &context, const CounterMotion<dim> &below) const;
  std::vector<std::string> warnings() const;
  std::size_t n_cells() const; ///< cells of both bodies

  const std::unique_ptr<GivenBody<dim>> counter; ///< null: the flat is rigid
  const SurfaceMeeting meeting;                  ///< contact pairing of both bodies
  const std::string identity;                    ///< see run_identity()
  const TimeStepChoice time;
  const RunNeeds needs;
};
} // namespace mesoslip

#endif
