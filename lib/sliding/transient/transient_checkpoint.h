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

/** Where a run stands when its state is saved. */
struct CheckpointPosition
{
  std::uint64_t step      = 0;     ///< steps done
  double time             = 0.;    ///< s
  bool at_end             = false; ///< nothing follows: End time, or it ended as below
  bool by_limit_cycle     = false; ///< it ended at the limit cycle
  std::uint64_t snapshots = 0;     ///< written so far

  /** Saves or restores the position (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<5>(archive, *this);
  }
};

/**
 * The checkpoint of a transient run in its output folder: one file with what identifies
 * the run, where it stands, and the state of each rank. Once the run is complete only the
 * first two are left, unless Checkpoints/Keep asks for the state as well. Members are
 * called by all ranks; rank 0 reads and writes.
 */
class TransientCheckpoint
{
public:
  /** @p what: lines "key = value" in which the runs before and after have to agree. */
  TransientCheckpoint(RunContext &run_context,
                      const CheckpointParameters &p,
                      const std::string &what);

  /** What a run finds. */
  enum class Found
  {
    nothing,
    state,
    complete ///< the results are there
  };

  /**
   * Before a run up to step @p n_steps. With --resume it looks for a checkpoint to continue,
   * and says so if the run is complete. A run that begins at its start removes what an earlier
   * one left in its folder: the checkpoint, with a warning if one could have gone on from it,
   * and the results.
   * @throws UserError: the checkpoint is damaged, of another run, or there is no way on from it
   */
  Found begin(const std::uint64_t n_steps);

  /** With Found::state: restores this rank's part of @p run. */
  template <class Run>
  void restore(Run &run)
  {
    load_state(own_state, run, path);
    own_state = std::string();
  }

  /** With Found::state or complete. */
  const CheckpointPosition &position() const
  {
    return record.position;
  }

  /** Whether the interval since the last one is over; by the clock of the calling rank.
   */
  bool due() const;

  /** Saves this rank's @p state. */
  void write(const CheckpointPosition &position, const std::string &state);

  /** After summary.json was written: drops the state unless it is to be kept. */
  void complete(const CheckpointPosition &position);

private:
  /** The content of the file. */
  struct Record
  {
    std::string identity;
    CheckpointPosition position;
    std::vector<std::string> states; ///< by rank; empty: none kept

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
  Record record; ///< on rank 0; elsewhere only the position
  std::string own_state;
  std::chrono::steady_clock::time_point last;
};
} // namespace mesoslip

#endif
