#include "body/mesh/condensed_cells.h"

#include <cmath>

namespace mesoslip
{
/**
 * Degree of freedom that receives the contributions to @p dof; invalid if @p dof is
 * constrained to zero.
 */
CondensedCells::Index CondensedCells::target(const Index dof) const
{
  if (!constraints.is_constrained(dof))
    return dof;
  const auto *entries = constraints.get_constraint_entries(dof);
  return entries == nullptr || entries->empty() ? dealii::numbers::invalid_dof_index
                                                : entries->front().first;
}

template <int dim>
void CondensedCells::reinit(DistributedMatrix &matrix,
                            const DistributedMesh<dim> &mesh,
                            const bool with_held) const
{
  const auto n = mesh.dofs().n_dofs();
  dealii::DynamicSparsityPattern pattern(n, n, constraints.get_local_lines());
  std::vector<Index> indices, targets;
  for (const auto &cell : mesh.dofs().active_cell_iterators())
    if (cell->is_locally_owned())
      {
        indices.resize(cell->get_fe().n_dofs_per_cell());
        cell->get_dof_indices(indices);
        targets.clear();
        for (const Index dof : indices)
          if (const Index place = target(dof);
              place != dealii::numbers::invalid_dof_index)
            targets.push_back(place);
          else if (with_held)
            targets.push_back(dof);
        for (const Index row : targets)
          pattern.add_entries(row, targets.begin(), targets.end());
        for (const Index dof : indices)
          if (constraints.is_constrained(dof))
            pattern.add(dof, dof);
      }
  matrix.reinit(mesh.dofs().locally_owned_dofs(), pattern, dim, mesh.communicator());
}

void CondensedCells::add(const Eigen::MatrixXd &cell,
                         const std::vector<Index> &indices,
                         DistributedMatrix &matrix)
{
  const auto n = static_cast<Eigen::Index>(indices.size());
  for (Eigen::Index i = 0; i < n; ++i)
    {
      const Index dof = indices[static_cast<std::size_t>(i)], row = target(dof);
      if (constraints.is_constrained(dof))
        matrix.add(dof, {dof}, {std::fabs(cell(i, i))});
      if (row == dealii::numbers::invalid_dof_index)
        continue;
      columns.clear();
      values.clear();
      for (Eigen::Index j = 0; j < n; ++j)
        if (const Index column = target(indices[static_cast<std::size_t>(j)]);
            column != dealii::numbers::invalid_dof_index)
          {
            columns.push_back(column);
            values.push_back(cell(i, j));
          }
      matrix.add(row, columns, values);
    }
}

void CondensedCells::add(const Eigen::VectorXd &cell,
                         const std::vector<Index> &indices,
                         DistributedVector &vector) const
{
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (const Index row = target(indices[i]); row != dealii::numbers::invalid_dof_index)
      vector(row) += cell(static_cast<Eigen::Index>(i));
}

template void
CondensedCells::reinit(DistributedMatrix &, const DistributedMesh<2> &, const bool) const;
template void
CondensedCells::reinit(DistributedMatrix &, const DistributedMesh<3> &, const bool) const;
} // namespace mesoslip
