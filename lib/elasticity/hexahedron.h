// Hexahedra, Gauss point by Gauss point. Included by the kernels of general cells only,
// inside their namespace, after element_modes.h and element_gradients.h.
//
// At the 2^3 Gauss points, a derivative along a reference axis has four distinct values,
// one for each pair of signs of the other two coordinates.

/**
 * Derivatives of a component from its modes with gauss_scale: [axis][signs of the other
 * coordinates].
 */
using GaussDerivatives = vdouble[3][4];

/**
 * Calls @p f for each axis d with three of the four modes that contain coordinate d; the
 * fourth is mode 7 (xyz).
 * d = 0: 1 (x), 3 (xy), 5 (xz)
 * d = 1: 2 (y), 3 (xy), 6 (yz)
 * d = 2: 4 (z), 5 (xz), 6 (yz)
 */
template <typename F>
MESOSLIP_INLINE void for_each_axis(const F &f)
{
  f(0, 1, 3, 5);
  f(1, 2, 3, 6);
  f(2, 4, 5, 6);
}

MESOSLIP_INLINE void derivatives(const vdouble (&mode)[8], GaussDerivatives &value)
{
  for_each_axis([&](const int d, const int own, const int first, const int second) {
    const vdouble sum = mode[own] + mode[second], difference = mode[own] - mode[second];
    const vdouble first_sum        = mode[first] + mode[7],
                  first_difference = mode[first] - mode[7];
    value[d][0]                    = difference - first_difference;
    value[d][1]                    = difference + first_difference;
    value[d][2]                    = sum - first_sum;
    value[d][3]                    = sum + first_sum;
  });
}

/** The transpose of derivatives(). */
MESOSLIP_INLINE void from_derivatives(const GaussDerivatives &value, vdouble (&mode)[8])
{
  for (vdouble &m : mode)
    m = vdouble{};
  for_each_axis([&](const int d, const int own, const int first, const int second) {
    const vdouble low = value[d][1] + value[d][0], low_first = value[d][1] - value[d][0];
    const vdouble high       = value[d][3] + value[d][2],
                  high_first = value[d][3] - value[d][2];
    mode[own] += high + low;
    mode[first] += high_first + low_first;
    mode[second] += high - low;
    mode[7] += high_first - low_first;
  });
}

/** Index of Gauss point @p q among the distinct values along axis @p d. */
constexpr int edge_of(const int d, const int q)
{
  return (q & ((1 << d) - 1)) | ((q >> (d + 1)) << d);
}

/** Jacobian matrix at Gauss point @p q from the derivatives of the coordinates. */
MESOSLIP_INLINE void
jacobian(const GaussDerivatives (&x)[3], const int q, vdouble (&J)[3][3])
{
  for (int c = 0; c < 3; ++c)
    for (int d = 0; d < 3; ++d)
      J[c][d] = x[c][d][edge_of(d, q)];
}

/** Adds the forces of the stress @p excess times the mean strain. */
template <bool anisotropic>
__attribute__((noinline)) static void add_mean_stress(const double *excess,
                                                      const GaussDerivatives (&x)[3],
                                                      const GaussDerivatives (&v)[3],
                                                      GaussDerivatives (&force)[3])
{
  vdouble A[8][3][3], sum[6] = {}, stress[6], volume = {};
  for (int q = 0; q < 8; ++q)
    {
      vdouble J[3][3], gradient[3][3], strain[6];
      jacobian(x, q, J);
      for (int d = 0; d < 3; ++d)
        for (int c = 0; c < 3; ++c)
          gradient[d][c] = v[c][d][edge_of(d, q)];
      volume += adjugate(J, A[q]);
      strain_from_gradients<3>(gradient, A[q], strain);
      for (int i = 0; i < 6; ++i)
        sum[i] += strain[i];
    }
  for (vdouble &component : sum)
    component *= splat(1. / 512.) / volume;
  multiply_stiffness<3, anisotropic>(excess, sum, stress);
  for (int q = 0; q < 8; ++q)
    {
      vdouble gradient[3][3];
      forces_from_stress<3>(stress, A[q], gradient);
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d)
          force[c][d][edge_of(d, q)] += gradient[d][c];
    }
}

/** @p apart: cells have excess. A run-time check for null would cost registers. */
template <bool anisotropic, bool apart>
static void multiply_hexahedra(const CellBatches &cells, const double *u, double *f)
{
  CellStream<3, 8> stream(cells, u, f);
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      vdouble value[8][3];
      GaussDerivatives x[3], v[3], force[3] = {};
      stream.start(k, value);
      to_modes<3>(value);
      scale_modes<3>(value);
      for (int c = 0; c < 3; ++c)
        {
          vdouble mode[8], shape[8];
          for (int i = 1; i < 8; ++i)
            {
              mode[i]  = value[i][c];
              shape[i] = stream.shape(i, c);
            }
          derivatives(mode, v[c]);
          derivatives(shape, x[c]);
        }

      // The division takes long, so it starts one point ahead. Modes are eight times
      // coefficients, hence 512.
      vdouble next_A[3][3], next_scale;
      const auto prepare = [&](const int q) {
        vdouble J[3][3];
        jacobian(x, q, J);
        next_scale = splat(1. / 512.) / adjugate(J, next_A);
      };
      prepare(0);
#pragma GCC unroll 8
      for (int q = 0; q < 8; ++q)
        {
          const vdouble scale = next_scale;
          vdouble A[3][3];
          for (int d = 0; d < 3; ++d)
            for (int c = 0; c < 3; ++c)
              A[d][c] = next_A[d][c];
          if (q < 7)
            prepare(q + 1);
          vdouble gradient[3][3], strain[6], stress[6];
          for (int d = 0; d < 3; ++d)
            for (int c = 0; c < 3; ++c)
              gradient[d][c] = v[c][d][edge_of(d, q)];
          strain_from_gradients<3>(gradient, A, strain);
          for (vdouble &component : strain)
            component *= scale;
          multiply_stiffness<3, anisotropic>(
            cells.stiffness + std::size_t{36} * cells.material[k], strain, stress);
          forces_from_stress<3>(stress, A, gradient);
          for (int c = 0; c < 3; ++c)
            for (int d = 0; d < 3; ++d)
              force[c][d][edge_of(d, q)] += gradient[d][c];
          stream.move(q);
        }
      if constexpr (apart)
        add_mean_stress<anisotropic>(cells.excess + std::size_t{36} * cells.material[k],
                                     x, v, force);

      for (int c = 0; c < 3; ++c)
        {
          vdouble mode[8];
          from_derivatives(force[c], mode);
          for (int i = 0; i < 8; ++i)
            value[i][c] = mode[i];
        }
      scale_modes<3>(value);
      from_modes<3>(value);
      stream.finish(value);
    }
  stream.end();
}
