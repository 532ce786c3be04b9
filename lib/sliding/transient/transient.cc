#include "sliding/transient/transient.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "base/version.h"
#include "grid/row_partition.h"
#include "material/plausibility.h"
#include "observation/steady_record.h"
#include "parameters/keys.h"
#include "program/run_context.h"
#include "sliding/transient/dynamics_output.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace mesoslip
{
namespace
{
// A million years on a machine of today.
constexpr double largest_step_number = 1e18;

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
} // namespace

TransientAnalysis::TransientAnalysis(const ContactParameters &p, const Keys &keys)
  : BodyAnalysis(p)
  , identity(run_identity(keys, parameters.sweep.isa, body.rve_digest))
{
  const unsigned int n_rows  = body.grid.cells[1] + 1,
                     n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                     most    = largest_number_of_ranks(n_rows);
  if (n_ranks > most)
    throw UserError(
      "the body has " + std::to_string(n_rows) +
      " rows of nodes (Body/Cells), which are divided among the processes, "
      "two at least each; start " +
      (most == 1 ? "it without mpirun" : "at most " + std::to_string(most) + " of them") +
      " instead of " + std::to_string(n_ranks));
  const double n_steps = largest_number_of_steps(parameters, material);
  if (!(n_steps <= largest_step_number))
    throw UserError("Time/End time: " + to_text(parameters.time.end_time) + " s are " +
                    quantity_text(n_steps, "") +
                    " steps, more than any run can do; are Body/Size in m, the stiffness "
                    "in Pa, the density in kg/m^3 and the times in s?");
  check_steady_from(parameters, n_steps,
                    statistics_interval(material, parameters.time.end_time / n_steps));
  require_memory(history_memory(n_steps));
  disk = disk_space(n_steps);
}

double TransientAnalysis::n_snapshots(const double n_steps) const
{
  const ObservationParameters &o = parameters.observation;
  if (!(o.snapshots_interval > 0.))
    return 0.;
  const double end  = parameters.time.end_time,
               to   = std::isnan(o.snapshots_to) ? end : o.snapshots_to,
               last = std::min(to, end);
  if (!(o.snapshots_from <= last))
    throw UserError("Snapshots/From: " + to_text(o.snapshots_from) +
                    " s is after the last one, at " + to_text(last) +
                    " s, so there would be none; set it earlier, or Interval = 0");
  return std::min(std::floor((to - o.snapshots_from) / o.snapshots_interval) + 1.,
                  n_steps);
}

double TransientAnalysis::history_bytes(const double n_steps) const
{
  // Of a sample of the histories with the reference node; of a probe; of the energies.
  constexpr double history_numbers = 18., probe_numbers = 11., energy_numbers = 10.;
  const ObservationParameters &o = parameters.observation;
  const double n_probes          = static_cast<double>(o.probes.size());
  double numbers = history_numbers * n_steps / parameters.history_interval +
                   probe_numbers * n_probes * n_steps / o.probe_interval;
  if (parameters.energy_interval > 0)
    numbers += energy_numbers * n_steps / parameters.energy_interval;
  return sizeof(double) * numbers;
}

ResourceNeed TransientAnalysis::history_memory(const double n_steps) const
{
  // With the samples for the statistics, which are not written.
  const double dt = parameters.time.end_time / n_steps;
  const double samples =
    SteadyRecord::numbers(n_steps / statistics_interval(material, dt));
  const std::string damping = damping_warning(parameters, material, "them");
  return {history_bytes(n_steps) + sizeof(double) * samples,
          brief_text(3,
                     "increase Observation/History interval (and Probe interval, Energy "
                     "interval), or reduce Time/End time, now ",
                     n_steps, " steps of ", dt, " s",
                     !std::isnan(parameters.step.dt) ? " (Time/Time step)"
                     : !damping.empty()
                       ? ": " + damping
                       : brief_text(3, " (", 100. * parameters.time.safety,
                                    " % of the critical time step)"))};
}

ResourceNeed TransientAnalysis::disk_space(const double n_steps) const
{
  const double snapshots = n_snapshots(n_steps);
  const double field =
    2. * sizeof(double) * (body.grid.cells[0] + 1.) * (body.grid.cells[1] + 1.);
  const double fields = snapshots * field, histories = history_bytes(n_steps);
  // Displacement, increment and histories, in the old one and in the new.
  ResourceNeed need        = history_memory(n_steps);
  const double checkpoints = 2. * (2. * field + need.bytes);
  if (fields > histories)
    need.remedy = to_text(snapshots) +
                  " snapshots take most of it: increase Snapshots/Interval, now " +
                  to_text(parameters.observation.snapshots_interval) +
                  " s, or set From and To";
  need.bytes = fields + histories + checkpoints;
  return need;
}

void TransientAnalysis::describe(std::ostream &out) const
{
  BodyAnalysis::describe(out);
  const TimeStepChoice time = choose_time_step(parameters, material);
  const double n            = static_cast<double>(time.n_steps);
  out.precision(4);
  out << time.text() << "\nTimes: " << crossing_text(parameters, material) << '\n'
      << n_snapshots(n) << " snapshots, " << bytes_text(disk_space(n).bytes)
      << " on the disk, "
      << bytes_text(field_memory(parameters.analysis, body.grid).bytes +
                    history_memory(n).bytes)
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

  DynamicsOutput output(context, parameters, body, time);
  TransientRun run(parameters, body, time, material, checkpoint, output, context);
  if (resumed)
    run.restore();
  TransientResult result = run.run();

  try
    {
      const auto scope = context.timer().scope("Evaluation and output");
      on_root(context.communicator(), [&]() {
        result.evaluate();
        output.write(result);
        summarize_body("transient", context);
        result.write_summary(context);
      });
    }
  catch (...)
    {
      // What was computed is not to be lost with the output.
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
      throw;
    }
  if (result.interrupted)
    throw Interrupted("stopped on request after step " +
                      std::to_string(result.steps_done) +
                      "; what was observed so far is in " + context.output_folder() +
                      ", and the same command with --resume goes on from there");
  // The state is dropped only when nothing is left to be done.
  context.write_summary();
  checkpoint.complete(run.position());
}
} // namespace mesoslip
