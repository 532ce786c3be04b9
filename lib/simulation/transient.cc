#include "simulation/transient.h"

#include "io/collective.h"
#include "io/errors.h"
#include "io/hdf5_file.h"
#include "io/parameters.h"
#include "io/record_file.h"
#include "io/run_context.h"
#include "simulation/dynamics_file.h"
#include "simulation/run_report.h"
#include "simulation/transient_run.h"
#include "simulation/transient_summary.h"

#include <filesystem>

namespace mesoslip
{
namespace
{
/** Evaluation and output have failed: what was computed is not to be lost with them. */
void keep_state(TransientRun &run, RunContext &context)
{
  try
    {
      run.save();
      context.log(
        "The state is in the checkpoint: once the reason is mended, the same command "
        "with --resume writes the results without computing them again");
    }
  catch (const std::exception &)
    {
      context.log("The state could not be kept, either");
    }
}
} // namespace

void run_transient(const ContactParameters &parameters,
                   const Scene &scene,
                   const std::string &identity,
                   RunContext &context)
{
  const UniformMaterial material = scene.make_material(parameters.periodic);
  const TimeStepChoice time      = [&]() {
    const auto scope = context.timer().scope("Critical time step");
    return choose_time_step(parameters, material);
  }();

  TransientCheckpoint checkpoint(context, parameters.checkpoints,
                                 identity + "Time step in s = " + to_text(time.step.dt) +
                                   "\n");
  const auto found = context.resume() ? checkpoint.find(time.n_steps)
                                      : TransientCheckpoint::Found::nothing;
  if (found == TransientCheckpoint::Found::complete)
    {
      // Its end may have been cut short just before.
      if (context.root() && !parameters.checkpoints.keep)
        std::filesystem::remove(context.file("snapshots.part"));
      return context.log("The run in " + context.output_folder() +
                         " is complete: there is nothing to resume");
    }
  if (context.resume())
    context.begin();
  const bool resumed = found == TransientCheckpoint::Found::state;
  if (!resumed)
    checkpoint.discard();
  context.log(time.text());
  for (const std::string &warning : transient_warnings(parameters, material))
    context.warn(warning);

  DynamicsFile file(context, parameters, scene,
                    resumed ? checkpoint.position().snapshots : 0);
  TransientRun run(parameters, scene, time, material, checkpoint, file, context);
  if (resumed)
    run.restore();
  const TransientObservations observed = run.run();

  try
    {
      const auto scope = context.timer().scope("Evaluation and output");
      on_root(context.communicator(), [&]() {
        const TransientSummary summary = summarize_transient(parameters, scene, observed);
        file.write(observed, summary);
        write_summary(parameters, scene, time, observed, summary, context);
      });
    }
  catch (...)
    {
      keep_state(run, context);
      throw;
    }
  context.results_are_written();
  if (observed.interrupted)
    throw Interrupted("stopped on request after step " +
                      std::to_string(observed.steps_done) +
                      "; what was observed so far is in " + context.output_folder() +
                      ", and the same command with --resume goes on from there");
  // The state is dropped only when nothing is left to be done.
  context.write_summary();
  checkpoint.complete(run.position());
  if (!parameters.checkpoints.keep)
    file.remove_snapshots();
}
} // namespace mesoslip
