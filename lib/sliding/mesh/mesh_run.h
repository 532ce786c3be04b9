#ifndef mesoslip_sliding_mesh_mesh_run_h
#define mesoslip_sliding_mesh_mesh_run_h

#include "dynamics/stability_monitor.h"
#include "program/run_context.h"
#include "sliding/mesh/mesh_output.h"
#include "sliding/run_plan.h"
#include "sliding/transient/run_statistics.h"

namespace mesoslip
{
/**
 * One run of a body on a mesh: SlidingMesh, its observers, and when what is saved, as
 * TransientRun on a grid. All ranks call the members.
 */
template <int dim>
class MeshRun
{
public:
  /** The initial state; all arguments must outlive it. */
  MeshRun(const ContactParameters &parameters,
          const MeshBodyDescription &description,
          const BodyScales &scales,
          const TimeStepChoice &time,
          const DistributedBody<dim> &distributed,
          const std::vector<ElasticPhase<dim>> &phases,
          TransientCheckpoint &checkpoint,
          MeshOutput<dim> &output,
          RunContext &context);

  /** Takes over the state in the checkpoint. */
  void restore();

  /** Goes on until End time, the limit cycle or a request to stop, after which the state is in the
   * checkpoint. @throws NumericalFailure */
  TransientResult run();

  /** The map of the contact; null without one. */
  const ContactMapOutput<dim> *contact_map() const
  {
    return map.get();
  }

  /** Where the run stands. */
  CheckpointPosition position() const;

  /** State between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &body &monitor &strains &probes &statistics &seconds;
  }

private:
  void set_initial_velocity();
  void judge(const Deformation &found, const std::uint64_t n);
  bool control(const std::uint64_t n);
  void save();
  TransientResult collect();

  const ContactParameters &parameters;
  const MeshBodyDescription &description;
  const BodyScales &scales;
  const TimeStepChoice &time;
  const MeshPart<dim> &part;
  TransientCheckpoint &checkpoint;
  MeshOutput<dim> &output;
  RunContext &context;
  const BodySize size;
  SlidingMesh<dim> body;
  StabilityMonitor monitor;
  DeformationWatch strains;
  MeshProbes<dim> probes;
  RunStatistics<dim> statistics;
  std::unique_ptr<ContactMapOutput<dim>> map;
  bool warned         = false; ///< of large strains
  bool interrupted    = false;
  bool at_limit_cycle = false;
  double seconds      = 0.; ///< in the time loop, in earlier runs, too
};
} // namespace mesoslip

#endif
