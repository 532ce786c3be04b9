#ifndef mesoslip_sliding_transient_dynamics_output_h
#define mesoslip_sliding_transient_dynamics_output_h

#include "exchange/dynamics_file.h"
#include "sliding/transient/transient_summary.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace mesoslip
{
class RunContext;

/**
 * dynamics.h5 of a run with its companions dynamics.xdmf (snapshots), history.csv and
 * energy.csv. Snapshots are written to dynamics.h5.part as the run goes on, everything
 * else at its end. For rank 0 only.
 */
class DynamicsOutput
{
public:
  /** References are kept. */
  DynamicsOutput(RunContext &context,
                 const ContactParameters &parameters,
                 const BodyDescription &body);

  /**
   * Makes place for snapshots at @p times (s), of which the first @p n_done are in the
   * file already, of the run that is continued. @throws UserError if they are not.
   */
  void begin_snapshots(const std::vector<double> &times, const std::uint64_t n_done);

  /** Writes the displacement @p u (m) at the next of the times. */
  void add_snapshot(const NodalField<double> &u);

  /** Waits until the snapshots are on the disk; returns their number. */
  std::uint64_t save_snapshots();

  /** Writes dynamics.h5 and its companions, replacing older ones. */
  void write(const TransientObservations &observed, const TransientSummary &summary);

private:
  void write_history(const TransientObservations &observed,
                     const TransientSummary &summary);
  void write_energy(const EnergyHistory &energy);
  void write_probe(const std::string &group, const ProbeHistory &probe);
  void write_reference_node(const TransientObservations &observed);
  void write_contact(const TransientObservations &observed,
                     const TransientSummary &summary);
  void write_blocks(const TransientObservations &observed);

  RunContext &context;
  const ContactParameters &parameters;
  const BodyDescription &body;
  std::optional<DynamicsFile> file;
  std::vector<double> snapshot_times; ///< of all that are to be written (s)
  std::size_t n_snapshots = 0;        ///< written so far
};
} // namespace mesoslip

#endif
