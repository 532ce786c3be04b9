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
 * dynamics.h5 of a run and its companions dynamics.xdmf (snapshots), history.csv and
 * energy.csv. All ranks write snapshots to dynamics.h5.part during the run; everything
 * else is written at its end. Members are collective unless documented otherwise.
 */
template <int dim>
class RunOutput
{
public:
  /** Takes the snapshots that the parameters of @p body ask for; references are kept. */
  RunOutput(RunContext &context,
            const GivenBody<dim> &body,
            const TimeStepChoice &time,
            const std::function<FieldRows()> &displacement);

  /**
   * Reserves space for snapshots and @p map (may be null) of a run at step @p step; the
   * first @p n_done snapshots are already in the file of the continued run.
   * @throws UserError if they are missing
   */
  void
  begin(const std::uint64_t step, const std::uint64_t n_done, ContactMapOutput<dim> *map);

  /** Waits until the snapshots are on the disk. */
  void sync();

  /** Ends the snapshots. */
  void end();

  /** On rank 0, after end(): writes all remaining data once and replaces earlier files;
   * @p map may be null. With --summary-only nothing is written, and there are neither
   * snapshots nor a map. */
  void write(const TransientResult &result, const ContactMapOutput<dim> *map);

  Snapshots<dim> snapshots; ///< snapshots of the body

private:
  void write_phases();
  bool writes_files() const;

  RunContext &context;
  const GivenBody<dim> &body;
  const TimeStepChoice &time;
  const std::string path;       ///< path of dynamics.h5
  std::optional<Hdf5File> file; ///< on rank 0, closed while all ranks write rows
  bool all_write = false;       ///< between begin() and end(), if there are rows to write

  /** Rows of the contact map by dataset, between begin() and end(). */
  std::map<std::string, std::unique_ptr<ParallelRows>> rows;
};
} // namespace mesoslip

#endif
