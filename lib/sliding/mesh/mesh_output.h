#ifndef mesoslip_sliding_mesh_mesh_output_h
#define mesoslip_sliding_mesh_mesh_output_h

#include "io/hdf5_file.h"
#include "observation/contact_statistics.h"
#include "program/run_context.h"
#include "sliding/mesh/mesh_body.h"
#include "sliding/run_plan.h"

#include <optional>

namespace mesoslip
{
/** What a run on a mesh leaves. */
struct MeshResult
{
  ContactHistory history;           ///< of the contact
  TopHistory top;                   ///< of the top
  EnergyHistory energy;             ///< sums over the ranks
  std::vector<NodeCounts> blocks;   ///< states of the contact nodes
  std::vector<ProbeHistory> probes; ///< in the order of the .prm
  double largest_strain    = 0.;    ///< norm [-]
  std::uint64_t steps_done = 0;     ///< in earlier runs, too
  double loop_seconds      = 0.;    ///< in earlier runs, too
  bool interrupted         = false; ///< by a request to stop
  std::string kernel;               ///< what advanced the nodes
};

/**
 * Writes dynamics.h5 of a run on a mesh (doc/file_formats.md), history.csv, energy.csv and
 * dynamics*.xdmf; as an observer it takes the snapshots. Members are called by all ranks
 * unless said otherwise.
 */
template <int dim>
class MeshOutput : public StepObserver
{
public:
  /** All arguments must outlive it. @p morphology: of rank 0. */
  MeshOutput(RunContext &context,
             const ContactParameters &parameters,
             const MeshMorphology<dim> &morphology,
             const MeshBodyDescription &body,
             const TimeStepChoice &time,
             const MeshPart<dim> &part);

  /** Whether the run takes any. */
  bool has_snapshots() const
  {
    return !steps.empty();
  }

  /** Snapshots written so far. */
  std::uint64_t n_snapshots() const
  {
    return n_written;
  }

  /** Creates the file, or goes on with that which has @p n_done snapshots. */
  void begin(const Stepper &of_stepper, const std::uint64_t n_done);

  std::uint64_t next_step(const std::uint64_t n) const override;
  void before_step(const std::uint64_t n) override;

  /** On rank 0: the snapshots are on the disk. */
  void sync();

  /** On rank 0: everything else, once. */
  void write(const MeshResult &result);

  /** On rank 0: keys of summary.json. */
  void summarize(const MeshResult &result) const;

private:
  std::vector<double> whole_displacement() const;
  void write_contact(const MeshResult &result);
  void write_blocks(const MeshResult &result);
  double steady_from(const MeshResult &result) const; ///< begin of the second half (s)
  ContactSummary summary_of(const MeshResult &result) const;

  RunContext &context;
  const ContactParameters &parameters;
  const MeshMorphology<dim> &morphology;
  const MeshBodyDescription &body;
  const TimeStepChoice &time;
  const MeshPart<dim> &part;
  const Stepper *stepper = nullptr;
  std::vector<std::uint64_t> steps; ///< of the snapshots
  std::uint64_t n_written = 0;
  std::optional<Hdf5File> file; ///< on rank 0
};
} // namespace mesoslip

#endif
