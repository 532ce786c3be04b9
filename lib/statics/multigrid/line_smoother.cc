#include "statics/multigrid/line_smoother.h"

#include <Eigen/Dense>

#include <vector>

namespace mesoslip::multigrid
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

/** What the two ends of a cut line are given for the coupling that closed it. */
template <int n>
struct Closing
{
  Block<n> first = Block<n>::Zero(); ///< added to the block of the first node
  Block<n> last  = Block<n>::Zero(); ///< added to the block of the last node

  /** To be added to the block of node @p i of @p n_nodes. */
  Block<n> at(const unsigned int i, const unsigned int n_nodes) const
  {
    Block<n> sum = Block<n>::Zero();
    if (i == 0)
      sum += first;
    if (i + 1 == n_nodes)
      sum += last;
    return sum;
  }

  Closing() = default;

  /**
   * With @p coupling c between the last node (rows) and the first (columns),
   * 2 x_last.c x_first <= x_last.(c c^T)^(1/2) x_last + x_first.(c^T c)^(1/2) x_first,
   * here for unknowns scaled such that the diagonals of both nodes are one: whatever
   * units displacements and rotations have, and however flat the cells are.
   */
  Closing(const Block<n> &coupling,
          const Block<n> &first_diagonal,
          const Block<n> &last_diagonal)
  {
    if (coupling.isZero(0.))
      return;
    using Scale       = Eigen::DiagonalMatrix<double, n>;
    const Scale left  = Scale(last_diagonal.diagonal().cwiseSqrt()),
                right = Scale(first_diagonal.diagonal().cwiseSqrt());
    const Eigen::JacobiSVD<Block<n>> svd(left.inverse() * coupling * right.inverse(),
                                         Eigen::ComputeFullU | Eigen::ComputeFullV);
    const auto sigma = svd.singularValues().asDiagonal();
    last  = left * Block<n>(svd.matrixU() * sigma * svd.matrixU().transpose()) * left;
    first = right * Block<n>(svd.matrixV() * sigma * svd.matrixV().transpose()) * right;
  }
};

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
  , column_factors(columns_of_grid, rows_of_grid, n_factors)
  , row_factors(columns_of_grid * n_factors * lanes<Number>,
                (rows_of_grid + lanes<Number> - 1) / lanes<Number>,
                1)
  , tile((columns_of_grid + 3) * n_components * lanes<Number>, 1, 1)
  , eliminated(columns_of_grid, 2, n_components)
{
  using B                   = Block<n_components>;
  using P                   = Pivot<n_components>;
  using C                   = Closing<n_components>;
  const auto diagonal_block = [](const LineBlocks<Number> &b, const unsigned int i) {
    return symmetric_block<n_components>(b.centre + i, b.stride);
  };
  std::vector<B, Eigen::aligned_allocator<B>> below(n_columns, B::Zero());
  std::vector<P, Eigen::aligned_allocator<P>> column(n_columns);
  std::vector<C, Eigen::aligned_allocator<C>> closing(n_columns);
  const LineBlocks<Number> bottom = blocks(0);
  for (unsigned int i = 0; i < n_columns; ++i)
    below[i] = diagonal_block(bottom, i);
  const LineBlocks<Number> top = blocks(n_rows - 1);
  for (unsigned int i = 0; i < n_columns; ++i)
    {
      closing[i] = C(full_block<n_components>(top.north + i, top.stride), below[i],
                     diagonal_block(top, i));
      below[i].setZero();
    }
  for (unsigned int j = 0; j < n_rows; ++j)
    {
      const LineBlocks<Number> b = blocks(j);
      const unsigned int last    = n_columns - 1;
      const C row_closing(full_block<n_components>(b.east + last, b.stride),
                          diagonal_block(b, 0), diagonal_block(b, last));
      Number *to_columns = column_factors.row(0, static_cast<int>(j));
      Number *to_rows =
        row_factors.row(0, static_cast<int>(j / lanes<Number>)) + j % lanes<Number>;
      P pivot;
      B left = B::Zero();
      for (unsigned int i = 0; i < n_columns; ++i)
        {
          const B diagonal = diagonal_block(b, i);
          column[i].advance(diagonal + closing[i].at(j, n_rows), below[i]);
          column[i].store(to_columns + i, column_factors.component_stride());
          pivot.advance(diagonal + row_closing.at(i, n_columns), left);
          pivot.store(to_rows + i * n_factors * lanes<Number>, lanes<Number>);
          left     = full_block<n_components>(b.east + i, b.stride);
          below[i] = full_block<n_components>(b.north + i, b.stride);
        }
    }
}

template <int n_components, typename Number>
void LineSmoother<n_components, Number>::columns(NodalField<Number> &r,
                                                 NodalField<Number> &x,
                                                 const bool add) const
{
  const GridKernels<Number> &k = grid_kernels<Number>();
  const unsigned int n         = whole_vectors<Number>(n_columns);
  const std::size_t s          = column_factors.component_stride();
  const auto rows_of           = [](NodalField<Number> &field, const unsigned int j,
                          Number *to[3]) {
    for (unsigned int c = 0; c < n_components; ++c)
      to[c] = field.row(c, j);
  };
  Number *row[3], *other[3], *buffer[3], *before[3];
  for (unsigned int j = 0; j < n_rows; ++j)
    {
      rows_of(r, j, row);
      for (unsigned int c = 0; c < n_components; ++c)
        {
          buffer[c] = eliminated.row(c, j % 2);
          before[c] = eliminated.row(c, 1 - j % 2);
        }
      k.eliminate[n_components - 2](n, column_factors.row(0, j), s,
                                    j == 0 ? nullptr : before, buffer, row);
    }
  for (unsigned int j = n_rows; j-- > 0;)
    {
      const bool last = j + 1 == n_rows;
      rows_of(r, j, row);
      rows_of(r, last ? j : j + 1, before);
      rows_of(x, j, other);
      k.substitute[n_components - 2](n, last ? nullptr : column_factors.row(0, j + 1), s,
                                     before, row, static_cast<Number>(damping), add,
                                     other);
    }
}

template <int n_components, typename Number>
void LineSmoother<n_components, Number>::rows(const NodalField<Number> &r,
                                              NodalField<Number> &x) const
{
  const GridKernels<Number> &k = grid_kernels<Number>();
  Number *t                    = tile.row(0, 0);
  for (unsigned int j0 = 0; j0 < n_rows; j0 += lanes<Number>)
    {
      // Lanes beyond the last row repeat it; what they hold is not used.
      const unsigned int n_lanes =
        n_rows - j0 < lanes<Number> ? n_rows - j0 : lanes<Number>;
      for (unsigned int c = 0; c < n_components; ++c)
        {
          const Number *from[lanes<Number>];
          for (unsigned int l = 0; l < lanes<Number>; ++l)
            from[l] = r.row(c, j0 + (l < n_lanes ? l : n_lanes - 1));
          k.load_tile(n_columns, n_components, from, t + c * lanes<Number>);
        }
      k.solve_tile[n_components - 2](
        n_columns, row_factors.row(0, static_cast<int>(j0 / lanes<Number>)), t);
      for (unsigned int c = 0; c < n_components; ++c)
        {
          Number *to[lanes<Number>];
          for (unsigned int l = 0; l < n_lanes; ++l)
            to[l] = x.row(c, j0 + l);
          k.add_tile(n_columns, n_components, n_lanes, t + c * lanes<Number>,
                     static_cast<Number>(damping), to);
        }
    }
}

template class LineSmoother<2, float>;
template class LineSmoother<2, double>;
template class LineSmoother<3, float>;
template class LineSmoother<3, double>;
} // namespace mesoslip::multigrid
