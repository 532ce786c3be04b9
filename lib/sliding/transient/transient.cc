#include "sliding/transient/transient.h"

#include "base/collective.h"
#include "base/errors.h"
#include "base/version.h"
#include "grid/row_partition.h"
#include "material/plausibility.h"
#include "parameters/keys.h"
#include "program/run_context.h"
#include "sliding/plausible_input.h"
#include "sliding/transient/dynamics_output.h"
#include "sliding/transient/transient_run.h"
#include "sliding/transient/transient_summary.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <ostream>

namespace mesoslip
{
namespace
{
// A million years on a machine of today.
constexpr double largest_step_number = 1e18;

// mu_inter rests on the samples for statistics from there to the end: three at least,
// unless the run is too short for it anyway.
void check_steady_from(const ContactParameters &parameters,
                       const UniformMaterial &material,
                       const double n_steps)
{
  const double from = parameters.observation.steady_from, end = parameters.time.end_time;
  const double n_samples = n_steps / statistics_interval(material, end / n_steps);
  const double latest = n_samples < static_cast<double>(TransientSummary::least_samples)
                          ? end
                          : end - 2. * end / n_samples;
  if (!std::isnan(from) && !(from < end && from <= latest))
    throw UserError(
      "Observation/Steady from: " + to_text(from) +
      " s leaves fewer than three samples for statistics before Time/End time, " +
      to_text(end) + " s; set it earlier, or auto");
}

// The rows of nodes are divided among the ranks.
void check_ranks(const UniformGrid<2> &grid)
{
  const unsigned int n_rows  = grid.cells[1] + 1,
                     n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                     most    = largest_number_of_ranks(n_rows);
  if (n_ranks > most)
    throw UserError(
      "the body has " + std::to_string(n_rows) +
      " rows of nodes (Body/Cells), which are divided among the processes, "
      "two at least each; start " +
      (most == 1 ? "it without mpirun" : "at most " + std::to_string(most) + " of them") +
      " instead of " + std::to_string(n_ranks));
}

// Whatever decides a bit of the state or of what was written so far: a run that is
// resumed has to agree in it.
std::string
run_identity(const Keys &keys, const InstructionSet isa, const std::string &rve_digest)
{
  return canonical_parameters(keys,
                              {"Output folder", "Time/End time",
                               "Observation/Steady from", "Checkpoints/", "Performance/",
                               "Modal/", "Static contact/", "Friction homogenization/"}) +
         "Performance/Instruction set = " + to_string(resolve(isa)) +
         "\nContent of Body/RVE file = " + rve_digest + "\nProgram version = " + version +
         "\n";
}

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

TransientAnalysis::TransientAnalysis(const ContactParameters &p, const Keys &keys)
  : BodyAnalysis(p)
  , identity(run_identity(keys, parameters.sweep.isa, body.rve_digest))
{
  check_ranks(body.grid);
  const double n_steps = largest_number_of_steps(parameters, material);
  if (!(n_steps <= largest_step_number))
    throw UserError("Time/End time: " + to_text(parameters.time.end_time) + " s are " +
                    quantity_text(n_steps, "") +
                    " steps, more than any run can do; are Body/Size in m, the stiffness "
                    "in Pa, the density in kg/m^3 and the times in s?");
  check_steady_from(parameters, material, n_steps);
  require_memory(history_memory(parameters, material, n_steps));
  disk = dynamics_file_size(parameters, material, n_steps);
}

void TransientAnalysis::describe(std::ostream &out) const
{
  BodyAnalysis::describe(out);
  const TimeStepChoice time = choose_time_step(parameters, material);
  const double n            = static_cast<double>(time.n_steps);
  out.precision(4);
  out << time.text() << "\nTimes: " << crossing_text(parameters, material) << '\n'
      << n_snapshots(parameters, n) << " snapshots, "
      << bytes_text(dynamics_file_size(parameters, material, n).bytes) << " on the disk, "
      << bytes_text(field_memory(parameters.analysis, body.grid).bytes +
                    history_memory(parameters, material, n).bytes)
      << " of memory\n";
  for (const std::string &warning : implausible_run(parameters, material))
    out << "Warning: " << warning << '\n';
}

void TransientAnalysis::run(RunContext &context)
{
  log_body(context);
  const TimeStepChoice time = [&]() {
    const auto scope = context.timer().scope("Critical time step");
    return choose_time_step(parameters, material);
  }();

  TransientCheckpoint checkpoint(context, parameters.checkpoints,
                                 identity + "Time step in s = " + to_text(time.step.dt) +
                                   "\n");
  const auto found = context.resume() ? checkpoint.find(time.n_steps)
                                      : TransientCheckpoint::Found::nothing;
  if (found == TransientCheckpoint::Found::complete)
    return context.log("The run in " + context.output_folder() +
                       " is complete: there is nothing to resume");
  if (context.resume())
    context.begin();
  const bool resumed = found == TransientCheckpoint::Found::state;
  if (!resumed)
    {
      checkpoint.discard();
      context.remove_results({"dynamics.h5", "dynamics.xdmf", "dynamics-phases.xdmf",
                              "history.csv", "energy.csv"});
    }
  context.log(time.text());
  for (const std::string &warning : implausible_run(parameters, material))
    context.warn(warning);

  DynamicsOutput output(context, parameters, body);
  TransientRun run(parameters, body, time, material, checkpoint, output, context);
  if (resumed)
    run.restore();
  const TransientObservations observed = run.run();

  try
    {
      const auto scope = context.timer().scope("Evaluation and output");
      on_root(context.communicator(), [&]() {
        const TransientSummary summary = summarize_transient(parameters, body, observed);
        output.write(observed, summary);
        summarize_body("transient", context);
        write_summary(parameters, body, time, observed, summary, context);
      });
    }
  catch (...)
    {
      keep_state(run, context);
      throw;
    }
  if (observed.interrupted)
    throw Interrupted("stopped on request after step " +
                      std::to_string(observed.steps_done) +
                      "; what was observed so far is in " + context.output_folder() +
                      ", and the same command with --resume goes on from there");
  // The state is dropped only when nothing is left to be done.
  context.write_summary();
  checkpoint.complete(run.position());
}
} // namespace mesoslip
