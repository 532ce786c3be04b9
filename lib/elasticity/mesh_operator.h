#ifndef mesoslip_elasticity_mesh_operator_h
#define mesoslip_elasticity_mesh_operator_h

#include "elasticity/element_operator.h"
#include "mesh/shared_points.h"

#include <vector>

namespace mesoslip
{
/**
 * Stiffness and lumped mass of a partitioned mesh. Each rank multiplies with its own
 * cells, beginning with cells that have points shared with other ranks or periodic points
 * (see Mesh::masters); the sums at these points overlap with the work on the remaining
 * cells.
 *
 * Fields are those of ElementOperator on all points of the part, ghost points included;
 * shared points have the same bits on all their ranks.
 */
template <int dim>
class MeshOperator
{
public:
  /** Keeps a reference to @p part; @p phases must cover all its cells. Collective. */
  MeshOperator(const MeshPart<dim> &part,
               const std::vector<ElasticPhase<dim>> &phases,
               const MPI_Comm communicator,
               const InstructionSet isa = InstructionSet::automatic);

  /** A zero displacement (m) or force (N, in 2D N/m). */
  LineVector<double> zero_field() const
  {
    return elements.zero_field();
  }

  /**
   * Sums the contributions at shared points and at periodic copies and masters.
   * Collective.
   */
  void sum_up(double *field) const
  {
    shared.start(field);
    shared.finish(field);
  }

  /**
   * @p f += K @p u; contributions already in @p f at shared points are summed, too.
   * Collective.
   */
  void add_product(double *f, const double *u) const;

  /** See ElementOperator::advance(). */
  void advance(const kernels::NodeArrays &nodes, const kernels::NodeStep &step) const
  {
    elements.advance(nodes, step);
  }

  /** Row sums of the mass matrix, one per point (kg, in 2D kg/m). */
  const std::vector<double> &lumped_mass() const
  {
    return mass;
  }

  /** Instruction set, and how many cells share their matrix on this rank. */
  std::string kernel_name() const;

  const MeshPart<dim> &part;   ///< points and cells of this rank
  const MPI_Comm communicator; ///< ranks that share the mesh

private:
  const InstructionSet isa;
  const ElementOperator<dim> elements; ///< part 0: cells with shared points
  mutable SharedPoints<dim> shared;    ///< holds messages in flight
  std::vector<double> mass;
};
} // namespace mesoslip

#endif
