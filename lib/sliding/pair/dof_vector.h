#ifndef mesoslip_sliding_pair_dof_vector_h
#define mesoslip_sliding_pair_dof_vector_h

#include "grid/nodal_field.h"

#include <Eigen/Core>

#include <cstdint>

namespace mesoslip
{
/** Degree of freedom of component @p c of a node of a field in one row, see MatrixEntry. */
template <int dim>
std::int64_t dof_of(const unsigned int node, const unsigned int c)
{
  return static_cast<std::int64_t>(dim) * node + c;
}

/** The field as a vector: the components of each node are adjacent, as degrees of freedom
 * are numbered. */
template <int dim>
Eigen::VectorXd vector_of(const NodalField<double> &field)
{
  Eigen::VectorXd x(static_cast<Eigen::Index>(dim) * field.n_columns());
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int i = 0; i < field.n_columns(); ++i)
      x[dof_of<dim>(i, c)] = field.row(c, 0)[i];
  return x;
}

/** Fills @p field with the entries of @p x from node @p first on. */
template <int dim>
void take(NodalField<double> &field,
          const Eigen::VectorXd &x,
          const unsigned int first = 0)
{
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int i = 0; i < field.n_columns(); ++i)
      field.row(c, 0)[i] = x[dof_of<dim>(first + i, c)];
}
} // namespace mesoslip

#endif
