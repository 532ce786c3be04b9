#include "elasticity/multigrid/line_smoother.h"

#include <Eigen/Dense>

#include <vector>

namespace mesoslip
{
namespace multigrid
{
namespace
{
template <int n>
using Block = Eigen::Matrix<double, n, n>;

template <int n, typename Number>
Block<n> symmetric_block(const Number *upper, const std::size_t stride)
{
  Block<n> block;
  for (int r = 0; r < n; ++r)
    for (int c = r; c < n; ++c, upper += stride)
      block(r, c) = block(c, r) = *upper;
  return block;
}

template <int n, typename Number>
Block<n> full_block(const Number *entries, const std::size_t stride)
{
  Block<n> block;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c, entries += stride)
      block(r, c) = *entries;
  return block;
}

/** Inverse of a pivot; round-off may leave one indefinite, then of its diagonal part. */
template <int n>
Block<n> safe_inverse(const Block<n> &pivot, const Block<n> &diagonal)
{
  double determinant = pivot(0, 0) * pivot(1, 1) - pivot(0, 1) * pivot(0, 1);
  bool positive      = pivot(0, 0) > 0. && determinant > 0.;
  if constexpr (n == 3)
    positive = positive && pivot.determinant() > 0.;
  if (positive)
    return pivot.inverse();
  return Block<n>(diagonal.diagonal().cwiseInverse().asDiagonal());
}

/** One step of a block LDL^T factorization along a line. */
template <int n>
struct Pivot
{
  Block<n> inverse = Block<n>::Zero();
  Block<n> multiplier;

  /** @p coupling: previous node (rows) with this one (columns). */
  void advance(const Block<n> &diagonal, const Block<n> &coupling)
  {
    const Block<n> product = inverse * coupling;
    multiplier             = product.transpose();
    inverse = safe_inverse<n>(diagonal - coupling.transpose() * product, diagonal);
  }

  template <typename Number>
  void store(Number *to, const std::size_t stride) const
  {
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c, to += stride)
        *to = static_cast<Number>(multiplier(r, c));
    for (int r = 0; r < n; ++r)
      for (int c = r; c < n; ++c, to += stride)
        *to = static_cast<Number>(inverse(r, c));
  }
};
} // namespace

template <int n_components, typename Number>
LineSmoother<n_components, Number>::LineSmoother(
  const unsigned int columns_of_grid,
  const unsigned int rows_of_grid,
  const std::function<LineBlocks<Number>(unsigned int)> &blocks)
  : n_columns(columns_of_grid)
  , n_rows(rows_of_grid)
  , column_factors(n_factors, rows_of_grid, columns_of_grid)
  , row_factors(1,
                (rows_of_grid + lanes<Number> - 1) / lanes<Number>,
                columns_of_grid * n_factors * lanes<Number>)
  , tile(1, 1, (columns_of_grid + 3) * n_components * lanes<Number>)
  , eliminated(n_components, 2, columns_of_grid)
{
  using B = Block<n_components>;
  std::vector<Pivot<n_components>, Eigen::aligned_allocator<Pivot<n_components>>> column(
    n_columns);
  std::vector<B, Eigen::aligned_allocator<B>> below(n_columns, B::Zero());
  for (unsigned int j = 0; j < n_rows; ++j)
    {
      const LineBlocks<Number> b = blocks(j);
      Number *to_columns         = column_factors.row(0, static_cast<int>(j));
      Number *to_rows =
        row_factors.row(0, static_cast<int>(j / lanes<Number>)) + j % lanes<Number>;
      Pivot<n_components> pivot;
      B left = B::Zero();
      for (unsigned int i = 0; i < n_columns; ++i)
        {
          const B diagonal = symmetric_block<n_components>(b.centre + i, b.stride);
          column[i].advance(diagonal, below[i]);
          column[i].store(to_columns + i, column_factors.array_stride());
          pivot.advance(diagonal, left);
          pivot.store(to_rows + i * n_factors * lanes<Number>, lanes<Number>);
          left     = full_block<n_components>(b.east + i, b.stride);
          below[i] = full_block<n_components>(b.north + i, b.stride);
        }
    }
}

template class LineSmoother<2, float>;
template class LineSmoother<3, float>;
template class LineSmoother<3, double>;
} // namespace multigrid
} // namespace mesoslip
