#include "statics/multigrid/stencil.h"

#include <array>

namespace mesoslip
{
namespace multigrid
{
namespace
{
/** Where the block between corners a <= b of a cell goes: an array of the node at a. */
struct CornerBlock
{
  unsigned int a, b;
  unsigned int array;
};

constexpr std::array<CornerBlock, 10> blocks = {{{0, 0, centre},
                                                 {1, 1, centre},
                                                 {2, 2, centre},
                                                 {3, 3, centre},
                                                 {0, 1, east},
                                                 {2, 3, east},
                                                 {0, 2, north},
                                                 {1, 3, north},
                                                 {0, 3, north_east},
                                                 {1, 2, north_west}}};

/** Position of entry (r, c), r <= c, in the upper triangle of an n x n matrix. */
unsigned int upper(const unsigned int n, const unsigned int r, const unsigned int c)
{
  return r * n - r * (r - 1) / 2 + (c - r);
}
} // namespace

template <typename Number>
Stencil<Number>::Stencil(const Axis &x, const Axis &y)
  : periodic_x(x.periodic)
  , periodic_y(y.periodic)
  , arrays(n_stencil_arrays, y.n_nodes(), x.n_nodes())
{
}

template <typename Number>
void Stencil<Number>::add_cell_row(const unsigned int j,
                                   const PaddedRows<double> &matrices)
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

template <typename Number>
void Stencil<Number>::finish(const HeldUnknowns &held)
{
  constexpr unsigned int diagonal[3] = {0, 3, 5};
  const int n                        = static_cast<int>(arrays.n_rows());
  for (int j = 0; j < n; ++j)
    {
      for (unsigned int c = 0; c < 3; ++c)
        {
          Number *d = arrays.row(centre + diagonal[c], j);
          for (unsigned int i = 0; i < arrays.n_columns(); ++i)
            if (!(d[i] > 0))
              d[i] = 1;
        }
      for (const HeldUnknowns::Node &node : held.row(static_cast<unsigned int>(j)))
        for (unsigned int c = 0; c < 3; ++c)
          if (node.holds(c))
            arrays.row(centre + diagonal[c], j)[node.column] = 1;
    }
  arrays.fill_ghosts(periodic_x, periodic_y);
}

template <typename Number>
void Stencil<Number>::residual(PaddedRows<Number> &x,
                               const PaddedRows<Number> &b,
                               PaddedRows<Number> &r) const
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
      k.stencil_residual(n, arrays.row(0, j), arrays.row(0, j - 1), arrays.array_stride(),
                         rows, right, result);
    }
}

template <typename Number>
Eigen::MatrixXd Stencil<Number>::dense() const
{
  const unsigned int nx = arrays.n_columns(), ny = arrays.n_rows();
  const Eigen::Index n_unknowns = Eigen::Index{3} * nx * ny;
  Eigen::MatrixXd matrix        = Eigen::MatrixXd::Zero(n_unknowns, n_unknowns);
  const auto add                = [&](const unsigned int from, const int i, const int j,
                       const unsigned int array) {
    if ((!periodic_x && (i < 0 || i >= static_cast<int>(nx))) ||
        (!periodic_y && j >= static_cast<int>(ny)))
      return;
    const unsigned int to = (j % ny) * nx + (i + nx) % nx;
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const double value =
            arrays.row(array + 3 * r + c, static_cast<int>(from / nx))[from % nx];
          matrix(3 * from + r, 3 * to + c) += value;
          matrix(3 * to + c, 3 * from + r) += value;
        }
  };
  for (unsigned int node = 0; node < nx * ny; ++node)
    {
      const int i = static_cast<int>(node % nx), j = static_cast<int>(node / nx);
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = r; c < 3; ++c)
          {
            const double value = arrays.row(centre + upper(3, r, c), j)[i];
            matrix(3 * node + r, 3 * node + c) += value;
            if (c != r)
              matrix(3 * node + c, 3 * node + r) += value;
          }
      add(node, i + 1, j, east);
      add(node, i - 1, j + 1, north_west);
      add(node, i, j + 1, north);
      add(node, i + 1, j + 1, north_east);
    }
  return matrix;
}

template class Stencil<float>;
template class Stencil<double>;
} // namespace multigrid
} // namespace mesoslip
