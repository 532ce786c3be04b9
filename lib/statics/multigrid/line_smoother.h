#ifndef mesoslip_statics_multigrid_line_smoother_h
#define mesoslip_statics_multigrid_line_smoother_h

#include "grid/padded_rows.h"
#include "statics/multigrid/kernels/kernels.h"

#include <functional>

namespace mesoslip
{
namespace multigrid
{
/** The blocks of one node row that lines need: of nodes with themselves (upper triangle),
 *  with their right and with their upper neighbours. Arrays @p stride apart. */
template <typename Number>
struct LineBlocks
{
  const Number *centre; ///< of a node with itself
  const Number *east;   ///< with its right neighbour
  const Number *north;  ///< with its upper neighbour
  std::size_t stride;   ///< numbers from one array to the next
};

/**
 * Damped block Jacobi iterations the blocks of which are whole columns or whole rows of
 * nodes. Stiff fibres, once the grid is coarse, are chains of nodes that hold together
 * firmly and to nothing else; a point smoother would need as many sweeps as the contrast.
 *
 * With T the blocks of K, no eigenvalue of T^-1 K exceeds 2, and any damping below 1
 * converges. For K is a sum of positive semidefinite matrices of cells, each of which
 * touches two columns, left and right: 2 x_l.K_lr x_r <= x_l.K_ll x_l + x_r.K_rr x_r,
 * hence K_cell <= 2 (K_ll + K_rr), and the sum of the right sides is 2 T. This holds for
 * any number of columns, odd or even, closed periodically or not, one column that is its
 * own neighbour included, for rows, and on coarse grids, whose matrices are sums over
 * cells as well.
 *
 * Lines that close periodically are cut, as a factorization of closed ones costs twice as
 * much: the blocks of the two ends take the absolute value of the coupling c between
 * them instead, 2 x.c y <= x.(c c^T)^(1/2) x + y.(c^T c)^(1/2) y, which only adds to T.
 */
template <int n_components, typename Number>
class LineSmoother
{
public:
  LineSmoother() = default;

  /** Factorizes the lines of @p columns_of_grid x @p rows_of_grid nodes; @p blocks is
   *  asked for one row after the other. */
  LineSmoother(const unsigned int columns_of_grid,
               const unsigned int rows_of_grid,
               const std::function<LineBlocks<Number>(unsigned int)> &blocks);

  double damping = 0.8; ///< of the line Jacobi step

  /** x += damping T^-1 r, or x = ... unless @p add; T holds the columns alone. @p r is
   *  overwritten. Field: NodalField<Number> or PaddedRows<Number>. */
  template <typename Field>
  void columns(Field &r, Field &x, const bool add) const;

  /** The same with rows; always adds. */
  template <typename Field>
  void rows(const Field &r, Field &x) const;

private:
  static constexpr unsigned int n_factors = n_factor_entries(n_components);

  unsigned int n_columns = 0;
  unsigned int n_rows    = 0;
  PaddedRows<Number> column_factors;
  /** One row a tile of lines: [column][entry][lane]. */
  PaddedRows<Number> row_factors;
  mutable PaddedRows<Number> tile;
  /** Two rows of eliminated right-hand sides. */
  mutable PaddedRows<Number> eliminated;
};

template <int n_components, typename Number>
template <typename Field>
void LineSmoother<n_components, Number>::columns(Field &r, Field &x, const bool add) const
{
  const GridKernels<Number> &k = grid_kernels<Number>();
  const unsigned int n         = whole_vectors<Number>(n_columns);
  const std::size_t s          = column_factors.array_stride();
  const auto rows_of           = [](Field &field, const unsigned int j, Number *to[3]) {
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
template <typename Field>
void LineSmoother<n_components, Number>::rows(const Field &r, Field &x) const
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

extern template class LineSmoother<2, float>;
extern template class LineSmoother<2, double>;
extern template class LineSmoother<3, float>;
extern template class LineSmoother<3, double>;
} // namespace multigrid
} // namespace mesoslip

#endif
