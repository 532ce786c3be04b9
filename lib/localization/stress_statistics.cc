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
 * sum += sqrt(square). If errno has to be set, the compiler does not vectorize roots;
 * wider vectors would not be faster, as the divider is the limit.
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

/** Squared von Mises stress in the plane. */
MESOSLIP_CLONES
void von_mises_squares_2(const double *__restrict__ stress,
                         const std::size_t stride,
                         const double *__restrict__ ratio,
                         const std::size_t n,
                         double *__restrict__ square)
{
  const double *xx = stress, *yy = stress + stride, *xy = stress + 2 * stride;
  for (std::size_t i = 0; i < n; ++i)
    {
      const double zz = ratio[i] * (xx[i] + yy[i]);
      const double a = xx[i] - yy[i], b = yy[i] - zz, c = zz - xx[i];
      square[i] = 0.5 * (a * a + b * b + c * c) + 3. * xy[i] * xy[i];
    }
}

/** Squared von Mises stress in 2D with sigma_zz = ratio (sigma_xx + sigma_yy) +
 * thermal. */
MESOSLIP_CLONES
void heated_von_mises_squares_2(const double *__restrict__ stress,
                                const std::size_t stride,
                                const double *__restrict__ ratio,
                                const double *__restrict__ thermal,
                                const std::size_t n,
                                double *__restrict__ square)
{
  const double *xx = stress, *yy = stress + stride, *xy = stress + 2 * stride;
  for (std::size_t i = 0; i < n; ++i)
    {
      const double zz = ratio[i] * (xx[i] + yy[i]) + thermal[i];
      const double a = xx[i] - yy[i], b = yy[i] - zz, c = zz - xx[i];
      square[i] = 0.5 * (a * a + b * b + c * c) + 3. * xy[i] * xy[i];
    }
}

/** 3D case. */
MESOSLIP_CLONES
void von_mises_squares_3(const double *__restrict__ stress,
                         const std::size_t stride,
                         const std::size_t n,
                         double *__restrict__ square)
{
  const double *xx = stress, *yy = stress + stride, *zz = stress + 2 * stride,
               *yz = stress + 3 * stride, *xz = stress + 4 * stride,
               *xy = stress + 5 * stride;
  for (std::size_t i = 0; i < n; ++i)
    {
      const double a = xx[i] - yy[i], b = yy[i] - zz[i], c = zz[i] - xx[i];
      square[i] = 0.5 * (a * a + b * b + c * c) +
                  3. * (yz[i] * yz[i] + xz[i] * xz[i] + xy[i] * xy[i]);
    }
}

/** stress = M strain; the arrays of M are its entries by rows. */
template <unsigned int n_components>
MESOSLIP_INTO_CLONES void multiply(const double *__restrict__ m,
                                   const std::size_t m_stride,
                                   const double *__restrict__ strain,
                                   const std::size_t strain_stride,
                                   const std::size_t n,
                                   double *__restrict__ stress,
                                   const std::size_t stress_stride)
{
  // The stress arrays do not overlap either.
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i)
    {
      double e[n_components];
      for (unsigned int c = 0; c < n_components; ++c)
        e[c] = strain[c * strain_stride + i];
      for (unsigned int r = 0; r < n_components; ++r)
        {
          const std::size_t first = r * m_stride * n_components;
          const double *row       = m + first + i;
          double sum              = row[0] * e[0];
          for (unsigned int c = 1; c < n_components; ++c)
            sum += row[c * m_stride] * e[c];
          stress[r * stress_stride + i] = sum;
        }
    }
}

MESOSLIP_CLONES
void multiply_2(const double *m,
                const std::size_t m_stride,
                const CellRow &strain,
                const std::size_t n,
                double *stress,
                const std::size_t stress_stride)
{
  multiply<3>(m, m_stride, strain.values, strain.stride, n, stress, stress_stride);
}

MESOSLIP_CLONES
void multiply_3(const double *m,
                const std::size_t m_stride,
                const CellRow &strain,
                const std::size_t n,
                double *stress,
                const std::size_t stress_stride)
{
  multiply<6>(m, m_stride, strain.values, strain.stride, n, stress, stress_stride);
}

/** stress += thermal. */
MESOSLIP_CLONES
void add_row(const double *__restrict__ thermal,
             const std::size_t n,
             double *__restrict__ stress)
{
  for (std::size_t i = 0; i < n; ++i)
    stress[i] += thermal[i];
}

/** Updates the running mean for sample number 1 / @p inverse. */
MESOSLIP_CLONES
void add_mean_row(const double *__restrict__ value,
                  const std::size_t n,
                  const double inverse,
                  double *__restrict__ mean)
{
  for (std::size_t i = 0; i < n; ++i)
    mean[i] += inverse * (value[i] - mean[i]);
}

/** Updates running mean and sum of squared deviations (Welford). */
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

/** Array indices of a row of sums; squared deviations follow the means of all
 * components. */
constexpr unsigned int von_mises_sum = 0, means = 1;
template <int dim>
constexpr unsigned int squares = means + n_voigt<dim>;
} // namespace

template <>
void add_von_mises_row<2>(const CellRow &stress,
                          const double *ratio,
                          const std::size_t n,
                          double *work,
                          double *sum)
{
  von_mises_squares_2(stress.values, stress.stride, ratio, n, work);
  add_roots(work, n, sum);
}

template <>
void add_von_mises_row<3>(
  const CellRow &stress, const double *, const std::size_t n, double *work, double *sum)
{
  von_mises_squares_3(stress.values, stress.stride, n, work);
  add_roots(work, n, sum);
}

template <int dim>
unsigned int StressStatistics<dim>::n_numbers(const FieldSelection &fields)
{
  return fields.deviation ? squares<dim> + n_voigt<dim>
         : fields.mean    ? squares<dim>
                          : means;
}

template <int dim>
StressStatistics<dim>::StressStatistics(const StressMap<dim> &stress_map,
                                        const FieldSelection &fields)
  : map(stress_map)
  , selection(fields)
  , samples(map.rows().n_rows(), 0)
  , sums(map.rows().n_cells(), map.rows().n_in_row(), n_numbers(fields))
  , scratch(map.rows().n_in_row(), map.rows().n_in_row(), n_voigt<dim> + 1)
{
}

template <int dim>
void StressStatistics<dim>::add(const std::size_t j, const CellRow &strain)
{
  const CellRows &rows = map.rows();
  const std::size_t n  = rows.size(j);
  double *stress       = scratch.array(0, 0);
  (dim == 2 ? multiply_2 : multiply_3)(rows.array(0, j), rows.stride(), strain, n, stress,
                                       scratch.stride());
  const double inverse    = 1. / static_cast<double>(++samples[j]);
  const CellRows *thermal = map.thermal();
  for (unsigned int c = 0; thermal != nullptr && c < n_voigt<dim>; ++c)
    add_row(thermal->array(c, j), n, scratch.array(c, 0));
  if (selection.von_mises && thermal != nullptr && dim == 2)
    {
      double *const work = scratch.array(n_voigt<dim>, 0);
      heated_von_mises_squares_2(stress, scratch.stride(), map.ratio(j),
                                 thermal->array(n_voigt<dim>, j), n, work);
      add_roots(work, n, sums.array(von_mises_sum, j));
    }
  else if (selection.von_mises)
    add_von_mises_row<dim>({stress, scratch.stride()}, map.ratio(j), n,
                           scratch.array(n_voigt<dim>, 0), sums.array(von_mises_sum, j));
  for (unsigned int c = 0; c < n_voigt<dim>; ++c)
    if (selection.deviation)
      add_moments_row(scratch.array(c, 0), n, inverse, sums.array(means + c, j),
                      sums.array(squares<dim> + c, j));
    else if (selection.mean)
      add_mean_row(scratch.array(c, 0), n, inverse, sums.array(means + c, j));
}

/** Arrays first to first + n - 1, interleaved by cell; with @p as_root the roots of their
 * means per sample. */
template <int dim>
std::vector<double> StressStatistics<dim>::interleaved(const unsigned int first,
                                                       const unsigned int n,
                                                       const bool as_root) const
{
  std::vector<double> values(sums.n_cells() * n);
  const double n_samples = samples.empty() ? 1. : static_cast<double>(samples[0]);
  for (std::size_t j = 0; j < sums.n_rows(); ++j)
    for (unsigned int c = 0; c < n; ++c)
      {
        const double *array = sums.array(first + c, j);
        double *value       = values.data() + j * sums.n_in_row() * n + c;
        for (std::size_t i = 0; i < sums.size(j); ++i)
          value[i * n] = as_root ? std::sqrt(array[i] / n_samples) : array[i];
      }
  return values;
}

template <int dim>
StressFields StressStatistics<dim>::fields() const
{
  StressFields result;
  if (selection.von_mises)
    result.mean_von_mises = interleaved(von_mises_sum, 1, false);
  for (double &value : result.mean_von_mises)
    value /= static_cast<double>(samples[0]);
  if (selection.mean)
    result.mean_stress = interleaved(means, n_voigt<dim>, false);
  if (selection.deviation)
    result.deviation_stress = interleaved(squares<dim>, n_voigt<dim>, true);
  return result;
}

template class StressStatistics<2>;
template class StressStatistics<3>;
} // namespace mesoslip
