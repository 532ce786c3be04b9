#include "dynamics/stepper.h"

#include "base/exchange.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mesoslip
{
namespace
{
/** Values of the cells of one row: squares, as no root is needed to compare them. */
struct RowValues
{
  std::vector<double> strain, rotation, minus_jacobian;
};

// Without branches, so that the compiler makes vector instructions of it.
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
      // At the corners; the first index is that of the edge along x.
      const double j00  = (1. + xx0) * (1. + yy0) - xy0 * yx0,
                   j01  = (1. + xx0) * (1. + yy1) - xy1 * yx0,
                   j10  = (1. + xx1) * (1. + yy0) - xy0 * yx1,
                   j11  = (1. + xx1) * (1. + yy1) - xy1 * yx1;
      const double low  = j00 < j01 ? j00 : j01;
      const double high = j10 < j11 ? j10 : j11;
      // Comparisons pass over a NaN, the sum does not.
      minus_jacobian[i] = -((low < high ? low : high) + 0. * strain[i]);
    }
}

void take_larger(CellExtreme &best, const CellExtreme &other)
{
  // The first NaN is larger than all numbers and no smaller than another NaN.
  if (!(other.value <= best.value) && !std::isnan(best.value))
    best = other;
}

double root(const double square)
{
  return std::isnan(square) ? std::numeric_limits<double>::infinity() : std::sqrt(square);
}
} // namespace

Deformation largest_deformation(const UniformGrid<2> &grid,
                                const NodeRows &rows,
                                const NodalField<double> &u,
                                const MPI_Comm communicator)
{
  const std::vector<double> row(grid.cells[0]);
  RowValues values = {row, row, row};
  Deformation found; // squares, and the Jacobian with the opposite sign
  found.jacobian.value = -found.jacobian.value;
  Deformation all      = found;
  for (unsigned int j = rows.begin; j < std::min(rows.end, grid.cells[1]); ++j)
    {
      const unsigned int lower = rows.local(j), upper = lower + 1;
      evaluate_row(u.row(0, lower), u.row(1, lower), u.row(0, upper), u.row(1, upper),
                   1. / grid.spacing[0], 1. / grid.spacing[1], values);
      for (unsigned int i = 0; i < grid.cells[0]; ++i)
        {
          take_larger(found.strain, {values.strain[i], i, j});
          take_larger(found.rotation, {values.rotation[i], i, j});
          take_larger(found.jacobian, {values.minus_jacobian[i], i, j});
        }
    }
  int n_ranks = 1;
  MPI_Comm_size(communicator, &n_ranks);
  for (int rank = 0; rank < n_ranks; ++rank)
    {
      Deformation one = found;
      broadcast_object(communicator, one, rank);
      take_larger(all.strain, one.strain);
      take_larger(all.rotation, one.rotation);
      take_larger(all.jacobian, one.jacobian);
    }
  all.strain.value   = root(all.strain.value);
  all.rotation.value = root(all.rotation.value);
  all.jacobian.value = std::isnan(all.jacobian.value)
                         ? -std::numeric_limits<double>::infinity()
                         : -all.jacobian.value;
  return all;
}
} // namespace mesoslip
