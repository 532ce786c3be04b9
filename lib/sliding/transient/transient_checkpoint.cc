#include "sliding/transient/transient_checkpoint.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "io/checkpoint.h"
#include "material/plausibility.h"
#include "parameters/keys.h"
#include "parameters/parameters.h"
#include "program/run_context.h"

#include <filesystem>

namespace mesoslip
{
namespace
{
// Layout 1 had no friction target, 2 no samples for statistics, 3 other snapshots and
// histories, 4 the states beside the rest, 5 the samples of probes without their places,
// 6 probes in the plane alone, 7 the whole contact of a mesh on each rank.
const char checkpoint_kind[] = "contact_dynamics, layout 12";

std::string place(const CheckpointPosition &position)
{
  return "step " + std::to_string(position.step) +
         brief_text(6, ", t = ", position.time, " s");
}
} // namespace

TransientCheckpoint::TransientCheckpoint(RunContext &run_context,
                                         const CheckpointParameters &p,
                                         const std::string &what)
  : context(run_context)
  , parameters(p)
  , identity(what + "Number of MPI ranks = " + std::to_string(context.n_ranks()) + "\n")
  , path(context.file("contact_dynamics.checkpoint"))
  , last(std::chrono::steady_clock::now())
{
}

TransientCheckpoint::Found TransientCheckpoint::look(const std::uint64_t n_steps)
{
  const std::string from_the_start = ": starting from the beginning";
  if (!std::filesystem::exists(path))
    {
      context.log("There is no checkpoint in " + context.output_folder() +
                  from_the_start);
      return Found::nothing;
    }
  load_state(read_checkpoint(path, checkpoint_kind), record, path);
  const CheckpointPosition &done = record.position;
  const std::string differences  = parameter_differences(identity, record.identity);
  if (!differences.empty())
    throw UserError(path + " belongs to a run with other parameters: " + differences +
                    "; set them back, or start again without --resume");
  if (done.step > n_steps)
    throw UserError("Time/End time lies before the checkpoint (" + place(done) +
                    "); set a later one, or start again without --resume");
  const bool ended = done.by_limit_cycle || (done.at_end && done.step == n_steps);
  if (ended && std::filesystem::exists(context.file("summary.json")))
    return Found::complete;
  if (!record.states.empty())
    return Found::state;
  if (!ended)
    throw UserError("the run in " + context.output_folder() + " was complete at " +
                    place(done) +
                    " and did not keep its last state (Checkpoints/Keep); start again "
                    "without --resume to reach a later Time/End time");
  context.log("The results in " + context.output_folder() +
              " are gone and no state was kept" + from_the_start);
  return Found::nothing;
}

TransientCheckpoint::Found TransientCheckpoint::find(const std::uint64_t n_steps)
{
  const MPI_Comm comm = context.communicator();
  Found found         = Found::nothing;
  on_root(comm, [&]() { found = look(n_steps); });
  broadcast_object(comm, found);
  broadcast_object(comm, record.position);
  if (found == Found::state)
    own_state = scatter(comm, record.states);
  record.states.clear();
  return found;
}

void TransientCheckpoint::discard()
{
  on_root(context.communicator(), [&]() {
    if (!std::filesystem::exists(path))
      return;
    try
      {
        load_state(read_checkpoint(path, checkpoint_kind), record, path);
        if (!record.position.at_end)
          context.warn(
            "the run that was stopped at " + place(record.position) +
            " starts anew; --resume continues one, if nothing but Time/End time "
            "has changed");
      }
    catch (const UserError &)
      {
        // Removed in any case: this run will leave another one.
      }
    record = Record();
    std::filesystem::remove(path);
  });
}

TransientCheckpoint::Found TransientCheckpoint::begin(const std::uint64_t n_steps)
{
  const Found found = context.resume() ? find(n_steps) : Found::nothing;
  if (found == Found::complete)
    context.log("The run in " + context.output_folder() +
                " is complete: there is nothing to resume");
  else if (context.resume())
    context.begin();
  if (found == Found::nothing)
    {
      discard();
      context.remove_results({"dynamics.h5", "dynamics.xdmf", "dynamics-phases.xdmf",
                              "history.csv", "energy.csv", "contact_dynamics.end"});
    }
  return found;
}

bool TransientCheckpoint::due() const
{
  return parameters.interval > 0. && std::chrono::steady_clock::now() - last >=
                                       std::chrono::duration<double>(parameters.interval);
}

void TransientCheckpoint::write_record(const Record &now) const
{
  on_root(context.communicator(),
          [&]() { write_checkpoint(path, checkpoint_kind, save_state(now)); });
}

void TransientCheckpoint::write(const CheckpointPosition &position,
                                const std::string &state)
{
  const auto scope = context.timer().scope("Checkpoints");
  write_record({identity, position, gather(context.communicator(), state)});
  last = std::chrono::steady_clock::now();
}

void TransientCheckpoint::complete(const CheckpointPosition &position)
{
  if (!parameters.keep)
    write_record({identity, position, {}});
}
} // namespace mesoslip
