#ifndef mesoslip_sliding_transient_transient_checkpoint_h
#define mesoslip_sliding_transient_transient_checkpoint_h

#include "base/exchange.h"
#include "base/serialize_members.h"
#include "sliding/contact_parameters.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
class RunContext;

/** Position of a run at a checkpoint. */
struct CheckpointPosition
{
  std::uint64_t step      = 0;     ///< steps done
  double time             = 0.;    ///< s
  bool at_end             = false; ///< the run is complete
  bool by_limit_cycle     = false; ///< the run ended at the limit cycle
  std::uint64_t snapshots = 0;     ///< number of snapshots written

  /** Saves or restores the position (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<5>(archive, *this);
  }
};

/**
 * The checkpoint of a transient run in its output folder: one file with run identity,
 * position and the state of each rank. After the run is complete only identity and
 * position are kept, unless Checkpoints/Keep asks for the state as well. Collective;
 * rank 0 reads and writes.
 */
class TransientCheckpoint
{
public:
  /** @p what: lines "key = value" that a run and its continuation have to share. */
  TransientCheckpoint(RunContext &run_context,
                      const CheckpointParameters &p,
                      const std::string &what);

  /** Result of begin(). */
  enum class Found
  {
    nothing,
    state,
    complete ///< the run is complete
  };

  /**
   * Call it before a run up to step @p n_steps. With --resume it looks for a checkpoint
   * to continue from, and returns complete if the run is complete. A run from its start
   * removes the remains of an earlier run in its folder: the checkpoint (with a warning
   * if a run could have continued from it) and the results.
   * @throws UserError if the checkpoint is damaged, of another run, or of a state that
   * cannot be continued
   */
  Found begin(const std::uint64_t n_steps);

  /** After Found::state: restores this rank's part of @p run. */
  template <class Run>
  void restore(Run &run)
  {
    load_state(own_state, run, path);
    own_state = std::string();
  }

  /** Position after Found::state or complete. */
  const CheckpointPosition &position() const
  {
    return record.position;
  }

  /** Whether the checkpoint interval is over, by the clock of the calling rank. */
  bool due() const;

  /** Saves this rank's @p state. */
  void write(const CheckpointPosition &position, const std::string &state);

  /** Call it after summary.json is written: drops the state unless it has to be kept. */
  void complete(const CheckpointPosition &position);

private:
  /** The content of the file. */
  struct Record
  {
    std::string identity;
    CheckpointPosition position;
    std::vector<std::string> states; ///< by rank; empty: not kept

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      serialize_members<3>(archive, *this);
    }
  };

  Found look(const std::uint64_t n_steps);
  Found find(const std::uint64_t n_steps);
  void discard();
  void write_record(const Record &now) const;

  RunContext &context;
  const CheckpointParameters parameters;
  const std::string identity;
  const std::string path;
  Record record; ///< on rank 0; other ranks have the position only
  std::string own_state;
  std::chrono::steady_clock::time_point last;
};
} // namespace mesoslip

#endif
