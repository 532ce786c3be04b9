#ifndef mesoslip_body_mesh_distributed_mesh_h
#define mesoslip_body_mesh_distributed_mesh_h

#include "mesh/mesh.h"

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/hp/fe_collection.h>
#include <deal.II/hp/mapping_collection.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <map>
#include <vector>

namespace mesoslip
{
/**
 * A mesh divided among the ranks by METIS, with dim degrees of freedom a node, linear or quadratic
 * displacements on simplices, and such ones along each axis on quadrilaterals and hexahedra.
 * The sides of its cells are straight, with quadratic displacements also curved as the mesh has them.
 *
 * For the few files that work with it: its headers take long to compile.
 */
template <int dim>
class DistributedMesh
{
public:
  using Index = dealii::types::global_dof_index; ///< a degree of freedom

  /** Divides @p mesh, which only rank 0 has to have; displacements have the @p degree 1 or 2. Collective. */
  DistributedMesh(const Mesh<dim> &mesh,
                  const MPI_Comm communicator,
                  const unsigned int degree = 1);

  /** What ML needs. @throws UserError if there are fewer cells than ranks */
  void require_cells() const;

  /** Its active FE index is 1 for simplices, 0 for other cells. */
  const dealii::DoFHandler<dim> &dofs() const
  {
    return dof_handler;
  }

  /** Degrees of freedom of the cells that this rank owns and of their neighbours. */
  const dealii::IndexSet &relevant() const
  {
    return relevant_dofs;
  }

  /** Linear mappings, or quadratic ones of a mesh with curved cells, by active FE index. */
  const dealii::hp::MappingCollection<dim> &mapping() const
  {
    return mappings;
  }

  /** Exact for products of two gradients on parallelepipeds, by active FE index. */
  const dealii::hp::QCollection<dim> &quadrature() const
  {
    return quadratures;
  }

  /** The ranks that share the mesh. */
  MPI_Comm communicator() const
  {
    return ranks;
  }

  /**
   * The dim degrees of freedom of each of @p points, one point after the other, on all
   * ranks. Mesh and points are those of rank 0. Collective.
   */
  std::vector<Index> dofs_of_points(const Mesh<dim> &mesh,
                                    const std::vector<unsigned int> &points) const;

  /** Begins @p constraints of its degrees of freedom. */
  void begin(dealii::AffineConstraints<double> &constraints) const;

private:
  MPI_Comm ranks;
  dealii::parallel::fullydistributed::Triangulation<dim> triangulation;
  dealii::hp::FECollection<dim> elements;
  dealii::hp::MappingCollection<dim> mappings;
  dealii::hp::QCollection<dim> quadratures;
  dealii::DoFHandler<dim> dof_handler;
  dealii::IndexSet relevant_dofs;
};

/** Of each duplicate degree of freedom its last original: that of one pair may be the
 * duplicate of a later one. */
std::map<dealii::types::global_dof_index, dealii::types::global_dof_index> originals_of(
  const std::vector<std::array<dealii::types::global_dof_index, 2>> &duplicates);

/**
 * Constrains duplicate degrees of freedom to be equal to their originals, see
 * originals_of(). Only those among @p relevant get a line, which contains those that this rank has
 * @p owned; their originals, on whatever rank, become local to @p constraints, which is left open.
 */
void tie_duplicates(
  const std::vector<std::array<dealii::types::global_dof_index, 2>> &duplicates,
  const dealii::IndexSet &owned,
  const dealii::IndexSet &relevant,
  dealii::AffineConstraints<double> &constraints);
} // namespace mesoslip

#endif
