#include "sliding/mesh/distributed_body.h"

#include "base/exchange.h"
#include "dynamics/brick_stepper.h"
#include "dynamics/mesh_stepper.h"

#include <type_traits>

namespace mesoslip
{
namespace
{
/**
 * Cost of the cells in a step, for METIS. Cells at the contact include a share of its
 * nodes; a node costs as much as a quadrilateral or 0.4 hexahedra (measured).
 */
template <int dim>
std::vector<unsigned int> cell_weights(const Mesh<dim> &mesh,
                                       const std::vector<unsigned int> &contact)
{
  constexpr unsigned int of_cell = 10, of_contact = dim == 2 ? 10 : 4;
  std::vector<unsigned int> weights(mesh.cells.size(), of_cell);
  std::vector<bool> touches(mesh.points.size());
  for (const unsigned int point : contact)
    touches[point] = true;
  for (std::size_t k = 0; k < weights.size(); ++k)
    for (const unsigned int v : mesh.cells[k].vertices)
      if (touches[v])
        {
          weights[k] += of_contact;
          break;
        }
  return weights;
}

/** Distributes the cells; returns this rank's part. */
template <int dim>
MeshPart<dim> part_of_mesh(const Mesh<dim> &mesh,
                           const std::vector<unsigned int> &contact,
                           const MPI_Comm communicator)
{
  std::vector<unsigned int> ranks;
  if (!mesh.cells.empty())
    ranks = partition_cells(mesh, mpi::n_mpi_processes(communicator),
                            cell_weights(mesh, contact));
  return distribute(mesh, ranks, communicator);
}

/** A partitioned body on any mesh. */
template <int dim>
class BodyOfCells : public DistributedBody<dim>
{
public:
  BodyOfCells(const Mesh<dim> &mesh,
              const std::vector<unsigned int> &contact,
              const std::vector<ElasticPhase<dim>> &phases,
              const InstructionSet isa,
              const MPI_Comm communicator)
    : own_part(part_of_mesh(mesh, contact, communicator))
    , phases(phases)
    , isa(isa)
    , op(own_part, phases, communicator, isa)
  {
  }

  const MeshPart<dim> &part() const override
  {
    return own_part;
  }

  MPI_Comm communicator() const override
  {
    return op.communicator;
  }

  const std::vector<double> &lumped_mass() const override
  {
    return op.lumped_mass();
  }

  FrequencyEstimate largest_frequency() const override
  {
    return mesoslip::largest_frequency(op);
  }

  std::unique_ptr<SurfaceStepper<dim>>
  make_stepper(const std::vector<HeldComponent> &held,
               const StepParameters &parameters,
               NodalField<double> &u,
               NodalField<double> &w) const override
  {
    std::shared_ptr<const MeshOperator<dim>> damping;
    if (parameters.damps_by_phase())
      damping = std::make_shared<MeshOperator<dim>>(
        own_part, phases_of_damping(phases, parameters), op.communicator, isa);
    return std::make_unique<MeshStepper<dim>>(op, held, parameters, u, w, damping);
  }

private:
  const MeshPart<dim> own_part;
  const std::vector<ElasticPhase<dim>> phases;
  const InstructionSet isa;
  const MeshOperator<dim> op;
};

/** A partitioned box of bricks. */
class BodyOfBricks : public DistributedBody<3>
{
public:
  BodyOfBricks(const BrickBox &box,
               const CellReader &materials,
               const std::vector<MeshPlace> &probes,
               const std::vector<ElasticPhase<3>> &phases,
               const InstructionSet isa,
               const MPI_Comm communicator)
    : phases(phases)
    , isa(isa)
    , op(divide_box(box,
                    materials,
                    static_cast<unsigned int>(phases.size()),
                    communicator,
                    cells_of(probes)),
         phases,
         communicator,
         isa)
  {
    if (phases.size() == 1)
      of_blocks = largest_frequency_of_blocks(box.grid, phases[0], isa);
  }

  const MeshPart<3> &part() const override
  {
    return op.slab().part;
  }

  MPI_Comm communicator() const override
  {
    return op.communicator;
  }

  const std::vector<double> &lumped_mass() const override
  {
    return op.lumped_mass();
  }

  FrequencyEstimate largest_frequency() const override
  {
    return of_blocks ? *of_blocks : mesoslip::largest_frequency(op);
  }

  std::unique_ptr<SurfaceStepper<3>> make_stepper(const std::vector<HeldComponent> &held,
                                                  const StepParameters &parameters,
                                                  NodalField<double> &u,
                                                  NodalField<double> &w) const override
  {
    std::shared_ptr<const BrickOperator> damping;
    if (parameters.damps_by_phase())
      damping = std::make_shared<BrickOperator>(BrickSlab(op.slab()),
                                                phases_of_damping(phases, parameters),
                                                op.communicator, isa);
    return std::make_unique<BrickStepper>(op, held, parameters, u, w, damping);
  }

private:
  static std::vector<unsigned int> cells_of(const std::vector<MeshPlace> &probes)
  {
    std::vector<unsigned int> cells;
    for (const MeshPlace &place : probes)
      cells.push_back(place.cell);
    return cells;
  }

  const std::vector<ElasticPhase<3>> phases;
  const InstructionSet isa;
  const BrickOperator op;
  std::optional<FrequencyEstimate> of_blocks; ///< for a single phase
};
} // namespace

template <int dim>
std::unique_ptr<DistributedBody<dim>>
distribute_mesh(const Mesh<dim> &mesh,
                const std::vector<unsigned int> &contact,
                const std::vector<ElasticPhase<dim>> &phases,
                const InstructionSet isa,
                const MPI_Comm communicator)
{
  return std::make_unique<BodyOfCells<dim>>(mesh, contact, phases, isa, communicator);
}

std::unique_ptr<DistributedBody<3>>
distribute_box(const BrickBox &box,
               const CellReader &materials,
               const std::vector<MeshPlace> &probes,
               const std::vector<ElasticPhase<3>> &phases,
               const InstructionSet isa,
               const MPI_Comm communicator)
{
  return std::make_unique<BodyOfBricks>(box, materials, probes, phases, isa,
                                        communicator);
}

#define MESOSLIP_INSTANTIATE(dim)                                 \
  template std::unique_ptr<DistributedBody<dim>> distribute_mesh( \
    const Mesh<dim> &, const std::vector<unsigned int> &,         \
    const std::vector<ElasticPhase<dim>> &, const InstructionSet, const MPI_Comm);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
