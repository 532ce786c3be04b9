// Sums and differences over the corners of cells. Included by the kernels of general
// cells only, inside their namespace, after simd.h.
//
// Mode i of a simplex is the difference between corner i and the first one. Mode i of a
// quadrilateral or hexahedron on [-1, 1]^dim is the sum over the corners, each with the
// signs of its coordinates in the bits of i: 2^dim times the coefficient of the product
// of these coordinates. Mode 0 is not used.

template <int dim, int n_corners>
constexpr bool is_simplex = n_corners == dim + 1;

/** Transforms values at corners to modes, in place. */
template <int dim, int n_corners>
MESOSLIP_INLINE void to_modes(vdouble (&value)[n_corners][dim])
{
  for (int c = 0; c < dim; ++c)
    if (is_simplex<dim, n_corners>)
      for (int i = 1; i < n_corners; ++i)
        value[i][c] -= value[0][c];
    else
      for (int bit = 1; bit < n_corners; bit *= 2)
        for (int i = 0; i < n_corners; ++i)
          if (!(i & bit))
            {
              const vdouble low = value[i][c], high = value[i | bit][c];
              value[i][c]       = high + low;
              value[i | bit][c] = high - low;
            }
}

/** Transposed to_modes(), in place: forces on modes to forces at corners. */
template <int dim, int n_corners>
MESOSLIP_INLINE void from_modes(vdouble (&value)[n_corners][dim])
{
  for (int c = 0; c < dim; ++c)
    {
      value[0][c] = vdouble{};
      if (is_simplex<dim, n_corners>)
        for (int i = 1; i < n_corners; ++i)
          value[0][c] -= value[i][c];
      else
        for (int bit = 1; bit < n_corners; bit *= 2)
          for (int i = 0; i < n_corners; ++i)
            if (!(i & bit))
              {
                const vdouble sum = value[i][c], difference = value[i | bit][c];
                value[i][c]       = sum - difference;
                value[i | bit][c] = sum + difference;
              }
    }
}

/**
 * At the Gauss points, +-1/sqrt(3), a product of n coordinates is sqrt(3)^(1-n) times its
 * derivative, up to the sign.
 */
constexpr double gauss_scale[] = {1.,
                                  1.,
                                  1.,
                                  0.57735026918962576451,
                                  1.,
                                  0.57735026918962576451,
                                  0.57735026918962576451,
                                  1. / 3.};

/** Multiplies the modes of quadrilaterals and hexahedra by gauss_scale. */
template <int dim>
MESOSLIP_INLINE void scale_modes(vdouble (&mode)[1 << dim][dim])
{
#pragma GCC unroll 8
  for (int i = 3; i < 1 << dim; ++i)
    if (i & (i - 1))
      for (int c = 0; c < dim; ++c)
        mode[i][c] *= splat(gauss_scale[i]);
}
