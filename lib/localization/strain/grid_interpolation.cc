#include "localization/strain/grid_interpolation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/**
 * Mean strain (engineering shear) of @p n cells between two rows of n + 1 nodes with
 * node-wise displacements; the factors are 1/2 over the sides of a cell (1/m).
 */
MESOSLIP_CLONES
void strain_row(const double *lower,
                const double *upper,
                const std::size_t n,
                const double x_factor,
                const double y_factor,
                double *__restrict__ xx,
                double *__restrict__ yy,
                double *__restrict__ xy)
{
  for (std::size_t i = 0; i < n; ++i)
    {
      const double *a = lower + 2 * i, *b = upper + 2 * i;
      xx[i] = x_factor * ((a[2] - a[0]) + (b[2] - b[0]));
      yy[i] = y_factor * ((b[1] - a[1]) + (b[3] - a[3]));
      xy[i] = y_factor * ((b[0] - a[0]) + (b[2] - a[2])) +
              x_factor * ((a[3] - a[1]) + (b[3] - b[1]));
    }
}

void strain_row(const std::array<const double *, 2> &rows,
                const std::size_t n,
                const std::array<double, 2> &factor,
                double *strain,
                const std::size_t stride)
{
  strain_row(rows[0], rows[1], n, factor[0], factor[1], strain, strain + stride,
             strain + 2 * stride);
}

/** 3D version, between four rows: lower, upper along y, along z, along both; the factors
 * are 1/4 over the sides, and component k of the strain begins at @p strain + k
 * @p stride. */
MESOSLIP_CLONES
void strain_row(const std::array<const double *, 4> &rows,
                const std::size_t n,
                const std::array<double, 3> &factor,
                double *strain,
                const std::size_t stride)
{
  const std::array<const double *, 4> first = rows;
  const double hx = factor[0], hy = factor[1], hz = factor[2];
  // The strain arrays do not overlap each other or the displacement.
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i)
    {
      const double *a = first[0] + 3 * i, *b = first[1] + 3 * i, *c = first[2] + 3 * i,
                   *d = first[3] + 3 * i;
      const auto x    = [=](const unsigned int k) {
        return hx * ((a[k + 3] - a[k]) + (b[k + 3] - b[k]) + (c[k + 3] - c[k]) +
                     (d[k + 3] - d[k]));
      };
      const auto y = [=](const unsigned int k) {
        return hy * ((b[k] - a[k]) + (b[k + 3] - a[k + 3]) + (d[k] - c[k]) +
                     (d[k + 3] - c[k + 3]));
      };
      const auto z = [=](const unsigned int k) {
        return hz * ((c[k] - a[k]) + (c[k + 3] - a[k + 3]) + (d[k] - b[k]) +
                     (d[k + 3] - b[k + 3]));
      };
      strain[i]              = x(0);
      strain[i + stride]     = y(1);
      strain[i + 2 * stride] = z(2);
      strain[i + 3 * stride] = z(1) + y(2);
      strain[i + 4 * stride] = z(0) + x(2);
      strain[i + 5 * stride] = y(0) + x(1);
    }
}

/** target += weight source */
MESOSLIP_CLONES
void add_scaled_row(const double *__restrict__ source,
                    const std::size_t n,
                    const double weight,
                    double *__restrict__ target)
{
  for (std::size_t i = 0; i < n; ++i)
    target[i] += weight * source[i];
}

/** target[i] = weight[2 i] source[first[i]] + weight[2 i + 1] source[first[i] + 1] */
MESOSLIP_CLONES
void gather_pairs_row(const double *__restrict__ source,
                      const unsigned int *__restrict__ first,
                      const double *__restrict__ weight,
                      const std::size_t n,
                      double *__restrict__ target)
{
  for (std::size_t i = 0; i < n; ++i)
    target[i] =
      weight[2 * i] * source[first[i]] + weight[2 * i + 1] * source[first[i] + 1];
}

/** Interpolates a row of source cells to target cells along x. */
void combine_columns(const AxisWeights &x, const double *values, double *combined)
{
  const std::size_t n = x.first.size();
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

constexpr std::size_t no_row = std::numeric_limits<std::size_t>::max();

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

template <int dim>
StrainInterpolation<dim>::StrainInterpolation(const UniformGrid<dim> &source_grid,
                                              const UniformGrid<dim> &target,
                                              const CellBlock<dim> &known)
  : source(source_grid)
  , n_target(target.cells[0])
  , first_layer(known.first[dim - 1])
{
  std::size_t n_kept = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      axes[d] = AxisWeights(source.cells[d], target.cells[d]);
      n_kept *= d == 0 ? 1 : axes[d].width;
    }
  const std::size_t n = source.cells[0];
  scratch             = CellRows(axes[0].is_identity() ? 0 : n, n, n_voigt<dim>);
  kept                = CellRows(n_kept * n_target, n_target, n_voigt<dim>);
  result              = CellRows(n_target, n_target, n_voigt<dim>);
  kept_row.assign(n_kept, no_row);
}

template <int dim>
std::array<unsigned int, 2>
StrainInterpolation<dim>::layers(const UniformGrid<dim> &source,
                                 const UniformGrid<dim> &target,
                                 const unsigned int begin,
                                 const unsigned int end)
{
  const AxisWeights axis(source.cells[dim - 1], target.cells[dim - 1]);
  return {{axis.first[begin], axis.first[end - 1] + axis.width}};
}

template <int dim>
void StrainInterpolation<dim>::set_displacement(const double *u)
{
  displacement = u;
  std::fill(kept_row.begin(), kept_row.end(), no_row);
}

/** A source row interpolated to the columns of the target. */
template <int dim>
CellRow StrainInterpolation<dim>::source_row(const RowIndex &at)
{
  std::size_t number = 0, place = 0;
  for (unsigned int d = dim - 1; d > 0; --d)
    {
      number = number * source.cells[d] + at[d - 1];
      place  = place * axes[d].width + at[d - 1] % axes[d].width;
    }
  const CellRow in_columns = {kept.array(0, place), kept.stride()};
  if (kept_row[place] == number)
    return in_columns;
  kept_row[place]     = number;
  const std::size_t n = source.cells[0];
  std::array<const double *, 1U << (dim - 1)> rows;
  for (unsigned int v = 0; v < rows.size(); ++v)
    {
      std::size_t node_row = 0;
      for (unsigned int d = dim - 1; d > 0; --d)
        node_row = node_row * (source.cells[d] + 1) + at[d - 1] + (v >> (d - 1) & 1U) -
                   (d == dim - 1 ? first_layer : 0);
      rows[v] = displacement + node_row * (n + 1) * dim;
    }
  std::array<double, dim> factor;
  for (unsigned int d = 0; d < dim; ++d)
    factor[d] = 1. / (1U << (dim - 1)) / source.spacing[d];
  const bool same_columns = axes[0].is_identity();
  CellRows &strain        = same_columns ? kept : scratch;
  strain_row(rows, n, factor, strain.array(0, same_columns ? place : 0), strain.stride());
  for (unsigned int c = 0; c < n_voigt<dim> && !same_columns; ++c)
    combine_columns(axes[0], scratch.array(c, 0), kept.array(c, place));
  return in_columns;
}

template <int dim>
CellRow StrainInterpolation<dim>::row(const std::size_t j)
{
  // Sums over all combinations of contributing rows along the axes other than x, y
  // fastest.
  RowIndex at, first;
  std::array<const double *, dim - 1> weight;
  std::size_t rest = j, n_rows = 1;
  for (unsigned int d = 1; d < dim; ++d)
    {
      const std::size_t n       = axes[d].first.size();
      const std::size_t at_axis = rest % n;
      first[d - 1]              = axes[d].first[at_axis];
      weight[d - 1]             = axes[d].weight.data() + at_axis * axes[d].width;
      rest /= n;
      n_rows *= axes[d].width;
    }
  if (n_rows == 1)
    return source_row(first);
  for (unsigned int c = 0; c < n_voigt<dim>; ++c)
    std::fill_n(result.array(c, 0), n_target, 0.);
  for (std::size_t k = 0; k < n_rows; ++k)
    {
      double product    = 1.;
      std::size_t place = k;
      for (unsigned int d = 1; d < dim; ++d)
        {
          const std::size_t step = place % axes[d].width;
          at[d - 1]              = first[d - 1] + static_cast<unsigned int>(step);
          product *= weight[d - 1][step];
          place /= axes[d].width;
        }
      const CellRow part = source_row(at);
      for (unsigned int c = 0; c < n_voigt<dim>; ++c)
        add_scaled_row(part.values + c * part.stride, n_target, product,
                       result.array(c, 0));
    }
  return {result.array(0, 0), result.stride()};
}

template class StrainInterpolation<2>;
template class StrainInterpolation<3>;
} // namespace mesoslip
