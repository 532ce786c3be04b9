#ifndef mesoslip_body_mesh_cell_values_h
#define mesoslip_body_mesh_cell_values_h

#include "base/exchange.h"
#include "body/mesh/distributed_mesh.h"
#include "elasticity/uniform_material.h"
#include "material/voigt.h"

#include <deal.II/hp/fe_values.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <vector>

namespace mesoslip
{
/** Strain of each shape function, one per column (Voigt, engineering shear). */
template <int dim>
using ShapeStrains = Eigen::Matrix<double, n_voigt<dim>, Eigen::Dynamic>;

/** Strains of the shape functions at quadrature point @p q. */
template <int dim>
ShapeStrains<dim> shape_strains(const dealii::FEValues<dim> &values, const unsigned int q)
{
  const auto &element  = values.get_fe();
  const unsigned int n = element.n_dofs_per_cell();
  ShapeStrains<dim> B  = ShapeStrains<dim>::Zero(n_voigt<dim>, n);
  for (unsigned int i = 0; i < n; ++i)
    {
      const unsigned int c = element.system_to_component_index(i).first;
      const auto gradient  = values.shape_grad(i, q);
      for (unsigned int d = 0; d < dim; ++d)
        B(voigt_index<dim>(c, d), i) = gradient[d];
    }
  return B;
}

/**
 * Whether mean dilatation changes the strains of a cell; the strain of linear simplices
 * is constant.
 */
template <int dim>
bool may_be_apart(const dealii::FiniteElement<dim> &element)
{
  return element.degree > 1 || !element.reference_cell().is_simplex();
}

/**
 * Basis of the volume changes of a cell with mean dilatation, at quadrature point @p q:
 * constant; for quadratic quadrilaterals and hexahedra also the coordinates, which gives
 * them the usual order of convergence. Volume changes of quadratic simplices are linear
 * anyway.
 */
template <int dim>
Eigen::VectorXd dilatation_basis(const dealii::FEValues<dim> &values,
                                 const unsigned int q)
{
  const bool linear =
    values.get_fe().degree > 1 && !values.get_fe().reference_cell().is_simplex();
  Eigen::VectorXd basis = Eigen::VectorXd::Ones(linear ? 1 + dim : 1);
  const auto from       = values.quadrature_point(q) - values.quadrature_point(0);
  for (unsigned int d = 0; d < dim && linear; ++d)
    basis(1 + d) = from[d];
  return basis;
}

/**
 * Strains of the shape functions at all quadrature points of a cell of @p phase, with its
 * mean dilatation if set (ElasticPhase::mean_dilatation).
 */
template <int dim>
std::vector<ShapeStrains<dim>> cell_strains(const dealii::FEValues<dim> &values,
                                            const ElasticPhase<dim> &phase)
{
  std::vector<ShapeStrains<dim>> B;
  for (const unsigned int q : values.quadrature_point_indices())
    B.push_back(shape_strains(values, q));
  if (!phase.mean_dilatation || !may_be_apart(values.get_fe()))
    return B;
  const auto dilatation = [](const ShapeStrains<dim> &strains) {
    return strains.template topRows<dim>().colwise().sum().eval();
  };
  std::vector<Eigen::VectorXd> basis;
  for (const unsigned int q : values.quadrature_point_indices())
    basis.push_back(dilatation_basis(values, q));
  const Eigen::Index n  = basis[0].size();
  Eigen::MatrixXd mass  = Eigen::MatrixXd::Zero(n, n),
                  right = Eigen::MatrixXd::Zero(n, B[0].cols());
  for (const unsigned int q : values.quadrature_point_indices())
    {
      mass += values.JxW(q) * basis[q] * basis[q].transpose();
      right += values.JxW(q) * basis[q] * dilatation(B[q]);
    }
  const Eigen::MatrixXd projected = mass.llt().solve(right);
  for (const unsigned int q : values.quadrature_point_indices())
    B[q].template topRows<dim>().rowwise() +=
      ((basis[q].transpose() * projected - dilatation(B[q])) / dim).eval();
  return B;
}

/** Stiffness of a cell of @p phase from its cell_strains() @p B. */
template <int dim>
Eigen::MatrixXd cell_matrix(const dealii::FEValues<dim> &values,
                            const std::vector<ShapeStrains<dim>> &B,
                            const ElasticPhase<dim> &phase)
{
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(B[0].cols(), B[0].cols());
  for (const unsigned int q : values.quadrature_point_indices())
    K.noalias() += values.JxW(q) * B[q].transpose() * phase.stiffness * B[q];
  return K;
}

/** Phase that a preconditioner uses for a cell of @p phase. */
template <int dim>
ElasticPhase<dim> phase_in_cell(const dealii::FEValues<dim> &values,
                                const ElasticPhase<dim> &phase)
{
  return may_be_apart(values.get_fe()) ? phase_to_precondition(phase) : phase;
}

/** Whether phase_in_cell() differs from the phase in any cell. Collective. */
template <int dim>
bool has_two_matrices(const DistributedMesh<dim> &mesh,
                      const std::vector<ElasticPhase<dim>> &phases)
{
  unsigned int changed = 0;
  for (const auto &cell : mesh.dofs().active_cell_iterators())
    changed |= cell->is_locally_owned() && phases[cell->material_id()].mean_dilatation &&
               may_be_apart(cell->get_fe());
  return mpi::max(changed, mesh.communicator()) > 0;
}

/** Calls @p action (cell, FEValues, degrees of freedom) for each locally owned cell. */
template <int dim, typename Action>
void for_each_cell(const DistributedMesh<dim> &mesh, const Action &action)
{
  using namespace dealii;
  hp::FEValues<dim> hp_values(
    mesh.mapping(), mesh.dofs().get_fe_collection(), mesh.quadrature(),
    update_values | update_gradients | update_JxW_values | update_quadrature_points);
  std::vector<typename DistributedMesh<dim>::Index> indices;
  for (const auto &cell : mesh.dofs().active_cell_iterators())
    if (cell->is_locally_owned())
      {
        hp_values.reinit(cell);
        const FEValues<dim> &values = hp_values.get_present_fe_values();
        indices.resize(values.get_fe().n_dofs_per_cell());
        cell->get_dof_indices(indices);
        action(*cell, values, indices);
      }
}
} // namespace mesoslip

#endif
