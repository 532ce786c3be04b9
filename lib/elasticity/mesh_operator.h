#ifndef mesoslip_elasticity_mesh_operator_h
#define mesoslip_elasticity_mesh_operator_h

#include "elasticity/element_operator.h"
#include "mesh/shared_points.h"

#include <vector>

namespace mesoslip
{
/**
 * Stiffness and lumped mass of a mesh that is divided among ranks. Each rank multiplies
 * with its own cells, first with those that have points that other ranks have or that move
 * with others (see Mesh::originals): while these are
 * summed up it goes on with the others.
 *
 * Fields are those of ElementOperator on the points of the part, whoever owns them; on
 * points of several ranks they have the same bits on all of them.
 */
template <int dim>
class MeshOperator
{
public:
  /** @p part is referenced; @p phases must describe all its cells. Collective. */
  MeshOperator(const MeshPart<dim> &part,
               const std::vector<ElasticPhase<dim>> &phases,
               const MPI_Comm communicator,
               const InstructionSet isa = InstructionSet::automatic);

  /** Of zeros: a displacement (m) or force (N, in 2D N/m). */
  LineVector<double> zero_field() const
  {
    return elements.zero_field();
  }

  /** Replaces the terms at points of several ranks, or that move together, by their sums.
   * Collective. */
  void sum_up(double *field) const
  {
    shared.start(field);
    shared.finish(field);
  }

  /** @p f += K @p u, where the terms that @p f has at points of several ranks are added
   * up, too. Collective. */
  void add_product(double *f, const double *u) const;

  /** See ElementOperator. */
  void advance(const kernels::NodeArrays &nodes, const kernels::NodeStep &step) const
  {
    elements.advance(nodes, step);
  }

  /** Row sums of the mass matrix (kg, in 2D kg/m), one for each point. */
  const std::vector<double> &lumped_mass() const
  {
    return mass;
  }

  /** Instruction set, and how many cells share their matrix on this rank. */
  std::string kernel_name() const;

  const MeshPart<dim> &part;   ///< points and cells of this rank
  const MPI_Comm communicator; ///< of the ranks that share the mesh

private:
  const InstructionSet isa;
  const ElementOperator<dim> elements; ///< part 0: cells with points of other ranks
  mutable SharedPoints<dim> shared;    ///< keeps messages that are under way
  std::vector<double> mass;
};
} // namespace mesoslip

#endif
