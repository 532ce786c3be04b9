#ifndef mesoslip_sliding_mesh_mesh_output_h
#define mesoslip_sliding_mesh_mesh_output_h

#include "io/parallel_rows.h"
#include "mesh/point_blocks.h"
#include "program/run_context.h"
#include "sliding/mesh/mesh_body.h"
#include "sliding/transient/contact_map_output.h"
#include "sliding/transient/transient_result.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace mesoslip
{
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

  /** Creates the file, or goes on with that which has @p n_done snapshots; with place for
   * @p map, which may be null. */
  void begin(const Stepper &of_stepper,
             const std::uint64_t n_done,
             ContactMapOutput<dim> *map);

  std::uint64_t next_step(const std::uint64_t n) const override;
  void before_step(const std::uint64_t n) override;

  /** The snapshots are on the disk. */
  void sync();

  /** There are no more snapshots. */
  void end();

  /** On rank 0, after end(): everything else, once. */
  void write(const TransientResult &result, const ContactMapOutput<dim> *map);

private:
  void write_contact();
  Shape snapshots_shape(const std::size_t n) const;

  RunContext &context;
  const MeshMorphology<dim> &morphology;
  const MeshBodyDescription &body;
  const TimeStepChoice &time;
  const MeshPart<dim> &part;
  const Stepper *stepper = nullptr;
  std::vector<std::uint64_t> steps; ///< of the snapshots
  std::uint64_t n_written = 0;
  std::optional<Hdf5File> file; ///< on rank 0, but not while all write snapshots

  /** Between begin() and end(), if there are snapshots. */
  std::optional<ParallelRows> rows;
  std::optional<PointBlocks<dim>> blocks; ///< see rows
  std::size_t n_together = 1; ///< points in a row of the second axis of the file
  std::map<std::string, std::unique_ptr<ParallelRows>> map_rows; ///< by dataset
};
} // namespace mesoslip

#endif
