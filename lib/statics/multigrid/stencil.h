#ifndef mesoslip_statics_multigrid_stencil_h
#define mesoslip_statics_multigrid_stencil_h

#include "grid/nodal_field.h"
#include "statics/multigrid/axis.h"
#include "statics/multigrid/kernels/kernels.h"

#include <Eigen/Core>

namespace mesoslip::multigrid
{
/**
 * The operator of a coarse grid as a symmetric 9-point stencil of 3x3 blocks; arrays are
 * listed in StencilArray, one row of each array per node row. Single precision on the
 * first coarse grid, double on coarser grids.
 */
template <typename Number>
class Stencil
{
public:
  Stencil() = default;

  /** A stencil with all entries zero. */
  Stencil(const Axis &x, const Axis &y)
    : periodic_x(x.periodic)
    , periodic_y(y.periodic)
    , arrays(x.n_nodes(), y.n_nodes(), n_stencil_arrays)
  {
  }

  /** Adds the matrices of cell row @p j (n_cell_entries arrays of one row). */
  void add_cell_row(const unsigned int j, const NodalField<double> &matrices)
  {
    const unsigned int n_cells = matrices.n_columns();
    for (const CornerBlock &block : blocks)
      {
        const int row            = static_cast<int>((j + block.a / 2) % arrays.n_rows());
        const unsigned int shift = block.a % 2;
        for (unsigned int r = 0; r < 3; ++r)
          for (unsigned int c = block.a == block.b ? r : 0; c < 3; ++c)
            {
              const unsigned int k =
                block.a == block.b ? upper(3, r, c) : block.array + 3 * r + c;
              const double *from =
                matrices.row(upper(12, 3 * block.a + r, 3 * block.b + c), 0);
              Number *to = arrays.row(k, row);
              for (unsigned int i = 0; i < n_cells; ++i)
                to[i + shift] += static_cast<Number>(from[i]);
              if (periodic_x && shift == 1)
                {
                  to[0] += to[n_cells];
                  to[n_cells] = 0;
                }
            }
      }
  }

  /** Call it after the last row: constrained and empty rows get a unit diagonal, ghosts
   * are filled. */
  void finish(const ConstrainedUnknowns &constrained)
  {
    constexpr unsigned int diagonal[3] = {0, 3, 5};
    for (unsigned int j = 0; j < arrays.n_rows(); ++j)
      {
        for (unsigned int c = 0; c < 3; ++c)
          {
            Number *d = arrays.row(centre + diagonal[c], j);
            for (unsigned int i = 0; i < arrays.n_columns(); ++i)
              if (!(d[i] > 0))
                d[i] = 1;
          }
        for (const ConstrainedUnknowns::Node &node : constrained.row(j))
          for (unsigned int c = 0; c < 3; ++c)
            if (node.has(c))
              arrays.row(centre + diagonal[c], j)[node.column] = 1;
      }
    arrays.fill_ghosts(periodic_x, periodic_y);
  }

  /** r = b - A x; fills the ghosts of @p x. Three components. */
  void residual(NodalField<Number> &x,
                const NodalField<Number> &b,
                NodalField<Number> &r) const
  {
    x.fill_ghosts(periodic_x, periodic_y);
    const unsigned int n         = whole_vectors<Number>(arrays.n_columns());
    const GridKernels<Number> &k = grid_kernels<Number>();
    for (int j = 0; j < static_cast<int>(arrays.n_rows()); ++j)
      {
        const Number *rows[9], *right[3];
        Number *result[3];
        for (unsigned int c = 0; c < 3; ++c)
          {
            for (int dj = -1; dj <= 1; ++dj)
              rows[3 * (dj + 1) + static_cast<int>(c)] = x.row(c, j + dj);
            right[c]  = b.row(c, j);
            result[c] = r.row(c, j);
          }
        k.stencil_residual(n, arrays.row(0, j), arrays.row(0, j - 1),
                           arrays.component_stride(), rows, right, result);
      }
  }

  /** Array @p k of node row @p j. */
  const Number *row(const unsigned int k, const int j) const
  {
    return arrays.row(k, j);
  }

  /** Distance between two arrays of a row. */
  std::size_t component_stride() const
  {
    return arrays.component_stride();
  }

  /** The whole matrix; unknown 3 (j n_columns + i) + c. For small grids. */
  Eigen::MatrixXd dense() const
  {
    const unsigned int nx = arrays.n_columns(), n = 3 * nx * arrays.n_rows();
    NodalField<Number> x(nx, arrays.n_rows(), 3), zero(x), r(x);
    const auto entry = [nx](NodalField<Number> &field, const unsigned int k) -> Number & {
      return field(k % 3, {k / 3 % nx, k / 3 / nx});
    };
    Eigen::MatrixXd matrix(n, n);
    for (unsigned int k = 0; k < n; ++k)
      {
        x.set_zero();
        entry(x, k) = 1;
        residual(x, zero, r);
        for (unsigned int l = 0; l < n; ++l)
          matrix(l, k) = -entry(r, l);
      }
    return matrix;
  }

private:
  /** Array (of the node at corner a) for the block between corners a <= b of a cell. */
  struct CornerBlock
  {
    unsigned int a, b;
    unsigned int array;
  };

  static constexpr CornerBlock blocks[10] = {
    {0, 0, centre},     {1, 1, centre},    {2, 2, centre}, {3, 3, centre},
    {0, 1, east},       {2, 3, east},      {0, 2, north},  {1, 3, north},
    {0, 3, north_east}, {1, 2, north_west}};

  /** Position of entry (r, c), r <= c, in the upper triangle of an n x n matrix. */
  static unsigned int
  upper(const unsigned int n, const unsigned int r, const unsigned int c)
  {
    return r * n - r * (r - 1) / 2 + (c - r);
  }

  bool periodic_x = false;
  bool periodic_y = false;
  NodalField<Number> arrays;
};
} // namespace mesoslip::multigrid

#endif
