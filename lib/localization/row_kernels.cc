#include "localization/row_kernels.h"

#include <cmath>

#ifdef __SSE2__
#  include <emmintrin.h>
#endif

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#  define MESOSLIP_CLONES \
    __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#  define MESOSLIP_CLONES
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
} // namespace

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

MESOSLIP_CLONES
void add_mean_row(const double *__restrict__ value,
                  const std::size_t n,
                  const double inverse,
                  double *__restrict__ mean)
{
  for (std::size_t i = 0; i < n; ++i)
    mean[i] += inverse * (value[i] - mean[i]);
}

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

MESOSLIP_CLONES
void add_scaled_row(const double *__restrict__ source,
                    const std::size_t n,
                    const double weight,
                    double *__restrict__ target)
{
  for (std::size_t i = 0; i < n; ++i)
    target[i] += weight * source[i];
}

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
} // namespace mesoslip
