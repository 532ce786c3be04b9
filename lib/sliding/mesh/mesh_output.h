#ifndef mesoslip_sliding_mesh_mesh_output_h
#define mesoslip_sliding_mesh_mesh_output_h

#include "io/parallel_rows.h"
#include "mesh/point_blocks.h"
#include "sliding/mesh/mesh_body.h"
#include "sliding/transient/run_output.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace mesoslip
{
/** Of a mesh or a box, whose fields all ranks write. */
template <int dim>
class MeshOutput : public RunOutput<dim>
{
public:
  /** References are kept. @p morphology: of rank 0. */
  MeshOutput(RunContext &context,
             const ContactParameters &parameters,
             const MeshMorphology<dim> &morphology,
             const MeshBodyDescription &body,
             const TimeStepChoice &time,
             const MeshPart<dim> &part);

  void begin(const Stepper &of_stepper,
             const std::uint64_t n_done,
             ContactMapOutput<dim> *map) override;
  void before_step(const std::uint64_t n) override;
  void sync() override;
  void end() override;
  void write(const TransientResult &result, const ContactMapOutput<dim> *map) override;

private:
  using RunOutput<dim>::context;
  using RunOutput<dim>::has_snapshots;
  using RunOutput<dim>::n_written;
  using RunOutput<dim>::steps;
  using RunOutput<dim>::stepper;
  using RunOutput<dim>::time;

  void write_contact();
  Shape snapshots_shape(const std::size_t n) const;

  const MeshMorphology<dim> &morphology;
  const MeshBodyDescription &body;
  const MeshPart<dim> &part;
  std::optional<Hdf5File> file; ///< on rank 0, but not while all write snapshots

  /** Between begin() and end(), if there are snapshots. */
  std::optional<ParallelRows> rows;
  std::optional<PointBlocks<dim>> blocks; ///< see rows
  std::size_t n_together = 1; ///< points in a row of the second axis of the file
  std::map<std::string, std::unique_ptr<ParallelRows>> map_rows; ///< by dataset
};
} // namespace mesoslip

#endif
