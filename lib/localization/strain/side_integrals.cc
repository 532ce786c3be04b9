#include "localization/strain/side_integrals.h"

#include <cmath>

namespace mesoslip
{
namespace
{
/** Adds @p value to @p sum with compensation @p lost (Neumaier): the sums over opposite
 * sides are large relative to their difference. */
void add_exactly(const double value, double &sum, double &lost)
{
  const double next = sum + value;
  lost +=
    std::fabs(sum) >= std::fabs(value) ? (sum - next) + value : (value - next) + sum;
  sum = next;
}

/** Adds the contribution of a side, across axis @p d, of cell number @p cell of the known
 * cells to the integrals. */
template <int dim>
class SideSum
{
public:
  SideSum(const UniformGrid<dim> &of_grid,
          const CellBlock<dim> &known,
          const double *of_nodes,
          double *of_sides)
    : part{known.cells, of_grid.spacing, {}}
    , u(of_nodes)
    , sums(of_sides)
  {
  }

  void add(const std::array<unsigned int, dim> &cell,
           const unsigned int d,
           const bool is_upper)
  {
    const auto nodes = part.corners(
      static_cast<unsigned int>(CellBlock<dim>{{}, part.cells}.number_of(cell)));
    const double share =
      (is_upper ? 1. : -1.) * part.cell_measure() / part.spacing[d] / (1U << (dim - 1));
    for (unsigned int v = 0; v < nodes.size(); ++v)
      if ((v >> d & 1U) == (is_upper ? 1U : 0U))
        for (unsigned int c = 0; c < dim; ++c)
          {
            constexpr std::size_t n = dim;
            const std::size_t k     = c * n + d;
            add_exactly(share * u[nodes[v] * n + c], sums[k], sums[n * n + k]);
          }
  }

private:
  const UniformGrid<dim> part;
  const double *u;
  double *sums;
};
} // namespace

template <int dim>
void add_side_integrals(const UniformGrid<dim> &grid,
                        const CellBlock<dim> &known,
                        const double *u,
                        const unsigned int begin,
                        const unsigned int end,
                        double *sums)
{
  SideSum<dim> sum(grid, known, u, sums);
  const unsigned int last = dim - 1, n_y = dim == 3 ? grid.cells[1] : 1;
  for (unsigned int layer = begin; layer < end; ++layer)
    for (unsigned int y = 0; y < n_y; ++y)
      {
        std::array<unsigned int, dim> at = {};
        if (dim == 3)
          at[1] = y;
        const auto is_end = [](const unsigned int k, const unsigned int n) {
          return k == 0 || k + 1 == n;
        };
        // In most rows only both ends are at a side.
        const bool whole =
          is_end(layer, grid.cells[last]) || (dim == 3 && is_end(y, n_y));
        const unsigned int n = grid.cells[0];
        for (unsigned int x = 0; x < n; x += whole || x + 1 == n ? 1 : n - 1)
          {
            at[0]    = x;
            at[last] = layer - known.first[last];
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int k = d == last ? layer : at[d];
                if (k == 0)
                  sum.add(at, d, false);
                if (k + 1 == grid.cells[d])
                  sum.add(at, d, true);
              }
          }
      }
}

template <int dim>
VoigtVector<dim> mean_strain(const UniformGrid<dim> &grid, const double *sums)
{
  const double volume     = static_cast<double>(grid.n_cells()) * grid.cell_measure();
  VoigtVector<dim> strain = VoigtVector<dim>::Zero();
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int d = 0; d < dim; ++d)
      strain[voigt_index<dim>(c, d)] +=
        (sums[c * dim + d] + sums[dim * dim + c * dim + d]) / volume;
  return strain;
}

template void add_side_integrals<2>(const UniformGrid<2> &,
                                    const CellBlock<2> &,
                                    const double *,
                                    const unsigned int,
                                    const unsigned int,
                                    double *);
template void add_side_integrals<3>(const UniformGrid<3> &,
                                    const CellBlock<3> &,
                                    const double *,
                                    const unsigned int,
                                    const unsigned int,
                                    double *);
template VoigtVector<2> mean_strain(const UniformGrid<2> &, const double *);
template VoigtVector<3> mean_strain(const UniformGrid<3> &, const double *);
} // namespace mesoslip
