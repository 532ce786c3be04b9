#ifndef mesoslip_sliding_transient_run_output_h
#define mesoslip_sliding_transient_run_output_h

#include "sliding/given_body.h"
#include "sliding/transient/contact_map_output.h"
#include "sliding/transient/run_needs.h"
#include "sliding/transient/snapshots.h"
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
class RunOutput
{
public:
  /** Snapshots are those that the parameters of the @p body ask for; references are kept. */
  RunOutput(RunContext &context,
            const GivenBody<dim> &body,
            const TimeStepChoice &time,
            const std::function<FieldRows()> &displacement);

  /**
   * Makes place for the snapshots of a run at step @p step, of which the first @p n_done are in the
   * file already, of the run that is continued, and for @p map (may be null).
   * @throws UserError if they are not
   */
  void
  begin(const std::uint64_t step, const std::uint64_t n_done, ContactMapOutput<dim> *map);

  /** Waits until the snapshots are on the disk. */
  void sync();

  /** There are no more snapshots. */
  void end();

  /** On rank 0, after end(): writes everything else, once, replacing what was there; @p map may
   * be null. With --summary-only it writes nothing, and there are neither snapshots nor a map. */
  void write(const TransientResult &result, const ContactMapOutput<dim> *map);

  Snapshots<dim> snapshots; ///< of the body

private:
  void write_phases();
  bool writes_files() const;

  RunContext &context;
  const GivenBody<dim> &body;
  const TimeStepChoice &time;
  const std::string path;       ///< of the file
  std::optional<Hdf5File> file; ///< on rank 0, but not while all write rows
  bool all_write = false;       ///< between begin() and end(), if there are rows to write

  /** Between begin() and end(), by dataset: those of the map. */
  std::map<std::string, std::unique_ptr<ParallelRows>> rows;
};
} // namespace mesoslip

#endif
