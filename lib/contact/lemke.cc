#include "contact/lemke.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace mesoslip
{
namespace
{

constexpr double negligible = 1e-11; // negligible pivots, with entries of order one

/** w - M z - cover z_0 = q: columns w (0 to n - 1), z (n to 2 n - 1), z_0 (2 n) and q. */
class Tableau
{
public:
  Tableau(const Eigen::MatrixXd &M,
          const Eigen::VectorXd &q,
          const Eigen::VectorXd &cover)
    : n(q.size())
    , rows(n, 2 * n + 2)
    , basis(static_cast<std::size_t>(n))
  {
    rows << Eigen::MatrixXd::Identity(n, n), -M, -cover, q;
    std::iota(basis.begin(), basis.end(), Eigen::Index(0));
  }

  /** Row that leaves the basis when @p column enters: least ratio; -1 on a ray. */
  Eigen::Index leaving(const Eigen::Index column) const
  {
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < n; ++i)
      if (rows(i, column) > negligible && (best < 0 || is_before(i, best, column)))
        best = i;
    return best;
  }

  /** Brings @p column into the basis at @p row; returns the column that leaves. */
  Eigen::Index pivot(const Eigen::Index row, const Eigen::Index column)
  {
    rows.row(row) /= rows(row, column);
    for (Eigen::Index i = 0; i < n; ++i)
      if (i != row && rows(i, column) != 0.)
        rows.row(i) -= rows(i, column) * rows.row(row);
    return std::exchange(basis[static_cast<std::size_t>(row)], column);
  }

  const Eigen::Index n;
  Eigen::MatrixXd rows;
  std::vector<Eigen::Index> basis; ///< basic column of each row

private:
  /** Compares the ratios of q and, if these are equal, of the columns of w. */
  bool
  is_before(const Eigen::Index i, const Eigen::Index j, const Eigen::Index column) const
  {
    const double a = rows(i, column), b = rows(j, column);
    for (Eigen::Index k = -1; k < n; ++k)
      {
        const Eigen::Index c    = k < 0 ? 2 * n + 1 : k;
        const double difference = rows(i, c) / a - rows(j, c) / b;
        if (std::fabs(difference) > 1e-13)
          return difference < 0.;
      }
    return false;
  }
};

/** End of the pivots: a solution, or a ray along which w, z and z_0 may grow. */
struct End
{
  bool is_solution = false;
  Eigen::VectorXd z; ///< empty: the pivots did not end
};

End follow(Tableau tableau, Eigen::Index row)
{
  const Eigen::Index n = tableau.n;
  const auto part_of_z = [&](const Eigen::Index from) {
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i)
      if (const Eigen::Index column = tableau.basis[static_cast<std::size_t>(i)] - n;
          column >= 0 && column < n)
        z[column] = (from > 2 * n ? 1. : -1.) * tableau.rows(i, from);
    return z;
  };
  Eigen::Index left = tableau.pivot(row, 2 * n);
  for (Eigen::Index k = 0; k < 50 * n + 100; ++k)
    {
      const Eigen::Index entering = left < n ? left + n : left - n;
      row                         = tableau.leaving(entering);
      if (row < 0)
        {
          End ray{false, part_of_z(entering)};
          if (entering >= n)
            ray.z[entering - n] = 1.;
          return ray;
        }
      left = tableau.pivot(row, entering);
      if (left == 2 * n)
        return {true, part_of_z(2 * n + 1)};
    }
  return {};
}

End follow(const Eigen::MatrixXd &M,
           const Eigen::VectorXd &q,
           const Eigen::VectorXd &cover)
{
  Eigen::Index row = 0;
  (q.array() / cover.array()).minCoeff(&row);
  if (!(q[row] < 0.))
    return {true, Eigen::VectorXd::Zero(q.size())};
  return follow(Tableau(M, q, cover), row);
}
} // namespace

std::optional<Eigen::VectorXd>
lemke(const Eigen::MatrixXd &M, const Eigen::VectorXd &q, const Eigen::VectorXd &cover)
{
  const End end = follow(M, q, cover);
  return end.is_solution ? std::make_optional(end.z) : std::nullopt;
}

bool is_infeasible(const Eigen::MatrixXd &M, const Eigen::VectorXd &q)
{
  // Optimality conditions of the linear program min 0 z, M z + q >= 0; the matrix is
  // skew-symmetric.
  const Eigen::Index n        = q.size();
  Eigen::MatrixXd both        = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXd right       = Eigen::VectorXd::Zero(2 * n);
  both.topRightCorner(n, n)   = -M.transpose();
  both.bottomLeftCorner(n, n) = M;
  right.tail(n)               = q;
  const End end               = follow(both, right, Eigen::VectorXd::Ones(2 * n));
  if (end.is_solution || end.z.size() == 0)
    return false;
  const Eigen::VectorXd y = end.z.tail(n);
  const double size = y.lpNorm<Eigen::Infinity>(), round_off = 1e-9 * size;
  return size > 0. && y.minCoeff() >= -round_off &&
         (M.transpose() * y).maxCoeff() <= round_off && q.dot(y) < -1e-9 * size;
}
} // namespace mesoslip
