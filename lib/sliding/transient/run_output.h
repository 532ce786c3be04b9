#ifndef mesoslip_sliding_transient_run_output_h
#define mesoslip_sliding_transient_run_output_h

#include "dynamics/stepper.h"
#include "io/parallel_rows.h"
#include "sliding/given_body.h"
#include "sliding/transient/contact_map_output.h"
#include "sliding/transient/run_needs.h"
#include "sliding/transient/transient_result.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * dynamics.h5 of a run with its companions dynamics.xdmf (snapshots), history.csv and
 * energy.csv. Snapshots are observed and written to dynamics.h5.part as the run goes on, by all ranks;
 * everything else at its end. Members are called by all ranks unless said otherwise.
 */
template <int dim>
class RunOutput : public StepObserver
{
public:
  /** Snapshots are those that the parameters of the @p body ask for; references are kept. */
  RunOutput(RunContext &context,
            const GivenBody<dim> &body,
            const TimeStepChoice &time,
            const std::function<FieldRows()> &displacement);

  /** Whether the run has snapshots. */
  bool has_snapshots() const
  {
    return !steps.empty();
  }

  /** Snapshots written so far. */
  std::uint64_t n_snapshots() const
  {
    return n_written;
  }

  /**
   * Makes place for the snapshots of a run at step @p step, of which the first @p n_done are in the
   * file already, of the run that is continued, and for @p map (may be null).
   * @throws UserError if they are not
   */
  void
  begin(const std::uint64_t step, const std::uint64_t n_done, ContactMapOutput<dim> *map);

  /** The first step >= @p n before which a snapshot is taken. */
  std::uint64_t next_step(const std::uint64_t n) const override;

  /** Writes a snapshot. */
  void before_step(const std::uint64_t n) override;

  /** Waits until the snapshots are on the disk. */
  void sync();

  /** There are no more snapshots. */
  void end();

  /** On rank 0, after end(): writes everything else, once, replacing what was there; @p map may
   * be null. */
  void write(const TransientResult &result, const ContactMapOutput<dim> *map);

private:
  /** Rank 0 begins the file, or goes on with it. */
  void open(const bool resumed);
  void write_phases();
  Shape snapshots_shape(const std::size_t n) const;
  std::vector<double> snapshot_times() const;

  RunContext &context;
  const GivenBody<dim> &body;
  const TimeStepChoice &time;
  const std::function<FieldRows()> displacement;
  const std::vector<std::uint64_t> steps; ///< of all snapshots, those to come as well
  const std::string path;                 ///< of the file
  std::uint64_t n_written = 0;            ///< see n_snapshots()
  std::optional<Hdf5File> file;           ///< on rank 0, but not while all write rows

  /** Between begin() and end(), by dataset: those that all ranks write. */
  std::map<std::string, std::unique_ptr<ParallelRows>> rows;
};
} // namespace mesoslip

#endif
