#ifndef mesoslip_body_mesh_mesh_discretization_h
#define mesoslip_body_mesh_mesh_discretization_h

#include "body/elastic_body.h"
#include "body/mesh/distributed_matrix.h"
#include "body/mesh/mesh_share.h"

#include <map>

namespace mesoslip
{
/**
 * Stiffness and mass of a mesh that is divided among the ranks. The degrees of freedom of duplicate
 * nodes are constrained to those of their originals; in vectors they are zero.
 *
 * For the few files that work with it: its headers take long to compile.
 */
template <int dim>
class MeshDiscretization
{
public:
  using Vector = DistributedVector;               ///< owned degrees of freedom
  using Index  = dealii::types::global_dof_index; ///< a degree of freedom

  /** Of @p body only layout and phases are used. Collective. */
  MeshDiscretization(MeshShare<dim> &&share, const ElasticBody<dim> &body);

  /** What ML needs. @throws UserError if there are fewer cells than ranks */
  void require_cells() const
  {
    distributed->require_cells();
  }

  /** K (N/m) with the rows of duplicates added to those of their originals. */
  const DistributedMatrix &stiffness() const
  {
    return matrix;
  }

  /** The same of phase_to_precondition(), which is K where no phase has mean dilatation. */
  const DistributedMatrix &to_precondition() const
  {
    return is_apart ? gentle : matrix;
  }

  /** Whether to_precondition() is another matrix than stiffness(). */
  bool has_two_matrices() const
  {
    return is_apart;
  }

  /** Row sums of the consistent mass matrix (kg, in 2D kg/m). */
  const Vector &lumped_mass() const
  {
    return mass;
  }

  /** Degree of freedom of component @p c of a node of fields, of duplicates that of the
   * original. */
  Index dof(const unsigned int c, const NodeIndex &node) const
  {
    return dofs[entry(c, node)];
  }

  /** Number of degrees of freedom, duplicates included. */
  Index n_dofs() const
  {
    return distributed->dofs().n_dofs();
  }

  /** The owned part of a field. */
  Vector to_vector(const NodalField<double> &field) const;

  /** The same of what @p mask constrains, elsewhere zero. */
  Vector to_vector(const NodalField<double> &field, const DofMask &mask) const;

  /** For each owned degree of freedom whether it is a duplicate or @p mask constrains it. */
  std::vector<bool> held_by(const DofMask &mask) const;

  /** The nodes of fields on this rank, with duplicates. Collective. */
  void to_field(NodalField<double> &field, const Vector &vector) const;

private:
  std::size_t entry(const unsigned int c, const NodeIndex &node) const
  {
    return dim * (static_cast<std::size_t>(node.j) * body.n_columns() + node.i) + c;
  }

  /** Calls action(place in owned vectors, c, node) where fields have what this rank owns. */
  template <typename Action>
  void for_each_owned(const Action &action) const;

  void find_places(const std::map<Index, Index> &originals);
  void assemble();

  const ElasticBody<dim> &body;
  const std::unique_ptr<const DistributedMesh<dim>> distributed;
  dealii::AffineConstraints<double> constraints;
  std::vector<Index> dofs; ///< dim for each node of fields, see dof()

  static constexpr int nowhere =
    -1;                      ///< where a node is a duplicate or another rank owns it
  std::vector<int> in_owned; ///< places of dofs in a Vector
  std::vector<unsigned int> in_needed; ///< places of dofs in needed
  mutable Vector needed;               ///< all that fields have
  const bool is_apart;                 ///< see has_two_matrices()
  DistributedMatrix matrix, gentle;
  Vector mass;
};
} // namespace mesoslip

#endif
