#ifndef mesoslip_sliding_mesh_distributed_body_h
#define mesoslip_sliding_mesh_distributed_body_h

#include "dynamics/critical_time_step.h"
#include "dynamics/surface_stepper.h"
#include "grid/brick_box.h"
#include "grid/cell_reader.h"
#include "grid/instruction_set.h"
#include "observation/mesh_probes.h"

#include <memory>
#include <vector>

namespace mesoslip
{
/** The part of a body on this rank, with its time integration. */
template <int dim>
class DistributedBody
{
public:
  virtual ~DistributedBody() = default;

  /** Points and cells of this rank's part. */
  virtual const MeshPart<dim> &part() const = 0;

  /** Ranks that share the body. */
  virtual MPI_Comm communicator() const = 0;

  /** Lumped masses of the points of the part (kg, in 2D kg/m). */
  virtual const std::vector<double> &lumped_mass() const = 0;

  /** Largest frequency of M^-1 K. Collective. */
  virtual FrequencyEstimate largest_frequency() const = 0;

  /** A stepper for the fields @p u and @p w, which like this object must outlive it; see
   * MeshStepper. Collective. */
  virtual std::unique_ptr<SurfaceStepper<dim>>
  make_stepper(const std::vector<HeldComponent> &held,
               const StepParameters &parameters,
               NodalField<double> &u,
               NodalField<double> &w) const = 0;
};

/** Partitions the @p mesh of rank 0 by METIS; cells at the points of the @p contact weigh
 * more. Collective. */
template <int dim>
std::unique_ptr<DistributedBody<dim>>
distribute_mesh(const Mesh<dim> &mesh,
                const std::vector<unsigned int> &contact,
                const std::vector<ElasticPhase<dim>> &phases,
                const InstructionSet isa,
                const MPI_Comm communicator);

/** Partitions a box of bricks, replicated on all ranks, by layers; the part stores only
 * the cells of the @p probes. Collective.
 * @throws UserError for more ranks than layers of cells, or if cells cannot be read */
std::unique_ptr<DistributedBody<3>>
distribute_box(const BrickBox &box,
               const CellReader &materials,
               const std::vector<MeshPlace> &probes,
               const std::vector<ElasticPhase<3>> &phases,
               const InstructionSet isa,
               const MPI_Comm communicator);
} // namespace mesoslip

#endif
