// Row kernels of one instruction set: selection of an instance, and the small row
// functions. Compiled once for each set, see kernel_variants.h.
#include "elasticity/row_kernel.h"

#include "elasticity/kernel_variants.h"

#ifdef __x86_64__
#  include <immintrin.h>
#endif

#ifndef MESOSLIP_ROWS_AT_ONCE
#  define MESOSLIP_ROWS_AT_ONCE 3
#endif

namespace mesoslip::kernels::MESOSLIP_VARIANT
{
#include "elasticity/simd.h"
//
#include "elasticity/row_kernel_impl.h"

/** Top row: there are no cells above, only the buffers contribute. */
template <typename Number, bool gravity>
static void finish(const Constants<Number> &c, const Rows<Number> &r)
{
  using Vector              = typename Simd<Number>::Vector;
  constexpr unsigned int vl = Simd<Number>::length;
  Vector left_x{}, left_y{};
  if (c.periodic)
    {
      const unsigned int last = c.n_cells - 1;
      left_x                  = splat(r.qx[last] + r.sxy[last]);
      left_y                  = splat(r.qy[last] + r.syy[last]);
    }
  for (unsigned int i = 0; i <= c.n_cells; i += vl)
    {
      const Vector qx = load(r.qx + i), sxy = load(r.sxy + i);
      const Vector qy = load(r.qy + i), syy = load(r.syy + i);
      Vector fx = left_neighbours(left_x, Vector(qx + sxy)) - (qx - sxy);
      Vector fy = left_neighbours(left_y, Vector(qy + syy)) - (qy - syy);
      left_x    = qx + sxy;
      left_y    = qy + syy;
      fx        = fx * splat(c.scale_x);
      fy        = fy * splat(c.scale_y);
      if constexpr (gravity)
        {
          const Vector mass = load(r.mass + i), alpha = splat(c.alpha);
          fx = fnma(fnma(alpha, load(r.wx + i), splat(c.gravity_x)), mass, fx);
          fy = fnma(fnma(alpha, load(r.wy + i), splat(c.gravity_y)), mass, fy);
        }
      store(r.fx + i, fx);
      store(r.fy + i, fy);
    }
}

static void strain(const double *__restrict__ lower,
                   const double *__restrict__ upper,
                   const std::size_t component_offset,
                   const unsigned int n_cells,
                   const double half_inverse_hx,
                   const double half_inverse_hy,
                   double *__restrict__ exx,
                   double *__restrict__ eyy,
                   double *__restrict__ gxy)
{
  const double *__restrict__ lower_y = lower + component_offset;
  const double *__restrict__ upper_y = upper + component_offset;
  for (unsigned int i = 0; i < n_cells; ++i)
    {
      exx[i] = (lower[i + 1] - lower[i] + (upper[i + 1] - upper[i])) * half_inverse_hx;
      eyy[i] =
        (upper_y[i + 1] - lower_y[i + 1] + (upper_y[i] - lower_y[i])) * half_inverse_hy;
      gxy[i] =
        (upper[i + 1] - lower[i + 1] + (upper[i] - lower[i])) * half_inverse_hy +
        (lower_y[i + 1] - lower_y[i] + (upper_y[i + 1] - upper_y[i])) * half_inverse_hx;
    }
}

static double dot(const double *a, const double *b, const unsigned int n)
{
  constexpr unsigned int vl = Simd<double>::length;
  vdouble sum{};
  unsigned int i = 0;
  for (; i + vl <= n; i += vl)
    sum = fma(load(a + i), load(b + i), sum);
  double result = 0.;
  for (unsigned int l = 0; l < vl; ++l)
    result += sum[l];
  for (; i < n; ++i)
    result += a[i] * b[i];
  return result;
}

template <typename Number,
          MaterialVariant variant,
          bool anisotropic,
          bool damping,
          bool gravity>
static void select_last(Kernels<Number> &kernels)
{
  constexpr int n        = MESOSLIP_ROWS_AT_ONCE;
  constexpr bool is_fine = sizeof(Number) == sizeof(double);
  if constexpr (is_fine || damping)
    {
      kernels.step[0] =
        &Kernel<Number, variant, anisotropic, damping, gravity, true, 1>::run;
      kernels.step[1] =
        &Kernel<Number, variant, anisotropic, damping, gravity, true, n>::run;
    }
  if constexpr (is_fine)
    {
      kernels.strain = &strain;
      kernels.dot    = &dot;
    }
  kernels.store[0] =
    &Kernel<Number, variant, anisotropic, damping, gravity, false, 1>::run;
  // Several rows at once only for plain products, without w and gravity.
  if constexpr (!damping && !gravity)
    kernels.store[1] =
      &Kernel<Number, variant, anisotropic, damping, gravity, false, n>::run;
  kernels.finish       = &finish<Number, gravity>;
  kernels.rows_at_once = n;
}

/** Selects the instance with the @p wanted terms: anisotropy, damping, gravity. */
template <typename Number, MaterialVariant variant, bool... terms>
static void select_terms(const bool *wanted, Kernels<Number> &kernels)
{
  if constexpr (sizeof...(terms) == 3)
    select_last<Number, variant, terms...>(kernels);
  else
    {
      // Single precision has steps with the damping term only, to compile half as many kernels.
      constexpr bool so_far[] = {terms..., false, false};
      if constexpr (sizeof(Number) == sizeof(double) || sizeof...(terms) < 2 || so_far[1])
        if (*wanted)
          return select_terms<Number, variant, terms..., true>(wanted + 1, kernels);
      select_terms<Number, variant, terms..., false>(wanted + 1, kernels);
    }
}

template <typename Number>
static void select_material(Choice &choice, Kernels<Number> &kernels)
{
  constexpr unsigned int capacity = has_lookup ? Simd<Number>::length : 0;
  using Variant                   = MaterialVariant;
  const bool terms[]              = {choice.anisotropic, choice.damping, choice.gravity};
  const unsigned int n            = choice.n_phases;
  choice.material                 = n == 1              ? Variant::homogeneous
                                    : n == 2            ? Variant::two
                                    : n <= capacity     ? Variant::one_register
                                    : n <= 2 * capacity ? Variant::two_registers
                                                        : Variant::any;
  if (choice.material == Variant::homogeneous)
    return select_terms<Number, Variant::homogeneous>(terms, kernels);
  if (choice.material == Variant::two)
    return select_terms<Number, Variant::two>(terms, kernels);
  if constexpr (has_lookup)
    {
      if (choice.material == Variant::one_register)
        return select_terms<Number, Variant::one_register>(terms, kernels);
      if (choice.material == Variant::two_registers)
        return select_terms<Number, Variant::two_registers>(terms, kernels);
    }
  select_terms<Number, Variant::any>(terms, kernels);
}

void select(Choice &choice, Kernels<double> &kernels)
{
  select_material(choice, kernels);
}

void select(Choice &choice, Kernels<float> &kernels)
{
  select_material(choice, kernels);
}

} // namespace mesoslip::kernels::MESOSLIP_VARIANT
