#include "dynamics/deformation.h"

#include "base/object_exchange.h"
#include "mesh/linear_cell.h"

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mesoslip
{
namespace
{
/** Values of the cells of one row: squares, which suffice for comparison. */
struct RowValues
{
  std::vector<double> strain, rotation, minus_jacobian;
};

// Without branches, so that the compiler vectorizes the loop.
void evaluate_row(const double *ux,
                  const double *uy,
                  const double *above_ux,
                  const double *above_uy,
                  const double inverse_hx,
                  const double inverse_hy,
                  RowValues &values)
{
  double *strain = values.strain.data(), *rotation = values.rotation.data(),
         *minus_jacobian = values.minus_jacobian.data();
  const std::size_t n    = values.strain.size();
  for (std::size_t i = 0; i < n; ++i)
    {
      const double xx0 = (ux[i + 1] - ux[i]) * inverse_hx,
                   xx1 = (above_ux[i + 1] - above_ux[i]) * inverse_hx,
                   yx0 = (uy[i + 1] - uy[i]) * inverse_hx,
                   yx1 = (above_uy[i + 1] - above_uy[i]) * inverse_hx,
                   xy0 = (above_ux[i] - ux[i]) * inverse_hy,
                   xy1 = (above_ux[i + 1] - ux[i + 1]) * inverse_hy,
                   yy0 = (above_uy[i] - uy[i]) * inverse_hy,
                   yy1 = (above_uy[i + 1] - uy[i + 1]) * inverse_hy;
      const double xx = 0.5 * (xx0 + xx1), yy = 0.5 * (yy0 + yy1);
      const double xy = 0.5 * (xy0 + xy1), yx = 0.5 * (yx0 + yx1);
      strain[i]   = xx * xx + yy * yy + 0.5 * (xy + yx) * (xy + yx);
      rotation[i] = 0.25 * (yx - xy) * (yx - xy);
      // Corner values; the first index refers to the edge along x.
      const double j00  = (1. + xx0) * (1. + yy0) - xy0 * yx0,
                   j01  = (1. + xx0) * (1. + yy1) - xy1 * yx0,
                   j10  = (1. + xx1) * (1. + yy0) - xy0 * yx1,
                   j11  = (1. + xx1) * (1. + yy1) - xy1 * yx1;
      const double low  = j00 < j01 ? j00 : j01;
      const double high = j10 < j11 ? j10 : j11;
      // Comparisons ignore NaN, the sum does not.
      minus_jacobian[i] = -((low < high ? low : high) + 0. * strain[i]);
    }
}

/** Squares of strain and rotation, and the negative Jacobian, which are to be largest. */
using Extremes = std::array<CellExtreme, 3>;

Extremes none()
{
  Extremes extremes;
  extremes[2].value = -std::numeric_limits<double>::infinity();
  return extremes;
}

/** Whether @p best changes; of equal values the first cell counts, NaN is infinite. */
bool take_larger(CellExtreme &best, double value, const std::uint64_t cell)
{
  if (std::isnan(value))
    value = std::numeric_limits<double>::infinity();
  if (!(value > best.value || (value == best.value && cell < best.cell)))
    return false;
  best.value = value;
  best.cell  = cell;
  return true;
}

/** Maxima over all ranks. */
Deformation over_ranks(const Extremes &found, const MPI_Comm communicator)
{
  Extremes all = found;
  int n_ranks  = 1;
  MPI_Comm_size(communicator, &n_ranks);
  for (int rank = 0; rank < n_ranks; ++rank)
    {
      Extremes one = found;
      broadcast_object(communicator, one, rank);
      for (std::size_t k = 0; k < one.size(); ++k)
        if (take_larger(all[k], one[k].value, one[k].cell))
          all[k].middle = one[k].middle;
    }
  Deformation largest    = {all[0], all[1], all[2]};
  largest.strain.value   = std::sqrt(all[0].value);
  largest.rotation.value = std::sqrt(all[1].value);
  largest.jacobian.value = -all[2].value;
  return largest;
}

/** Displacements of the node rows around a row of bricks, and their Extremes. */
class BrickRow
{
public:
  explicit BrickRow(const UniformGrid<3> &grid)
    : grid(grid)
    , n_cells(grid.cells[0])
    , values{std::vector<double>(n_cells), std::vector<double>(n_cells),
             std::vector<double>(n_cells)}
  {
    nodes.fill(std::vector<double>(std::size_t{n_cells} + 1));
  }

  /** Evaluates row @p j of layer @p k; @p copy_row(c, j, k, to) copies component c of a
   * row of nodes. */
  template <typename CopyRow>
  const RowValues &
  evaluate(const unsigned int j, const unsigned int k, const CopyRow &copy_row)
  {
    for (unsigned int corner = 0; corner < 4; ++corner) // y + 2 z
      for (unsigned int c = 0; c < 3; ++c)
        copy_row(c, j + corner % 2, k + corner / 2, nodes[3 * corner + c]);
    for (unsigned int i = 0; i < n_cells; ++i)
      evaluate_brick(i);
    return values;
  }

private:
  double at(const unsigned int i, const unsigned int corner, const unsigned int c) const
  {
    return nodes[3 * (corner >> 1U) + c][i + (corner & 1U)];
  }

  void evaluate_brick(const unsigned int i)
  {
    const auto &h = grid.spacing;
    double edge[3][4][3]; // du/dx along the edges: [axis][other two axes][component]
    double mean[3][3] = {};
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int e = 0; e < 4; ++e)
        for (unsigned int c = 0; c < 3; ++c)
          {
            const unsigned int low = (1U << d) - 1, // inserts bit d into e
              corner               = (e & low) | (e & ~low) << 1U;
            edge[d][e][c] = (at(i, corner | 1U << d, c) - at(i, corner, c)) / h[d];
            mean[c][d] += 0.25 * edge[d][e][c];
          }
    double strain = 0., rotation = 0., smallest = std::numeric_limits<double>::infinity();
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double sum        = 0.5 * (mean[c][d] + mean[d][c]),
                       difference = 0.5 * (mean[c][d] - mean[d][c]);
          strain += sum * sum;
          rotation += 0.5 * difference * difference;
        }
    for (unsigned int corner = 0; corner < 8; ++corner)
      {
        double F[3][3];
        for (unsigned int d = 0; d < 3; ++d)
          {
            const unsigned int low = (1U << d) - 1,
                               e   = (corner & low) | (corner >> 1U & ~low);
            for (unsigned int c = 0; c < 3; ++c)
              F[c][d] = edge[d][e][c] + (c == d ? 1. : 0.);
          }
        const double jacobian = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
                                F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
                                F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
        smallest = jacobian < smallest ? jacobian : smallest;
      }
    values.strain[i]   = strain;
    values.rotation[i] = rotation;
    // Comparisons ignore NaN, the sum does not.
    values.minus_jacobian[i] = -(smallest + 0. * strain);
  }

  const UniformGrid<3> &grid;
  const unsigned int n_cells;
  std::array<std::vector<double>, 12> nodes; ///< [y + 2 z][component]
  RowValues values;
};

/** Extremes over the bricks j[0] <= j < j[1] and k[0] <= k < k[1]. */
template <typename CopyRow>
Deformation largest_in_bricks(const UniformGrid<3> &grid,
                              const std::array<unsigned int, 2> &j,
                              const std::array<unsigned int, 2> &k,
                              const CopyRow &copy_row,
                              const MPI_Comm communicator)
{
  const auto &n  = grid.cells;
  Extremes found = none();
  BrickRow row(grid);
  for (unsigned int y = j[0]; y < j[1]; ++y)
    for (unsigned int z = k[0]; z < k[1]; ++z)
      {
        const RowValues &values   = row.evaluate(y, z, copy_row);
        const std::uint64_t first = (std::uint64_t{z} * n[1] + y) * n[0];
        for (unsigned int i = 0; i < n[0]; ++i)
          {
            take_larger(found[0], values.strain[i], first + i);
            take_larger(found[1], values.rotation[i], first + i);
            take_larger(found[2], values.minus_jacobian[i], first + i);
          }
      }
  for (CellExtreme &extreme : found)
    {
      const std::array<std::uint64_t, 3> place = {
        {extreme.cell % n[0], extreme.cell / n[0] % n[1], extreme.cell / n[0] / n[1]}};
      for (unsigned int d = 0; d < 3; ++d)
        extreme.middle[d] =
          grid.origin[d] + (0.5 + static_cast<double>(place[d])) * grid.spacing[d];
    }
  return over_ranks(found, communicator);
}

/** Contributions of one cell of a mesh to Extremes. */
template <int dim>
std::array<double, 3> evaluate_cell(const std::vector<dealii::Point<dim>> &points,
                                    const std::vector<unsigned int> &vertices,
                                    const NodalField<double> &u)
{
  using Gradient = dealii::Tensor<2, dim>;
  const LinearCell<dim> shape(vertices.size());
  // dx/dxi and du/dxi
  const auto gradients = [&](const dealii::Point<dim> &xi) {
    std::array<Gradient, 2> sum;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      {
        const auto shape_gradient = shape.gradient(xi, v);
        dealii::Tensor<1, dim> displacement;
        for (unsigned int c = 0; c < dim; ++c)
          displacement[c] = u.row(c, 0)[vertices[v]];
        sum[0] += outer_product(points[vertices[v]], shape_gradient);
        sum[1] += outer_product(displacement, shape_gradient);
      }
    return sum;
  };
  const auto middle    = gradients(shape.barycenter());
  const Gradient grad  = middle[1] * invert(middle[0]);
  const Gradient skew  = 0.5 * (grad - transpose(grad));
  double most_inverted = -std::numeric_limits<double>::infinity();
  for (unsigned int v = 0; v < vertices.size(); ++v)
    {
      const auto corner  = gradients(shape.corner(v));
      const double ratio = determinant(corner[0] + corner[1]) / determinant(corner[0]);
      most_inverted      = std::isnan(ratio) ? ratio : std::max(most_inverted, -ratio);
      if (std::isnan(ratio))
        break;
    }
  return {{(grad - skew).norm_square(), 0.5 * skew.norm_square(), most_inverted}};
}
} // namespace

Deformation largest_deformation(const UniformGrid<2> &grid,
                                const NodeRows &rows,
                                const NodalField<double> &u,
                                const MPI_Comm communicator)
{
  const std::vector<double> row(grid.cells[0]);
  RowValues values = {row, row, row};
  Extremes found   = none();
  for (unsigned int j = rows.begin; j < std::min(rows.end, grid.cells[1]); ++j)
    {
      const unsigned int lower = rows.local(j), upper = lower + 1;
      evaluate_row(u.row(0, lower), u.row(1, lower), u.row(0, upper), u.row(1, upper),
                   1. / grid.spacing[0], 1. / grid.spacing[1], values);
      const std::uint64_t first = std::uint64_t(j) * grid.cells[0];
      for (unsigned int i = 0; i < grid.cells[0]; ++i)
        {
          take_larger(found[0], values.strain[i], first + i);
          take_larger(found[1], values.rotation[i], first + i);
          take_larger(found[2], values.minus_jacobian[i], first + i);
        }
    }
  for (CellExtreme &extreme : found)
    for (unsigned int d = 0; d < 2; ++d)
      extreme.middle[d] =
        (0.5 + (d == 0 ? extreme.cell % grid.cells[0] : extreme.cell / grid.cells[0])) *
        grid.spacing[d];
  return over_ranks(found, communicator);
}

Deformation largest_deformation(
  const UniformGrid<3> &grid,
  const PlaneRange &planes,
  const std::function<const double *(unsigned int, unsigned int, unsigned int)> &row,
  const MPI_Comm communicator)
{
  return largest_in_bricks(
    grid, {{0, grid.cells[1]}}, {{planes.first, planes.first + planes.count}},
    [&](const unsigned int c, const unsigned int j, const unsigned int k,
        std::vector<double> &to) { std::copy_n(row(c, j, k), to.size(), to.begin()); },
    communicator);
}

Deformation largest_deformation(const BrickSlab &slab,
                                const NodalField<double> &u,
                                const MPI_Comm communicator)
{
  const auto copy_row = [&](const unsigned int c, const unsigned int j,
                            const unsigned int k, std::vector<double> &to) {
    const std::size_t first =
      slab.plane_start[j - slab.first_plane] + std::size_t{k} * slab.n_nodes[0];
    std::copy_n(u.row(c, 0) + first, slab.n_nodes[0], to.begin());
    if (slab.box.periodic[0])
      to.back() = to.front();
  };
  return largest_in_bricks(slab.box.grid,
                           {{slab.first_plane, slab.first_plane + slab.n_planes - 1}},
                           {{0, slab.box.grid.cells[2]}}, copy_row, communicator);
}

template <int dim>
Deformation largest_deformation(const std::vector<dealii::Point<dim>> &points,
                                const std::vector<Cell> &cells,
                                const std::vector<unsigned int> &numbers,
                                const NodalField<double> &u,
                                const MPI_Comm communicator)
{
  Extremes found = none();
  for (std::size_t k = 0; k < cells.size(); ++k)
    {
      const auto &vertices = cells[k].vertices;
      const auto values    = evaluate_cell(points, vertices, u);
      dealii::Point<dim> middle;
      for (const unsigned int v : vertices)
        middle += points[v] / static_cast<double>(vertices.size());
      for (std::size_t q = 0; q < found.size(); ++q)
        if (take_larger(found[q], values[q], numbers[k]))
          for (unsigned int d = 0; d < dim; ++d)
            found[q].middle[d] = middle[d];
    }
  return over_ranks(found, communicator);
}

#define MESOSLIP_INSTANTIATE(dim)                                       \
  template Deformation largest_deformation(                             \
    const std::vector<dealii::Point<dim>> &, const std::vector<Cell> &, \
    const std::vector<unsigned int> &, const NodalField<double> &, const MPI_Comm);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
