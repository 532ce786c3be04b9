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
 * A mesh partitioned by METIS, with dim degrees of freedom per node. Displacements are
 * linear or quadratic: P1, P2 on simplices, Q1, Q2 on quadrilaterals and hexahedra. Cells
 * have straight sides; with quadratic displacements they may be curved as in the mesh.
 *
 * Include this header in few files: it takes long to compile.
 */
template <int dim>
class DistributedMesh
{
public:
  using Index = dealii::types::global_dof_index; ///< a degree of freedom

  /**
   * Partitions @p mesh, which only rank 0 needs; @p degree of displacements is 1 or 2.
   * Collective.
   */
  DistributedMesh(const Mesh<dim> &mesh,
                  const MPI_Comm communicator,
                  const unsigned int degree = 1);

  /** Checks a requirement of ML. @throws UserError if there are fewer cells than ranks */
  void require_cells() const;

  /** Degrees of freedom; the active FE index is 1 for simplices, 0 for other cells. */
  const dealii::DoFHandler<dim> &dofs() const
  {
    return dof_handler;
  }

  /** Degrees of freedom of locally owned cells and of their neighbours. */
  const dealii::IndexSet &relevant() const
  {
    return relevant_dofs;
  }

  /** Mappings by active FE index: linear, or quadratic for meshes with curved cells. */
  const dealii::hp::MappingCollection<dim> &mapping() const
  {
    return mappings;
  }

  /**
   * Quadratures by active FE index: exact for products of two gradients on
   * parallelepipeds.
   */
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
   * The dim degrees of freedom of each of @p points, point after point, on all ranks.
   * Only rank 0 needs mesh and points. Collective.
   */
  std::vector<Index> dofs_of_points(const Mesh<dim> &mesh,
                                    const std::vector<unsigned int> &points) const;

  /**
   * Clears @p constraints and sets their index sets to the degrees of freedom of the
   * mesh.
   */
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

/**
 * Final periodic master of each periodic copy; the master in one pair may be the copy in
 * a later pair.
 */
std::map<dealii::types::global_dof_index, dealii::types::global_dof_index>
masters_of(const std::vector<std::array<dealii::types::global_dof_index, 2>> &copies);

/**
 * Constrains periodic copies to their periodic masters, see masters_of(). Adds lines
 * only for @p relevant degrees of freedom, a superset of the locally @p owned ones.
 * Masters on any rank become local to @p constraints, which is not closed.
 */
void tie_copies(const std::vector<std::array<dealii::types::global_dof_index, 2>> &copies,
                const dealii::IndexSet &owned,
                const dealii::IndexSet &relevant,
                dealii::AffineConstraints<double> &constraints);
} // namespace mesoslip

#endif
