#include "localization/strain_interpolation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/** Sum of a nodal quantity times the lengths that belong to n + 1 nodes in line. */
template <typename Value>
double integrate(const unsigned int n, const double h, const Value &value)
{
  double sum = 0.5 * (value(0) + value(n));
  for (unsigned int i = 1; i < n; ++i)
    sum += value(i);
  return h * sum;
}

constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

StrainRow row_of(const NodalField<double> &arrays, const unsigned int j)
{
  return {{arrays.row(0, j), arrays.row(1, j), arrays.row(2, j)}};
}
} // namespace

AxisWeights::AxisWeights(const unsigned int n_source_cells, const unsigned int n_target)
  : n_source(n_source_cells)
{
  const bool whole = n_source % n_target == 0;
  width            = whole ? n_source / n_target : std::min(n_source, 2u);
  first.resize(n_target);
  weight.resize(std::size_t(n_target) * width);
  for (std::size_t i = 0; i < n_target; ++i)
    if (whole || n_source == 1)
      {
        first[i] = whole ? i * width : 0;
        std::fill_n(weight.begin() + std::ptrdiff_t(i) * width, width, 1. / width);
      }
    else
      {
        // Position of the centre among the source's cell centres.
        const double position = (i + 0.5) * n_source / n_target - 0.5;
        const double below    = std::clamp(std::floor(position), 0., n_source - 2.);
        first[i]              = static_cast<unsigned int>(below);
        weight[2 * i + 1]     = position - below;
        weight[2 * i]         = 1. - weight[2 * i + 1];
      }
}

std::array<double, 3> mean_strain(const UniformGrid<2> &grid, const double *u)
{
  const unsigned int nx = grid.cells[0], ny = grid.cells[1];
  // Differences between opposite sides of component c.
  const auto across = [&](const unsigned int c) {
    return integrate(ny, grid.spacing[1], [&](const std::size_t j) {
      const double *row = u + 2 * j * (nx + 1);
      return row[2 * nx + c] - row[c];
    });
  };
  const auto upward = [&](const unsigned int c) {
    const double *top = u + 2 * std::size_t(ny) * (nx + 1);
    return integrate(nx, grid.spacing[0],
                     [&](const std::size_t i) { return top[2 * i + c] - u[2 * i + c]; });
  };
  const double area = grid.extent(0) * grid.extent(1);
  return {{across(0) / area, upward(1) / area, (upward(0) + across(1)) / area}};
}

StrainInterpolation::StrainInterpolation(const UniformGrid<2> &source_grid,
                                         const UniformGrid<2> &target_grid)
  : source(source_grid)
  , target(target_grid)
  , x(source.cells[0], target.cells[0])
  , y(source.cells[1], target.cells[1])
  , scratch(source.cells[0], x.is_identity() ? 0 : 1, 3)
  , kept(target.cells[0], y.width, 3)
  , result(target.cells[0], 1, 3)
  , kept_row(y.width, none)
{
}

void StrainInterpolation::set_displacement(const double *u)
{
  displacement = u;
  std::fill(kept_row.begin(), kept_row.end(), none);
}

/** Row @p j of the source in the columns of the target. */
StrainRow StrainInterpolation::source_row(const unsigned int j)
{
  const unsigned int place = j % y.width;
  if (kept_row[place] == j)
    return row_of(kept, place);
  kept_row[place]            = j;
  const bool same_columns    = x.is_identity();
  NodalField<double> &strain = same_columns ? kept : scratch;
  const unsigned int in      = same_columns ? place : 0;
  const std::size_t n        = source.cells[0];
  const double *lower        = displacement + 2UL * j * (n + 1);
  strain_row(lower, lower + 2 * (n + 1), n, 0.5 / source.spacing[0],
             0.5 / source.spacing[1], strain.row(0, in), strain.row(1, in),
             strain.row(2, in));
  for (unsigned int c = 0; c < 3 && !same_columns; ++c)
    combine_columns(scratch.row(c, 0), kept.row(c, place));
  return row_of(kept, place);
}

StrainRow StrainInterpolation::row(const unsigned int j)
{
  if (y.width == 1)
    return source_row(y.first[j]);
  const std::size_t n = target.cells[0];
  for (unsigned int c = 0; c < 3; ++c)
    std::fill_n(result.row(c, 0), n, 0.);
  for (unsigned int k = 0; k < y.width; ++k)
    {
      const double weight  = y.weight[std::size_t(j) * y.width + k];
      const StrainRow part = source_row(y.first[j] + k);
      for (unsigned int c = 0; c < 3; ++c)
        add_scaled_row(part[c], n, weight, result.row(c, 0));
    }
  return row_of(result, 0);
}

void StrainInterpolation::combine_columns(const double *values, double *combined) const
{
  const std::size_t n = target.cells[0];
  if (x.width == 2)
    return gather_pairs_row(values, x.first.data(), x.weight.data(), n, combined);
  for (std::size_t i = 0; i < n; ++i)
    {
      const double *weight = x.weight.data() + i * x.width;
      double sum           = 0.;
      for (unsigned int k = 0; k < x.width; ++k)
        sum += weight[k] * values[x.first[i] + k];
      combined[i] = sum;
    }
}
} // namespace mesoslip
