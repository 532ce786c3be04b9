#ifndef mesoslip_simulation_dynamics_file_h
#define mesoslip_simulation_dynamics_file_h

#include "grid/nodal_field.h"
#include "simulation/scene.h"
#include "simulation/transient.h"
#include "simulation/transient_summary.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
class Hdf5File;
class RecordFile;
class RunContext;

/**
 * dynamics.h5 of a run with its companions dynamics.xdmf (snapshots), history.csv and
 * energy.csv. Snapshots wait in snapshots.part, which survives whatever ends the run;
 * everything is written at the end. Does nothing on ranks other than 0.
 */
class DynamicsFile
{
public:
  /** @p snapshots of them are there already, of the run that is continued. */
  DynamicsFile(RunContext &context,
               const ContactParameters &parameters,
               const Scene &scene,
               const std::uint64_t snapshots);
  ~DynamicsFile();

  /** Appends the displacement (m) at time @p time (s). */
  void add_snapshot(const double time, const NodalField<double> &u);

  /** Waits until the snapshots are on the disk; returns their number. */
  std::uint64_t save_snapshots();

  /** Writes dynamics.h5 and its companions, replacing older ones. */
  void write(const TransientObservations &observed, const TransientSummary &summary);

  /** Removes snapshots.part. */
  void remove_snapshots();

private:
  void write_conditions(const TransientObservations &observed);
  void write_history(const TransientObservations &observed,
                     const TransientSummary &summary);
  void write_energy(const EnergyHistory &energy);
  void write_probes(const TransientObservations &observed);
  void write_contact(const TransientObservations &observed,
                     const TransientSummary &summary);
  void write_evaluation(const TransientSummary &summary);
  void write_snapshots();
  void write_column(const std::string &name,
                    const std::vector<double> &values,
                    const std::string &unit);

  RunContext &context;
  const ContactParameters &parameters;
  const Scene &scene;
  std::unique_ptr<Hdf5File> file;
  std::unique_ptr<RecordFile> snapshots;
};
} // namespace mesoslip

#endif
