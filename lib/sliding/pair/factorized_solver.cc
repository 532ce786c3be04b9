#include "sliding/pair/factorized_solver.h"

namespace mesoslip
{
template <int dim>
FactorizedSolver<dim>::FactorizedSolver(const ElasticBody<dim> &body)
  : body(body)
  , of_cells(body.stiffness_entries())
{
}

template <int dim>
void FactorizedSolver<dim>::set_constrained_on_springs(const DofMask &mask,
                                                       const std::vector<SpringEntry> &on)
{
  const unsigned int n = body.n_columns();
  std::vector<bool> is_duplicate(n);
  for (const auto &[duplicate, original] : body.duplicate_nodes())
    is_duplicate[duplicate.i] = true;
  number.assign(std::size_t{dim} * n, -1);
  std::int64_t n_free = 0;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int c = 0; c < dim && !is_duplicate[i]; ++c)
      if (!mask.is_constrained(c, {i, 0}))
        number[std::size_t{dim} * i + c] = n_free++;
  std::vector<Eigen::Triplet<double, std::int64_t>> among, to_all;
  const auto add = [&](const std::uint64_t row, const std::uint64_t column,
                       const double value) {
    if (number[row] < 0)
      return;
    to_all.emplace_back(number[row], column, value);
    if (number[column] >= 0)
      among.emplace_back(number[row], number[column], value);
  };
  for (const MatrixEntry &entry : of_cells)
    add(entry.row, entry.column, entry.value);
  for (const SpringEntry &spring : with_foundation(body.foundation(), on))
    add(std::uint64_t{dim} * spring.node.i + spring.c,
        std::uint64_t{dim} * spring.node.i + spring.d, spring.stiffness);
  Matrix free(n_free, n_free);
  free.setFromTriplets(among.begin(), among.end());
  coupling.resize(n_free, static_cast<Eigen::Index>(number.size()));
  coupling.setFromTriplets(to_all.begin(), to_all.end());
  factors.compute(free);
  // Of a motion as a whole a pivot is left by round-off.
  const auto &pivots = factors.vectorD();
  is_singular        = factors.info() != Eigen::Success ||
                (n_free > 0 && !(pivots.minCoeff() > 1e-12 * pivots.maxCoeff()));
}

template <int dim>
SolverReport FactorizedSolver<dim>::solve(NodalField<double> &u,
                                          const NodalField<double> &force,
                                          const double /*tolerance*/)
{
  if (is_singular)
    throw NotConverged("the body can move as a whole", NotConverged::Reason::broke_down);
  Eigen::VectorXd given(static_cast<Eigen::Index>(number.size())), right(coupling.rows());
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      {
        const std::size_t dof                 = std::size_t{dim} * i + c;
        given[static_cast<Eigen::Index>(dof)] = number[dof] < 0 ? u.row(c, 0)[i] : 0.;
        if (number[dof] >= 0)
          right[number[dof]] = force.row(c, 0)[i];
      }
  // Duplicates are no columns of their own.
  const Eigen::VectorXd left = right - coupling * given, x = factors.solve(left);
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      if (const std::int64_t k = number[std::size_t{dim} * i + c]; k >= 0)
        u.row(c, 0)[i] = x[k];
  body.copy_duplicates(u);
  return {1, 0.};
}

template class FactorizedSolver<2>;
template class FactorizedSolver<3>;
} // namespace mesoslip
