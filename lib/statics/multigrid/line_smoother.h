#ifndef mesoslip_statics_multigrid_line_smoother_h
#define mesoslip_statics_multigrid_line_smoother_h

#include "grid/nodal_field.h"
#include "statics/multigrid/kernels/kernels.h"

#include <functional>

namespace mesoslip::multigrid
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
   *  overwritten. */
  void columns(NodalField<Number> &r, NodalField<Number> &x, const bool add) const;

  /** The same with rows; always adds. */
  void rows(const NodalField<Number> &r, NodalField<Number> &x) const;

private:
  static constexpr unsigned int n_factors = n_factor_entries(n_components);

  unsigned int n_columns = 0;
  unsigned int n_rows    = 0;
  NodalField<Number> column_factors;
  /** One row a tile of lines: [column][entry][lane]. */
  NodalField<Number> row_factors;
  mutable NodalField<Number> tile;
  /** Two rows of eliminated right-hand sides. */
  mutable NodalField<Number> eliminated;
};

extern template class LineSmoother<2, float>;
extern template class LineSmoother<2, double>;
extern template class LineSmoother<3, float>;
extern template class LineSmoother<3, double>;
} // namespace mesoslip::multigrid

#endif
