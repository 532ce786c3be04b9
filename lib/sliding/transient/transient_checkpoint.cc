#include "sliding/transient/transient_checkpoint.h"

#include "base/archive.h"
#include "base/errors.h"
#include "base/exchange.h"
#include "io/checkpoint.h"
#include "parameters/keys.h"
#include "parameters/parameters.h"
#include "program/run_context.h"

#include <filesystem>
#include <numeric>

namespace mesoslip
{
namespace
{
std::string place(const CheckpointPosition &position)
{
  return "step " + std::to_string(position.step) + ", t = " + to_text(position.time) +
         " s";
}
} // namespace

TransientCheckpoint::TransientCheckpoint(RunContext &run_context,
                                         const CheckpointParameters &p,
                                         const std::string &what)
  : context(run_context)
  , parameters(p)
  , identity(what + "Number of MPI ranks = " + std::to_string(context.n_ranks()) + "\n")
  , file_path(context.file("contact_dynamics.checkpoint"))
  , last(std::chrono::steady_clock::now())
{
}

CheckpointHeader TransientCheckpoint::header()
{
  CheckpointHeader header;
  header.kind = "contact_dynamics";
  // 1 had no friction target, 2 no samples for statistics, 3 other snapshots and histories.
  header.version = 4;
  return header;
}

TransientCheckpoint::Record TransientCheckpoint::read(std::string &payload) const
{
  payload = read_checkpoint(file_path, header());
  Record found;
  load_state(payload, found, file_path);
  return found;
}

TransientCheckpoint::Found TransientCheckpoint::look(const std::uint64_t n_steps,
                                                     std::vector<std::string> &states)
{
  if (!std::filesystem::exists(file_path))
    {
      context.log("There is no checkpoint in " + context.output_folder() +
                  ": starting from the beginning");
      return Found::nothing;
    }
  std::string payload;
  record                         = read(payload);
  const CheckpointPosition &done = record.position;
  const std::string differences  = parameter_differences(identity, record.identity);
  if (!differences.empty())
    throw UserError(file_path + " belongs to a run with other parameters: " +
                    differences + "; set them back, or start again without --resume");
  if (done.step > n_steps)
    throw UserError("Time/End time lies before the checkpoint (" + place(done) +
                    "); set a later one, or start again without --resume");
  const bool ended = done.by_limit_cycle || (done.at_end && done.step == n_steps);
  if (ended && std::filesystem::exists(context.file("summary.json")))
    return Found::complete;
  if (record.state_sizes.empty() && !ended)
    throw UserError("the run in " + context.output_folder() + " was complete at " +
                    place(done) +
                    " and did not keep its last state (Checkpoints/Keep); start again "
                    "without --resume to reach a later Time/End time");
  if (record.state_sizes.empty())
    {
      context.log("The results in " + context.output_folder() +
                  " are gone and no state was kept: starting from the beginning");
      return Found::nothing;
    }
  std::size_t at =
    payload.size() - std::accumulate(record.state_sizes.begin(), record.state_sizes.end(),
                                     std::uint64_t(0));
  for (const std::uint64_t size : record.state_sizes)
    {
      states.push_back(payload.substr(at, size));
      at += size;
    }
  return Found::state;
}

TransientCheckpoint::Found TransientCheckpoint::find(const std::uint64_t n_steps)
{
  const MPI_Comm comm = context.communicator();
  std::vector<std::string> states;
  Found found = Found::nothing;
  on_root(comm, [&]() { found = look(n_steps, states); });
  broadcast_object(comm, found);
  broadcast_object(comm, record.position);
  if (found == Found::state)
    own_state = scatter(comm, states);
  return found;
}

void TransientCheckpoint::discard()
{
  on_root(context.communicator(), [&]() {
    if (!std::filesystem::exists(file_path))
      return;
    try
      {
        std::string payload;
        const CheckpointPosition old = read(payload).position;
        if (!old.at_end)
          context.warn("the run that was stopped at " + place(old) +
                       " starts anew; --resume would have continued it");
      }
    catch (const UserError &)
      {
        // Whatever it was, it is not what this run will leave.
      }
    std::filesystem::remove(file_path);
  });
}

bool TransientCheckpoint::due() const
{
  return parameters.interval > 0. && std::chrono::steady_clock::now() - last >=
                                       std::chrono::duration<double>(parameters.interval);
}

void TransientCheckpoint::write_file(const CheckpointPosition &position,
                                     const std::vector<std::string> &states) const
{
  Record now;
  now.identity = identity;
  now.position = position;
  for (const std::string &state : states)
    now.state_sizes.push_back(state.size());
  std::vector<std::string> pieces = {save_state(now)};
  pieces.insert(pieces.end(), states.begin(), states.end());
  write_checkpoint(file_path, header(), pieces);
}

void TransientCheckpoint::write(const CheckpointPosition &position,
                                const std::string &state)
{
  const auto scope                      = context.timer().scope("Checkpoints");
  const std::vector<std::string> states = gather(context.communicator(), state);
  on_root(context.communicator(), [&]() { write_file(position, states); });
  last = std::chrono::steady_clock::now();
}

void TransientCheckpoint::complete(const CheckpointPosition &position)
{
  if (!parameters.keep)
    on_root(context.communicator(), [&]() { write_file(position, {}); });
}
} // namespace mesoslip
