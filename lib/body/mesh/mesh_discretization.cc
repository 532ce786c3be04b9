#include "body/mesh/mesh_discretization.h"

#include "base/exchange.h"
#include "body/mesh/cell_values.h"
#include "body/mesh/condensed_cells.h"

#include <algorithm>

namespace mesoslip
{
template <int dim>
MeshDiscretization<dim>::MeshDiscretization(MeshShare<dim> &&share,
                                            const ElasticBody<dim> &the_body)
  : body(the_body)
  , distributed(std::move(share.all_ranks))
  , dofs(std::move(share.dofs))
  , is_apart(mesoslip::has_two_matrices(*distributed, body.phases()))
{
  std::vector<std::array<Index, 2>> copies;
  for (std::size_t k = 0; k < share.copies.size(); k += 2UL * dim)
    for (unsigned int c = 0; c < dim; ++c)
      copies.push_back({{share.copies[k + c], share.copies[k + dim + c]}});
  tie_copies(copies, distributed->dofs().locally_owned_dofs(), distributed->relevant(),
             constraints);
  constraints.close();
  find_places(masters_of(copies));
  assemble();
}

template <int dim>
void MeshDiscretization<dim>::find_places(const std::map<Index, Index> &masters)
{
  const dealii::IndexSet &owned = distributed->dofs().locally_owned_dofs();
  in_owned.assign(dofs.size(), nowhere);
  for (std::size_t k = 0; k < dofs.size(); ++k)
    {
      const auto master = masters.find(dofs[k]);
      if (master != masters.end())
        dofs[k] = master->second;
      else if (owned.is_element(dofs[k]))
        in_owned[k] = static_cast<int>(owned.index_within_set(dofs[k]));
    }
  std::vector<Index> sorted = dofs;
  std::sort(sorted.begin(), sorted.end());
  dealii::IndexSet of_fields(n_dofs());
  of_fields.add_indices(sorted.begin(), std::unique(sorted.begin(), sorted.end()));
  of_fields.compress();
  needed.reinit(owned, of_fields, distributed->communicator());
  for (const Index dof : dofs)
    in_needed.push_back(needed.get_partitioner()->global_to_local(dof));
}

template <int dim>
void MeshDiscretization<dim>::assemble()
{
  using namespace dealii;
  CondensedCells cells(constraints);
  cells.reinit(matrix, *distributed);
  if (is_apart)
    cells.reinit(gentle, *distributed);
  mass.reinit(distributed->dofs().locally_owned_dofs(), constraints.get_local_lines(),
              distributed->communicator());

  for_each_cell(
    *distributed, [&](const auto &cell, const auto &values, const auto &indices) {
      const unsigned int n           = indices.size();
      const ElasticPhase<dim> &phase = body.phases()[cell.material_id()];
      Eigen::VectorXd cell_mass      = Eigen::VectorXd::Zero(n);
      const auto B                   = cell_strains(values, phase);
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int i = 0; i < n; ++i)
          cell_mass(i) += phase.density * values.shape_value(i, q) * values.JxW(q);
      cells.add(cell_matrix(values, B, phase), indices, matrix);
      if (is_apart)
        cells.add(cell_matrix(values, B, phase_in_cell(values, phase)), indices, gentle);
      cells.add(cell_mass, indices, mass);
    });
  matrix.compress();
  if (is_apart)
    gentle.compress();
  mass.compress(VectorOperation::add);
}

template <int dim>
template <typename Action>
void MeshDiscretization<dim>::for_each_owned(const Action &action) const
{
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        if (const int k = in_owned[entry(c, {i, j})]; k != nowhere)
          action(static_cast<std::size_t>(k), c, NodeIndex{i, j});
}

template <int dim>
typename MeshDiscretization<dim>::Vector
MeshDiscretization<dim>::to_vector(const NodalField<double> &field) const
{
  Vector vector(distributed->dofs().locally_owned_dofs(), distributed->communicator());
  for_each_owned([&](const std::size_t k, const unsigned int c, const NodeIndex &node) {
    vector.begin()[k] = field(c, node);
  });
  return vector;
}

template <int dim>
typename MeshDiscretization<dim>::Vector
MeshDiscretization<dim>::to_vector(const NodalField<double> &field,
                                   const DofMask &mask) const
{
  Vector vector(distributed->dofs().locally_owned_dofs(), distributed->communicator());
  for_each_owned([&](const std::size_t k, const unsigned int c, const NodeIndex &node) {
    if (mask.is_constrained(c, node))
      vector.begin()[k] = field(c, node);
  });
  return vector;
}

template <int dim>
std::vector<bool> MeshDiscretization<dim>::held_by(const DofMask &mask) const
{
  const dealii::IndexSet &owned = distributed->dofs().locally_owned_dofs();
  std::vector<bool> held;
  for (const Index dof : owned)
    held.push_back(constraints.is_constrained(dof));
  for_each_owned([&](const std::size_t k, const unsigned int c, const NodeIndex &node) {
    if (mask.is_constrained(c, node))
      held[k] = true;
  });
  return held;
}

template <int dim>
void MeshDiscretization<dim>::to_field(NodalField<double> &field,
                                       const Vector &vector) const
{
  needed.copy_locally_owned_data_from(vector);
  needed.update_ghost_values();
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        field.row(c, j)[i] = needed.local_element(in_needed[entry(c, {i, j})]);
}

template <int dim>
std::vector<VoigtMatrix<dim>>
MeshDiscretization<dim>::strain_products(const Vector &u) const
{
  needed.copy_locally_owned_data_from(u);
  needed.update_ghost_values();
  std::vector<VoigtMatrix<dim>> products(body.phases().size(), VoigtMatrix<dim>::Zero());
  Eigen::VectorXd of_cell;
  for_each_cell(
    *distributed, [&](const auto &cell, const auto &values, const auto &indices) {
      of_cell.resize(indices.size());
      for (unsigned int i = 0; i < indices.size(); ++i)
        {
          const auto *line = constraints.get_constraint_entries(indices[i]);
          of_cell(i)       = needed(line == nullptr ? indices[i] : line->front().first);
        }
      const auto B = cell_strains(values, body.phases()[cell.material_id()]);
      for (const unsigned int q : values.quadrature_point_indices())
        {
          const VoigtVector<dim> strain = B[q] * of_cell;
          products[cell.material_id()] += values.JxW(q) * strain * strain.transpose();
        }
    });
  sum_over_ranks(products[0].data(), products.size() * products[0].size(),
                 distributed->communicator());
  return products;
}

template class MeshDiscretization<2>;
template class MeshDiscretization<3>;
} // namespace mesoslip
