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
/** What each rank has of a body that is advanced in time, and how. */
template <int dim>
class DistributedBody
{
public:
  virtual ~DistributedBody() = default;

  /** Points and cells of this rank. */
  virtual const MeshPart<dim> &part() const = 0;

  /** Of the ranks that share the body. */
  virtual MPI_Comm communicator() const = 0;

  /** Of the points of the part (kg, in 2D kg/m). */
  virtual const std::vector<double> &lumped_mass() const = 0;

  /** Largest frequency of M^-1 K. Collective. */
  virtual FrequencyEstimate largest_frequency() const = 0;

  /** A stepper for these fields, which like this must outlive it; see MeshStepper.
   * Collective. */
  virtual std::unique_ptr<SurfaceStepper<dim>>
  make_stepper(const std::vector<HeldComponent> &held,
               const StepParameters &parameters,
               NodalField<double> &u,
               NodalField<double> &w) const = 0;
};

/** Divides the @p mesh that rank 0 has among the ranks by METIS, where cells at the points of the @p contact
 * weigh more. Collective. */
template <int dim>
std::unique_ptr<DistributedBody<dim>>
distribute_mesh(const Mesh<dim> &mesh,
                const std::vector<unsigned int> &contact,
                const std::vector<ElasticPhase<dim>> &phases,
                const InstructionSet isa,
                const MPI_Comm communicator);

/** Divides a box of bricks, which all ranks have, by layers; the part has no cells but those of the @p
 * probes. Collective. @throws UserError for more ranks than layers of cells, or if these cannot be read */
std::unique_ptr<DistributedBody<3>>
distribute_box(const BrickBox &box,
               const CellReader &materials,
               const std::vector<MeshPlace> &probes,
               const std::vector<ElasticPhase<3>> &phases,
               const InstructionSet isa,
               const MPI_Comm communicator);
} // namespace mesoslip

#endif
