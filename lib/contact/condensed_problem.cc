#include "contact/condensed_contact.h"

namespace mesoslip
{
template <int dim>
typename CondensedContact<dim>::Problem CondensedContact<dim>::of_sliding_flat() const
{
  std::vector<Eigen::Index> normal, along;
  for (Eigen::Index k = 0; k < F.size(); ++k)
    if (place[static_cast<std::size_t>(k)].c == normal_axis)
      normal.push_back(k);
    else
      along.push_back(k);
  // Tangential forces minus friction.
  Eigen::MatrixXd excess(static_cast<Eigen::Index>(along.size()), F.size());
  Eigen::VectorXd at_start(excess.rows());
  for (Eigen::Index k = 0; k < excess.rows(); ++k)
    {
      const Eigen::Index at = along[static_cast<std::size_t>(k)];
      const auto [i, c]     = place[static_cast<std::size_t>(at)];
      const double mu =
        problem.friction_coefficient[i] * problem.sliding * problem.flat_direction[c];
      excess.row(k) = S.row(at) - mu * S.row(number(i, normal_axis));
      at_start[k]   = F[at] - mu * F[number(i, normal_axis)];
    }
  const auto rows = Eigen::seqN(0, excess.rows()); // Eigen::all moved in Eigen 5
  const Eigen::FullPivLU<Eigen::MatrixXd> moves(excess(rows, along));
  Problem of;
  of.M = S(normal, normal) -
         S(normal, along) * moves.solve(Eigen::MatrixXd(excess(rows, normal)));
  of.q = F(normal) - S(normal, along) * moves.solve(at_start);
  for (const Eigen::Index k : normal)
    of.z.emplace_back(k, 1.);
  return of;
}

template <int dim>
typename CondensedContact<dim>::Problem CondensedContact<dim>::of_resting_flat() const
{
  Problem of;
  for (Eigen::Index k = 0; k < F.size(); ++k)
    {
      of.z.emplace_back(k, 1.);
      if (place[static_cast<std::size_t>(k)].c != normal_axis)
        of.z.emplace_back(k, -1.);
    }
  const auto n = static_cast<Eigen::Index>(of.z.size());
  of.M.resize(n, n);
  of.q.resize(n);
  for (Eigen::Index row = 0; row < n; ++row)
    {
      const auto [k, sign]         = of.z[static_cast<std::size_t>(row)];
      const auto [i, c]            = place[static_cast<std::size_t>(k)];
      Eigen::RowVectorXd condition = S.row(k);
      double at_start              = F[k];
      if (c != normal_axis)
        {
          const double mu          = problem.friction_coefficient[i];
          const Eigen::Index press = number(i, normal_axis);
          condition                = mu * S.row(press) + sign * condition;
          at_start                 = mu * F[press] + sign * at_start;
        }
      of.q[row] = at_start;
      for (Eigen::Index column = 0; column < n; ++column)
        of.M(row, column) = of.z[static_cast<std::size_t>(column)].second *
                            condition[of.z[static_cast<std::size_t>(column)].first];
    }
  return of;
}

template typename CondensedContact<2>::Problem
CondensedContact<2>::of_sliding_flat() const;
template typename CondensedContact<3>::Problem
CondensedContact<3>::of_sliding_flat() const;
template typename CondensedContact<2>::Problem
CondensedContact<2>::of_resting_flat() const;
template typename CondensedContact<3>::Problem
CondensedContact<3>::of_resting_flat() const;
} // namespace mesoslip
