#include "localization/stress_statistics.h"


#include <cmath>

#ifdef __SSE2__
#  include <emmintrin.h>
#endif

namespace mesoslip
{
namespace
{
/**
 * sum += sqrt(square). With errno to be set, the compiler does not vectorize roots; wider
 * vectors would not be faster, the divider is the limit.
 */
void add_roots(const double *square, const std::size_t n, double *sum)
{
  std::size_t i = 0;
#ifdef __SSE2__
  for (; i + 2 <= n; i += 2)
    _mm_storeu_pd(
      sum + i, _mm_add_pd(_mm_loadu_pd(sum + i), _mm_sqrt_pd(_mm_loadu_pd(square + i))));
#endif
  for (; i < n; ++i)
    sum[i] += std::sqrt(square[i]);
}

/** Squared von Mises stress. */
MESOSLIP_CLONES
void von_mises_squares(const double *__restrict__ xx,
                       const double *__restrict__ yy,
                       const double *__restrict__ xy,
                       const double *__restrict__ ratio,
                       const std::size_t n,
                       double *__restrict__ square)
{
  for (std::size_t i = 0; i < n; ++i)
    {
      const double zz = ratio[i] * (xx[i] + yy[i]);
      const double a = xx[i] - yy[i], b = yy[i] - zz, c = zz - xx[i];
      square[i] = 0.5 * (a * a + b * b + c * c) + 3. * xy[i] * xy[i];
    }
}

/**
 * stress = M strain (e0, e1, e2); M is 9 arrays at distances of @p stride, row-major: array
 * 3 r + c holds M(r, c) of all cells.
 */
MESOSLIP_CLONES
void stress_row(const double *__restrict__ m,
                const std::size_t stride,
                const double *__restrict__ e0,
                const double *__restrict__ e1,
                const double *__restrict__ e2,
                const std::size_t n,
                double *__restrict__ s0,
                double *__restrict__ s1,
                double *__restrict__ s2)
{
  const double *m1 = m + 3 * stride, *m2 = m + 6 * stride;
  for (std::size_t i = 0; i < n; ++i)
    {
      const double x = e0[i], y = e1[i], t = e2[i];
      s0[i] = m[i] * x + m[i + stride] * y + m[i + 2 * stride] * t;
      s1[i] = m1[i] * x + m1[i + stride] * y + m1[i + 2 * stride] * t;
      s2[i] = m2[i] * x + m2[i + stride] * y + m2[i + 2 * stride] * t;
    }
}

/** Running mean after the sample number 1 / @p inverse. */
MESOSLIP_CLONES
void add_mean_row(const double *__restrict__ value,
                  const std::size_t n,
                  const double inverse,
                  double *__restrict__ mean)
{
  for (std::size_t i = 0; i < n; ++i)
    mean[i] += inverse * (value[i] - mean[i]);
}

/** Running mean and sum of squared deviations from it (Welford). */
MESOSLIP_CLONES
void add_moments_row(const double *__restrict__ value,
                     const std::size_t n,
                     const double inverse,
                     double *__restrict__ mean,
                     double *__restrict__ squares)
{
  for (std::size_t i = 0; i < n; ++i)
    {
      const double before = value[i] - mean[i];
      mean[i] += inverse * before;
      squares[i] += before * (value[i] - mean[i]);
    }
}

/** Arrays of a row of sums. */
constexpr unsigned int von_mises_sum = 0, means = 1, squares = 4;
} // namespace

void add_von_mises_row(const double *xx,
                       const double *yy,
                       const double *xy,
                       const double *ratio,
                       const std::size_t n,
                       double *work,
                       double *sum)
{
  von_mises_squares(xx, yy, xy, ratio, n, work);
  add_roots(work, n, sum);
}

StressMap::StressMap(const UniformGrid<2> &grid,
                     const std::vector<std::uint8_t> &phase,
                     const std::vector<VoigtMatrix<2>> &stiffness,
                     const std::vector<double> &ratio,
                     const std::vector<double> &concentration)
  : data(grid.cells[0], grid.cells[1], 10)
{
  const std::size_t nx = grid.cells[0];
  for (std::size_t cell = 0; cell < grid.n_cells(); ++cell)
    {
      const std::size_t i = cell % nx, j = cell / nx;
      VoigtMatrix<2> product = stiffness[phase[cell]];
      if (!concentration.empty())
        product *=
          Eigen::Map<const VoigtMatrix<2>>(concentration.data() + 9 * cell).eval();
      for (unsigned int k = 0; k < 9; ++k)
        data.row(k, j)[i] = product(k / 3, k % 3);
      data.row(9, j)[i] = ratio[phase[cell]];
    }
}

VoigtMatrix<2> StressMap::matrix(const unsigned int i, const unsigned int j) const
{
  VoigtMatrix<2> result;
  for (unsigned int k = 0; k < 9; ++k)
    result(k / 3, k % 3) = data.row(k, j)[i];
  return result;
}

StressStatistics::StressStatistics(const StressMap &stress_map,
                                   const FieldSelection &fields)
  : map(stress_map)
  , selection(fields)
  , samples(map.rows().n_rows(), 0)
  , sums(map.rows().n_columns(),
         map.rows().n_rows(),
         selection.deviation ? 7
         : selection.mean    ? 4
                             : 1)
  , scratch(map.rows().n_columns(), 1, 4)
{
}

void StressStatistics::add(const unsigned int j, const StrainRow &strain)
{
  const std::size_t n = scratch.n_columns();
  double *xx = scratch.row(0, 0), *yy = scratch.row(1, 0), *xy = scratch.row(2, 0);
  stress_row(map.rows().row(0, j), map.rows().component_stride(), strain[0], strain[1],
             strain[2], n, xx, yy, xy);
  const double inverse = 1. / static_cast<double>(++samples[j]);
  if (selection.von_mises)
    add_von_mises_row(xx, yy, xy, map.rows().row(9, j), n, scratch.row(3, 0),
                      sums.row(von_mises_sum, j));
  for (unsigned int c = 0; c < 3; ++c)
    if (selection.deviation)
      add_moments_row(scratch.row(c, 0), n, inverse, sums.row(means + c, j),
                      sums.row(squares + c, j));
    else if (selection.mean)
      add_mean_row(scratch.row(c, 0), n, inverse, sums.row(means + c, j));
}

/** Arrays first to first + n - 1 [ny][nx][n], or the roots of what they are a sample. */
std::vector<double> StressStatistics::interleaved(const unsigned int first,
                                                  const unsigned int n,
                                                  const bool as_root) const
{
  std::vector<double> values;
  const double n_samples = static_cast<double>(samples[0]);
  for (unsigned int j = 0; j < sums.n_rows(); ++j)
    for (std::size_t i = 0; i < sums.n_columns(); ++i)
      for (unsigned int c = first; c < first + n; ++c)
        {
          const double value = sums.row(c, j)[i];
          values.push_back(as_root ? std::sqrt(value / n_samples) : value);
        }
  return values;
}

StressFields StressStatistics::fields() const
{
  StressFields result;
  if (selection.von_mises)
    result.mean_von_mises = interleaved(von_mises_sum, 1, false);
  for (double &value : result.mean_von_mises)
    value /= static_cast<double>(samples[0]);
  if (selection.mean)
    result.mean_stress = interleaved(means, 3, false);
  if (selection.deviation)
    result.deviation_stress = interleaved(squares, 3, true);
  return result;
}
} // namespace mesoslip
