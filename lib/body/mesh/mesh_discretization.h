#ifndef mesoslip_body_mesh_mesh_discretization_h
#define mesoslip_body_mesh_mesh_discretization_h

#include "body/elastic_body.h"
#include "body/mesh/distributed_matrix.h"
#include "body/mesh/mesh_share.h"

#include <map>

namespace mesoslip
{
/**
 * Stiffness and mass matrices of a partitioned mesh. Degrees of freedom of periodic
 * copies are constrained to their periodic masters; in vectors they are zero.
 *
 * Include this header in few files: it takes long to compile.
 */
template <int dim>
class MeshDiscretization
{
public:
  using Vector = DistributedVector;               ///< locally owned values
  using Index  = dealii::types::global_dof_index; ///< a degree of freedom

  /** Uses only layout and phases of @p body. Collective. */
  MeshDiscretization(MeshShare<dim> &&share, const ElasticBody<dim> &body);

  /** Checks a requirement of ML. @throws UserError if there are fewer cells than ranks */
  void require_cells() const
  {
    distributed->require_cells();
  }

  /** K (N/m); rows of periodic copies are added to the rows of their masters. */
  const DistributedMatrix &stiffness() const
  {
    return matrix;
  }

  /**
   * The matrix of phase_to_precondition() (N/m); it is K if no phase has mean dilatation.
   */
  const DistributedMatrix &to_precondition() const
  {
    return is_apart ? gentle : matrix;
  }

  /** Whether to_precondition() and stiffness() are different matrices. */
  bool has_two_matrices() const
  {
    return is_apart;
  }

  /** Row sums of the consistent mass matrix (kg, in 2D kg/m). */
  const Vector &lumped_mass() const
  {
    return mass;
  }

  /**
   * Degree of freedom of component @p c of a node; for a periodic copy that of its
   * master.
   */
  Index dof(const unsigned int c, const NodeIndex &node) const
  {
    return dofs[entry(c, node)];
  }

  /** Number of degrees of freedom, periodic copies included. */
  Index n_dofs() const
  {
    return distributed->dofs().n_dofs();
  }

  /** Locally owned values of a field. */
  Vector to_vector(const NodalField<double> &field) const;

  /** Locally owned values at components that @p mask constrains, zero elsewhere. */
  Vector to_vector(const NodalField<double> &field, const DofMask &mask) const;

  /**
   * For each locally owned degree of freedom: whether it is a periodic copy or
   * constrained by @p mask.
   */
  std::vector<bool> held_by(const DofMask &mask) const;

  /**
   * Copies @p vector to all nodes of the local field, periodic copies included.
   * Collective.
   */
  void to_field(NodalField<double> &field, const Vector &vector) const;

  /** See ElasticBody::strain_products(). Collective over the ranks of the mesh. */
  std::vector<VoigtMatrix<dim>> strain_products(const Vector &u) const;

private:
  std::size_t entry(const unsigned int c, const NodeIndex &node) const
  {
    return dim * (static_cast<std::size_t>(node.j) * body.n_columns() + node.i) + c;
  }

  /**
   * Calls action(index in owned vectors, c, node) for locally owned entries of fields.
   */
  template <typename Action>
  void for_each_owned(const Action &action) const;

  void find_places(const std::map<Index, Index> &masters);
  void assemble();

  const ElasticBody<dim> &body;
  const std::unique_ptr<const DistributedMesh<dim>> distributed;
  dealii::AffineConstraints<double> constraints;
  std::vector<Index> dofs; ///< dim per node of fields, see dof()

  static constexpr int nowhere = -1;   ///< index of a periodic copy or of a ghost node
  std::vector<int> in_owned;           ///< index of dofs in a Vector
  std::vector<unsigned int> in_needed; ///< index of dofs in needed
  mutable Vector needed;               ///< values at all local nodes
  const bool is_apart;                 ///< see has_two_matrices()
  DistributedMatrix matrix, gentle;
  Vector mass;
};
} // namespace mesoslip

#endif
