#ifndef mesoslip_body_mesh_mesh_discretization_h
#define mesoslip_body_mesh_mesh_discretization_h

#include "body/elastic_body.h"
#include "body/mesh/distributed_mesh.h"

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

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
  using Vector = dealii::TrilinosWrappers::MPI::Vector;  ///< owned degrees of freedom
  using Matrix = dealii::TrilinosWrappers::SparseMatrix; ///< owned rows
  using Index  = dealii::types::global_dof_index;        ///< a degree of freedom

  /** Of @p body only layout, phases and duplicates are used. Collective. */
  MeshDiscretization(const Mesh<dim> &mesh,
                     const ElasticBody<dim> &body,
                     const MPI_Comm communicator);

  /** What ML needs. @throws UserError if there are fewer cells than ranks */
  void require_cells() const
  {
    distributed.require_cells();
  }

  /** K (N/m) with the rows of duplicates added to those of their originals. */
  const Matrix &stiffness() const
  {
    return matrix;
  }

  /** Row sums of the consistent mass matrix (kg, in 2D kg/m). */
  const Vector &lumped_mass() const
  {
    return mass;
  }

  /** Degree of freedom of component @p c of the node, on all ranks. */
  Index dof(const unsigned int c, const NodeIndex &node) const
  {
    return dofs[dim * (static_cast<std::size_t>(node.j) * body.n_columns() + node.i) + c];
  }

  /** Number of degrees of freedom, duplicates included. */
  Index n_dofs() const
  {
    return dofs.size();
  }

  /** The owned part of a field. */
  Vector to_vector(const NodalField<double> &field) const;

  /** The whole field on all ranks, with duplicates. Collective. */
  void to_field(NodalField<double> &field, const Vector &vector) const;

private:
  void constrain_duplicates();
  void assemble();

  const ElasticBody<dim> &body;
  const DistributedMesh<dim> distributed;
  dealii::AffineConstraints<double> constraints;
  std::vector<Index> dofs; ///< dim for each point of the mesh
  Matrix matrix;
  Vector mass;
};
} // namespace mesoslip

#endif
