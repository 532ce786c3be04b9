#ifndef mesoslip_statics_multigrid_line_smoother_h
#define mesoslip_statics_multigrid_line_smoother_h

#include "grid/nodal_field.h"
#include "statics/multigrid/kernels/kernels.h"

#include <Eigen/Dense>

#include <functional>
#include <vector>

namespace mesoslip::multigrid
{
/** Blocks of one node row needed by lines: of nodes with themselves (upper triangle),
 * with their right and with their upper neighbours. Arrays @p stride apart. */
template <typename Number>
struct LineBlocks
{
  const Number *centre; ///< block of a node with itself
  const Number *east;   ///< block with its right neighbour
  const Number *north;  ///< block with its upper neighbour
  std::size_t stride;   ///< distance between arrays
};

/**
 * Damped block Jacobi iterations whose blocks are whole columns or whole rows of nodes.
 * Once the grid is coarse, stiff fibres are chains of nodes coupled strongly to each
 * other and weakly to all else; a point smoother would need a number of sweeps
 * proportional to the contrast.
 *
 * With T the blocks of K, no eigenvalue of T^-1 K exceeds 2, and any damping below 1
 * converges. Proof: K is a sum of positive semidefinite matrices of cells, each of which
 * touches two columns, left and right: 2 x_l.K_lr x_r <= x_l.K_ll x_l + x_r.K_rr x_r,
 * hence K_cell <= 2 (K_ll + K_rr), and the sum of the right sides is 2 T. This holds for
 * any number of columns, periodic or not, including a single column that is its own
 * neighbour, for rows, and on coarse grids, whose matrices are sums over cells as well.
 *
 * Periodic lines are cut, as factorization of closed lines costs twice as much: instead
 * of the coupling c, the blocks of both ends get its absolute values, 2 x.c y <= x.(c
 * c^T)^(1/2) x + y.(c^T c)^(1/2) y, which only increases T.
 */
template <int n_components, typename Number>
class LineSmoother
{
public:
  LineSmoother() = default;

  /** Factorizes the lines of @p columns_of_grid x @p rows_of_grid nodes; @p blocks is
   * called for one row after the other. */
  LineSmoother(const unsigned int columns_of_grid,
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
    const auto diagonal_block = [](const LineBlocks<Number> &b, const unsigned int i) {
      return symmetric_block(b.centre + i, b.stride);
    };
    std::vector<Block, Eigen::aligned_allocator<Block>> below(n_columns, Block::Zero());
    std::vector<Pivot, Eigen::aligned_allocator<Pivot>> column(n_columns);
    std::vector<Closing, Eigen::aligned_allocator<Closing>> closing(n_columns);
    const LineBlocks<Number> bottom = blocks(0);
    for (unsigned int i = 0; i < n_columns; ++i)
      below[i] = diagonal_block(bottom, i);
    const LineBlocks<Number> top = blocks(n_rows - 1);
    for (unsigned int i = 0; i < n_columns; ++i)
      {
        closing[i] = Closing(full_block(top.north + i, top.stride), below[i],
                             diagonal_block(top, i));
        below[i].setZero();
      }
    for (unsigned int j = 0; j < n_rows; ++j)
      {
        const LineBlocks<Number> b = blocks(j);
        const unsigned int last    = n_columns - 1;
        const Closing row_closing(full_block(b.east + last, b.stride),
                                  diagonal_block(b, 0), diagonal_block(b, last));
        Number *to_columns = column_factors.row(0, static_cast<int>(j));
        Number *to_rows =
          row_factors.row(0, static_cast<int>(j / lanes<Number>)) + j % lanes<Number>;
        Pivot pivot;
        Block left = Block::Zero();
        for (unsigned int i = 0; i < n_columns; ++i)
          {
            const Block diagonal = diagonal_block(b, i);
            column[i].advance(diagonal + closing[i].at(j, n_rows), below[i]);
            column[i].store(to_columns + i, column_factors.component_stride());
            pivot.advance(diagonal + row_closing.at(i, n_columns), left);
            pivot.store(to_rows + i * n_factors * lanes<Number>, lanes<Number>);
            left     = full_block(b.east + i, b.stride);
            below[i] = full_block(b.north + i, b.stride);
          }
      }
  }

  double damping = 0.8; ///< damping of the line Jacobi step

  /** Column step: x += damping T^-1 r, or x = ... unless @p add; T holds the columns
   * only. @p r is overwritten. */
  void columns(NodalField<Number> &r, NodalField<Number> &x, const bool add) const
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
        k.substitute[n_components - 2](n, last ? nullptr : column_factors.row(0, j + 1),
                                       s, before, row, static_cast<Number>(damping), add,
                                       other);
      }
  }

  /** Row step; always adds. */
  void rows(const NodalField<Number> &r, NodalField<Number> &x) const
  {
    const GridKernels<Number> &k = grid_kernels<Number>();
    Number *t                    = tile.row(0, 0);
    for (unsigned int j0 = 0; j0 < n_rows; j0 += lanes<Number>)
      {
        // Lanes beyond the last row repeat it; their results are not used.
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

private:
  using Block = Eigen::Matrix<double, n_components, n_components>;

  static Block symmetric_block(const Number *upper, const std::size_t stride)
  {
    Block block;
    for (int r = 0; r < n_components; ++r)
      for (int c = r; c < n_components; ++c, upper += stride)
        block(r, c) = block(c, r) = *upper;
    return block;
  }

  static Block full_block(const Number *entries, const std::size_t stride)
  {
    Block block;
    for (int r = 0; r < n_components; ++r)
      for (int c = 0; c < n_components; ++c, entries += stride)
        block(r, c) = *entries;
    return block;
  }

  /** Inverse of a pivot; if round-off makes it indefinite, inverse of its diagonal
   * part. */
  static Block safe_inverse(const Block &pivot, const Block &diagonal)
  {
    double determinant = pivot(0, 0) * pivot(1, 1) - pivot(0, 1) * pivot(0, 1);
    bool positive      = pivot(0, 0) > 0. && determinant > 0.;
    if constexpr (n_components == 3)
      positive = positive && pivot.determinant() > 0.;
    if (positive)
      return pivot.inverse();
    return Block(diagonal.diagonal().cwiseInverse().asDiagonal());
  }

  /** Replacement for the coupling between the two ends of a cut periodic line. */
  struct Closing
  {
    Block first = Block::Zero(); ///< added to the block of the first node
    Block last  = Block::Zero(); ///< added to the block of the last node

    /** Block to be added at node @p i of @p n_nodes. */
    Block at(const unsigned int i, const unsigned int n_nodes) const
    {
      Block sum = Block::Zero();
      if (i == 0)
        sum += first;
      if (i + 1 == n_nodes)
        sum += last;
      return sum;
    }

    Closing() = default;

    /**
     * With @p coupling c between the last node (rows) and the first (columns), 2
     * x_last.c x_first <= x_last.(c c^T)^(1/2) x_last + x_first.(c^T c)^(1/2) x_first.
     * Unknowns are scaled such that the diagonals of both nodes are one: this makes the
     * result independent of the units of displacements and rotations and of the aspect
     * of cells.
     */
    Closing(const Block &coupling,
            const Block &first_diagonal,
            const Block &last_diagonal)
    {
      if (coupling.isZero(0.))
        return;
      using Scale       = Eigen::DiagonalMatrix<double, n_components>;
      const Scale left  = Scale(last_diagonal.diagonal().cwiseSqrt()),
                  right = Scale(first_diagonal.diagonal().cwiseSqrt());
      const Eigen::JacobiSVD<Block> svd(left.inverse() * coupling * right.inverse(),
                                        Eigen::ComputeFullU | Eigen::ComputeFullV);
      const auto sigma = svd.singularValues().asDiagonal();
      last  = left * Block(svd.matrixU() * sigma * svd.matrixU().transpose()) * left;
      first = right * Block(svd.matrixV() * sigma * svd.matrixV().transpose()) * right;
    }
  };

  /** A step of a block LDL^T factorization along a line. */
  struct Pivot
  {
    Block inverse = Block::Zero();
    Block multiplier;

    /** @p coupling: block of the previous node (rows) with this node (columns). */
    void advance(const Block &diagonal, const Block &coupling)
    {
      const Block product = inverse * coupling;
      multiplier          = product.transpose();
      inverse = safe_inverse(diagonal - coupling.transpose() * product, diagonal);
    }

    void store(Number *to, const std::size_t stride) const
    {
      for (int r = 0; r < n_components; ++r)
        for (int c = 0; c < n_components; ++c, to += stride)
          *to = static_cast<Number>(multiplier(r, c));
      for (int r = 0; r < n_components; ++r)
        for (int c = r; c < n_components; ++c, to += stride)
          *to = static_cast<Number>(inverse(r, c));
    }
  };

  static constexpr unsigned int n_factors = n_factor_entries(n_components);

  unsigned int n_columns = 0;
  unsigned int n_rows    = 0;
  NodalField<Number> column_factors;
  /** A row per tile of lines: [column][entry][lane]. */
  NodalField<Number> row_factors;
  mutable NodalField<Number> tile;
  /** Two rows of eliminated right-hand sides. */
  mutable NodalField<Number> eliminated;
};
} // namespace mesoslip::multigrid

#endif
