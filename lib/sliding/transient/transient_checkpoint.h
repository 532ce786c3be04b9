#ifndef mesoslip_sliding_transient_transient_checkpoint_h
#define mesoslip_sliding_transient_transient_checkpoint_h

#include "base/serialize_members.h"
#include "io/checkpoint.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
class RunContext;

/** Section Checkpoints. */
struct CheckpointParameters
{
  double interval = 0.;    ///< s of wall-clock time; 0: only when the run is stopped
  bool keep       = false; ///< do not delete it when the run has ended
};

/** Where a run stands when its state is saved. */
struct CheckpointPosition
{
  std::uint64_t step = 0;  ///< steps done
  double time        = 0.; ///< s
  /** Nothing follows: End time or, with Stop at limit cycle, the limit cycle. */
  bool at_end             = false;
  bool by_limit_cycle     = false; ///< it ended at the limit cycle
  std::uint64_t snapshots = 0;     ///< written so far

  /** Of boost::serialization. */
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
  /**
   * @p what: lines "key = value" in which the runs before and after have to agree.
   */
  TransientCheckpoint(RunContext &run_context,
                      const CheckpointParameters &p,
                      const std::string &what);

  /** Kind and version of the file. */
  static CheckpointHeader header();

  /** What a resumed run finds. */
  enum class Found
  {
    nothing,
    state,
    complete ///< the results are there
  };

  /**
   * Looks for a checkpoint to continue up to step @p n_steps.
   * @throws UserError: it is damaged, of another run, or there is no way on from it
   */
  Found find(const std::uint64_t n_steps);

  /** With Found::state: of this rank. */
  std::string take_state()
  {
    return std::move(own_state);
  }

  /** With Found::state or complete. */
  const CheckpointPosition &position() const
  {
    return record.position;
  }

  /** For messages. */
  const std::string &path() const
  {
    return file_path;
  }

  /** Before a run begins anew: removes a checkpoint, with a warning if one could have
   * gone on from it. */
  void discard();

  /** Whether the interval since the last one is over; by the clock of the calling rank.
   */
  bool due() const;

  /** Saves this rank's @p state. */
  void write(const CheckpointPosition &position, const std::string &state);

  /** After summary.json was written: drops the state unless it is to be kept. */
  void complete(const CheckpointPosition &position);

private:
  /** What precedes the states in the file. */
  struct Record
  {
    std::string identity;
    CheckpointPosition position;
    std::vector<std::uint64_t> state_sizes; ///< bytes, by rank; empty: none kept

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      serialize_members<3>(archive, *this);
    }
  };

  Found look(const std::uint64_t n_steps, std::vector<std::string> &states);
  Record read(std::string &payload) const;
  void write_file(const CheckpointPosition &position,
                  const std::vector<std::string> &states) const;

  RunContext &context;
  const CheckpointParameters parameters;
  const std::string identity;
  const std::string file_path;
  Record record;
  std::string own_state;
  std::chrono::steady_clock::time_point last;
};
} // namespace mesoslip

#endif
