#include "body/mesh/mesh_discretization.h"

#include "body/mesh/cell_values.h"
#include "body/mesh/condensed_cells.h"

#include <deal.II/lac/vector.h>

#include <numeric>

namespace mesoslip
{
namespace
{
template <int dim>
std::vector<unsigned int> all_points(const Mesh<dim> &mesh)
{
  std::vector<unsigned int> points(mesh.points.size());
  std::iota(points.begin(), points.end(), 0U);
  return points;
}
} // namespace

template <int dim>
MeshDiscretization<dim>::MeshDiscretization(const Mesh<dim> &mesh,
                                            const ElasticBody<dim> &the_body,
                                            const MPI_Comm communicator)
  : body(the_body)
  , distributed(mesh, communicator)
  , dofs(distributed.dofs_of_points(mesh, all_points(mesh)))
{
  constrain_duplicates();
  assemble();
}

template <int dim>
void MeshDiscretization<dim>::constrain_duplicates()
{
  std::vector<std::array<Index, 2>> duplicates;
  for (const auto &[duplicate, original] : body.duplicate_nodes())
    for (unsigned int c = 0; c < dim; ++c)
      duplicates.push_back({{dof(c, duplicate), dof(c, original)}});
  tie_duplicates(duplicates, distributed.relevant(), constraints);
  constraints.close();
}

template <int dim>
void MeshDiscretization<dim>::assemble()
{
  using namespace dealii;
  const MPI_Comm communicator = distributed.communicator();
  const IndexSet &owned       = distributed.dofs().locally_owned_dofs();
  CondensedCells cells(constraints);
  cells.reinit(matrix, distributed);
  mass.reinit(owned, communicator);

  for_each_cell(
    distributed, [&](const auto &cell, const auto &values, const auto &indices) {
      const unsigned int n           = indices.size();
      const ElasticPhase<dim> &phase = body.phases()[cell.material_id()];
      Eigen::MatrixXd K              = Eigen::MatrixXd::Zero(n, n);
      Eigen::VectorXd cell_mass      = Eigen::VectorXd::Zero(n);
      for (const unsigned int q : values.quadrature_point_indices())
        {
          const auto B = shape_strains(values, q);
          K.noalias() += values.JxW(q) * B.transpose() * phase.stiffness * B;
          for (unsigned int i = 0; i < n; ++i)
            cell_mass(i) += phase.density * values.shape_value(i, q) * values.JxW(q);
        }
      cells.add(K, indices, matrix);
      cells.add(cell_mass, indices, mass);
    });
  matrix.compress(VectorOperation::add);
  mass.compress(VectorOperation::add);
}

template <int dim>
typename MeshDiscretization<dim>::Vector
MeshDiscretization<dim>::to_vector(const NodalField<double> &field) const
{
  const dealii::IndexSet &owned = distributed.dofs().locally_owned_dofs();
  Vector vector(owned, distributed.communicator());
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        {
          const Index k = dof(c, {i, j});
          if (owned.is_element(k) && !constraints.is_constrained(k))
            vector[k] = field.row(c, j)[i];
        }
  vector.compress(dealii::VectorOperation::insert);
  return vector;
}

template <int dim>
void MeshDiscretization<dim>::to_field(NodalField<double> &field,
                                       const Vector &vector) const
{
  const dealii::Vector<double> all(vector);
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        field.row(c, j)[i] = all[dof(c, {i, j})];
  body.copy_duplicates(field);
}

template class MeshDiscretization<2>;
template class MeshDiscretization<3>;
} // namespace mesoslip
