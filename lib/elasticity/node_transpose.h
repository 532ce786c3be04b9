// One corner of each cell of a batch between memory, where the components of a node stand
// together, and vectors over the cells. Included by the kernels of general cells only,
// inside their namespace, after simd.h. The cells stand in a vector in the order of
// lane_order.
//
// Nodes are written one after the other, so that cells of a batch may share them.

constexpr unsigned int n_lanes = Simd<double>::length;

#if defined(__AVX512F__)
/** Which of the given nodes each number of a vector belongs to. */
template <int dim>
constexpr unsigned int lane_order[n_lanes] = {0, 4, 1, 5, 2, 6, 3, 7};

template <>
constexpr unsigned int lane_order<3>[n_lanes] = {0, 1, 4, 5, 2, 3, 6, 7};

MESOSLIP_INLINE __m256d join(const __m128d a, const __m128d b)
{
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(a), b, 1);
}

MESOSLIP_INLINE __m512d join(const __m256d a, const __m256d b)
{
  return _mm512_insertf64x4(_mm512_castpd256_pd512(a), b, 1);
}

template <bool add>
MESOSLIP_INLINE void put(double *p, const __m128d x)
{
  _mm_store_pd(p, add ? _mm_add_pd(_mm_load_pd(p), x) : x);
}

template <bool add>
MESOSLIP_INLINE void put(double *p, const __m256d x)
{
  _mm256_store_pd(p, add ? _mm256_add_pd(_mm256_load_pd(p), x) : x);
}

/** Even and odd entries of pairs: (a0 b0 a2 b2 ...), (a1 b1 a3 b3 ...). */
MESOSLIP_INLINE __m512d even(const __m512d a, const __m512d b)
{
  return _mm512_maskz_unpacklo_pd(0xff, a, b);
}

MESOSLIP_INLINE __m512d odd(const __m512d a, const __m512d b)
{
  return _mm512_maskz_unpackhi_pd(0xff, a, b);
}

MESOSLIP_INLINE void
load_nodes(const double *field, const std::uint32_t *node, vdouble (&value)[2])
{
  const auto four_nodes = [&](const unsigned int l) {
    const auto pair = [&](const unsigned int k) {
      return _mm_load_pd(field + 2 * std::size_t(node[l + k]));
    };
    return join(join(pair(0), pair(1)), join(pair(2), pair(3)));
  };
  const __m512d a = four_nodes(0), b = four_nodes(4);
  value[0] = (vdouble)even(a, b);
  value[1] = (vdouble)odd(a, b);
}

template <bool add>
MESOSLIP_INLINE void
put_nodes(double *field, const std::uint32_t *node, const vdouble (&value)[2])
{
  const auto put_four_nodes = [&](const unsigned int l, const __m512d v) {
    const __m256d low  = _mm512_castpd512_pd256(v);
    const __m256d high = _mm512_maskz_extractf64x4_pd(0xf, v, 1);
    const auto put_one = [&](const unsigned int k, const __m128d x) {
      put<add>(field + 2 * std::size_t(node[l + k]), x);
    };
    put_one(0, _mm256_castpd256_pd128(low));
    put_one(1, _mm256_extractf128_pd(low, 1));
    put_one(2, _mm256_castpd256_pd128(high));
    put_one(3, _mm256_extractf128_pd(high, 1));
  };
  const __m512d x = (__m512d)value[0], y = (__m512d)value[1];
  put_four_nodes(0, even(x, y));
  put_four_nodes(4, odd(x, y));
}

MESOSLIP_INLINE void
load_nodes(const double *field, const std::uint32_t *node, vdouble (&value)[3])
{
  const auto two_nodes = [&](const unsigned int l) {
    return join(_mm256_load_pd(field + 4 * std::size_t(node[l])),
                _mm256_load_pd(field + 4 * std::size_t(node[l + 4])));
  };
  const __m512d a = two_nodes(0), b = two_nodes(1), c = two_nodes(2), d = two_nodes(3);
  const __m512d xz_ab = even(a, b), xz_cd = even(c, d); // x x z z | x x z z
  value[0] = (vdouble)_mm512_maskz_shuffle_f64x2(0xff, xz_ab, xz_cd, 0x88);
  value[1] = (vdouble)_mm512_maskz_shuffle_f64x2(0xff, odd(a, b), odd(c, d), 0x88);
  value[2] = (vdouble)_mm512_maskz_shuffle_f64x2(0xff, xz_ab, xz_cd, 0xdd);
}

template <bool add>
MESOSLIP_INLINE void
put_nodes(double *field, const std::uint32_t *node, const vdouble (&value)[3])
{
  const auto put_four_nodes = [&](const unsigned int l, const __m512d xy,
                                  const __m512d z) {
    const auto put_one = [&](const unsigned int k, const __m512d v) {
      put<add>(field + 4 * std::size_t(node[l + k]), _mm512_castpd512_pd256(v));
      put<add>(field + 4 * std::size_t(node[l + k + 4]),
               _mm512_maskz_extractf64x4_pd(0xf, v, 1));
    };
    const __m512i low  = _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0);
    const __m512i high = _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4);
    put_one(0, _mm512_maskz_permutex2var_pd(0xff, xy, low, z));
    put_one(2, _mm512_maskz_permutex2var_pd(0xff, xy, high, z));
  };
  const __m512d x = (__m512d)value[0], y = (__m512d)value[1], z = (__m512d)value[2];
  const __m512d nothing = _mm512_setzero_pd();
  put_four_nodes(0, even(x, y), even(z, nothing));
  put_four_nodes(1, odd(x, y), odd(z, nothing));
}
#else
template <int dim>
constexpr unsigned int lane_order[] = {0, 1, 2, 3, 4, 5, 6, 7};

template <int dim>
MESOSLIP_INLINE void
load_nodes(const double *field, const std::uint32_t *node, vdouble (&value)[dim])
{
  for (int c = 0; c < dim; ++c)
    {
      for (unsigned int l = 0; l < n_lanes; ++l)
        value[c][l] = field[node_stride<dim> * std::size_t(node[l]) + c];
    }
}

template <bool add, int dim>
MESOSLIP_INLINE void
put_nodes(double *field, const std::uint32_t *node, const vdouble (&value)[dim])
{
  for (unsigned int l = 0; l < n_lanes; ++l)
    for (int c = 0; c < dim; ++c)
      {
        double &component = field[node_stride<dim> * std::size_t(node[l]) + c];
        component         = add ? component + value[c][l] : value[c][l];
      }
}
#endif
