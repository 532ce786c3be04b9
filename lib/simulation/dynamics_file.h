#ifndef mesoslip_simulation_dynamics_file_h
#define mesoslip_simulation_dynamics_file_h

#include "grid/nodal_field.h"
#include "simulation/scene.h"
#include "simulation/transient.h"
#include "simulation/transient_summary.h"

#include <string>
#include <vector>

namespace mesoslip
{
class Hdf5File;
class RunContext;

/**
 * dynamics.h5 of a run with its companions dynamics.xdmf (snapshots), history.csv and
 * energy.csv. Snapshots are written when they come, everything else at the end. Does
 * nothing on ranks other than 0.
 */
class DynamicsFile
{
public:
  DynamicsFile(RunContext &context, const ContactParameters &parameters, const Scene &scene);
  ~DynamicsFile();

  /** Appends the displacement (m) at time @p time (s). */
  void
  add_snapshot(const double time, const NodalField<double> &u);

  /** Writes the rest and gives the file its name. */
  void
  write(const TransientObservations &observed, const TransientSummary &summary);

private:
  void
  write_history(const TransientObservations &observed, const TransientSummary &summary);
  void
  write_energy(const EnergyHistory &energy);
  void
  write_probes(const TransientObservations &observed);
  void
  write_contact(const TransientObservations &observed, const TransientSummary &summary);
  void
  write_evaluation(const TransientSummary &summary);
  void
  write_column(const std::string         &name,
               const std::vector<double> &values,
               const std::string         &unit);

  RunContext                &context;
  const ContactParameters   &parameters;
  const Scene               &scene;
  std::unique_ptr<Hdf5File>  file;
  std::vector<double>        snapshot_times;
};
} // namespace mesoslip

#endif
