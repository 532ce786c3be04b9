#include "elasticity/assembled_operator.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

#include <stdexcept>
#include <string>

namespace mesoslip
{
using dealii::TrilinosWrappers::MPI::Vector;

template <int dim>
struct AssembledOperator<dim>::Implementation
{
  Implementation(const dealii::Triangulation<dim> &triangulation,
                 const std::vector<VoigtMatrix<dim>> &stiffness,
                 const std::vector<double> &density);

  void make_pattern();
  void assemble(const std::vector<VoigtMatrix<dim>> &stiffness,
                const std::vector<double> &density);

  dealii::FESystem<dim> fe;
  dealii::DoFHandler<dim> dof_handler;
  dealii::TrilinosWrappers::SparseMatrix matrix;
  Vector mass;
};

namespace
{
/** Strain (Voigt order, engineering shear) of one shape function with gradient @p g in
 *  component @p c. */
template <int dim>
VoigtVector<dim> shape_strain(const dealii::Tensor<1, dim> &g, const unsigned int c)
{
  VoigtVector<dim> e = VoigtVector<dim>::Zero();
  e(c)               = g[c];
  if constexpr (dim == 2)
    e(2) = g[1 - c];
  else
    for (unsigned int other = 0; other < dim; ++other)
      if (other != c)
        // yz, xz, xy are the pairs without 0, 1, 2.
        e(3 + (3 - c - other)) = g[other];
  return e;
}
} // namespace

template <int dim>
AssembledOperator<dim>::Implementation::Implementation(
  const dealii::Triangulation<dim> &triangulation,
  const std::vector<VoigtMatrix<dim>> &stiffness,
  const std::vector<double> &density)
  : fe(dealii::FE_Q<dim>(1), dim)
  , dof_handler(triangulation)
{
  if (stiffness.size() != density.size())
    throw std::invalid_argument("as many densities as stiffnesses are needed");
  dof_handler.distribute_dofs(fe);
  make_pattern();
  assemble(stiffness, density);
}

template <int dim>
void AssembledOperator<dim>::Implementation::make_pattern()
{
  const auto communicator = dof_handler.get_communicator();
  dealii::IndexSet relevant;
  dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();

  dealii::TrilinosWrappers::SparsityPattern pattern(owned, owned, relevant, communicator);
  dealii::DoFTools::make_sparsity_pattern(
    dof_handler, pattern, dealii::AffineConstraints<double>(), true,
    dealii::Utilities::MPI::this_mpi_process(communicator));
  pattern.compress();
  matrix.reinit(pattern);
  mass.reinit(owned, communicator);
}

template <int dim>
void AssembledOperator<dim>::Implementation::assemble(
  const std::vector<VoigtMatrix<dim>> &stiffness, const std::vector<double> &density)
{
  const dealii::QGauss<dim> quadrature(2);
  dealii::FEValues<dim> values(fe, quadrature,
                               dealii::update_values | dealii::update_gradients |
                                 dealii::update_JxW_values);
  const unsigned int n = fe.n_dofs_per_cell();
  dealii::FullMatrix<double> cell_matrix(n, n);
  dealii::Vector<double> cell_mass(n);
  std::vector<dealii::types::global_dof_index> dofs(n);
  std::vector<VoigtVector<dim>> strain(n), stress(n);

  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const auto id = cell->material_id();
        if (id >= stiffness.size())
          throw std::invalid_argument("a cell has material id " + std::to_string(id) +
                                      " but only " + std::to_string(stiffness.size()) +
                                      " materials are defined");
        values.reinit(cell);
        cell_matrix = 0.;
        cell_mass   = 0.;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            for (unsigned int i = 0; i < n; ++i)
              {
                const unsigned int c = fe.system_to_component_index(i).first;
                strain[i]            = shape_strain<dim>(values.shape_grad(i, q), c);
                stress[i]            = values.JxW(q) * stiffness[id] * strain[i];
                cell_mass(i) += density[id] * values.shape_value(i, q) * values.JxW(q);
              }
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                cell_matrix(i, j) += strain[i].dot(stress[j]);
          }
        cell->get_dof_indices(dofs);
        matrix.add(dofs, cell_matrix);
        mass.add(dofs, cell_mass);
      }
  matrix.compress(dealii::VectorOperation::add);
  mass.compress(dealii::VectorOperation::add);
}

template <int dim>
AssembledOperator<dim>::AssembledOperator(
  const dealii::Triangulation<dim, dim> &triangulation,
  const std::vector<VoigtMatrix<dim>> &stiffness,
  const std::vector<double> &density)
  : implementation(std::make_unique<Implementation>(triangulation, stiffness, density))
{
}

template <int dim>
AssembledOperator<dim>::~AssembledOperator() = default;

template <int dim>
void AssembledOperator<dim>::vmult(Vector &dst, const Vector &src) const
{
  implementation->matrix.vmult(dst, src);
}

template <int dim>
void AssembledOperator<dim>::initialize_vector(Vector &vector) const
{
  vector.reinit(implementation->mass, true);
  vector = 0.;
}

template <int dim>
const Vector &AssembledOperator<dim>::lumped_mass() const
{
  return implementation->mass;
}

template <int dim>
void AssembledOperator<dim>::diagonal(Vector &diagonal) const
{
  initialize_vector(diagonal);
  for (const auto i : diagonal.locally_owned_elements())
    diagonal[i] = implementation->matrix.diag_element(i);
  diagonal.compress(dealii::VectorOperation::insert);
}

template <int dim>
double AssembledOperator<dim>::elastic_energy(const Vector &u) const
{
  Vector f;
  initialize_vector(f);
  vmult(f, u);
  return 0.5 * (u * f);
}

template <int dim>
const dealii::DoFHandler<dim, dim> &AssembledOperator<dim>::dof_handler() const
{
  return implementation->dof_handler;
}

template <int dim>
const dealii::TrilinosWrappers::SparseMatrix &AssembledOperator<dim>::matrix() const
{
  return implementation->matrix;
}

template class AssembledOperator<2>;
template class AssembledOperator<3>;
} // namespace mesoslip
