// Transposition between memory, where the components of a node are contiguous, and
// vectors over nodes: one corner of each cell of a batch, or nodes in a row. Included by
// the kernels of general cells only, inside their namespace, after simd.h. load_nodes()
// defines the order of the cells of a batch in a vector.
//
// add_to_nodes() processes one node after another, so that cells of a batch may share
// nodes.

constexpr unsigned int n_lanes = Simd<double>::length;

#if defined(__AVX512F__)
MESOSLIP_INLINE __m256d join(const __m128d a, const __m128d b)
{
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(a), b, 1);
}

MESOSLIP_INLINE __m512d join(const __m256d a, const __m256d b)
{
  return _mm512_insertf64x4(_mm512_castpd256_pd512(a), b, 1);
}

MESOSLIP_INLINE void add(double *p, const __m128d x)
{
  _mm_store_pd(p, _mm_add_pd(_mm_load_pd(p), x));
}

MESOSLIP_INLINE void add(double *p, const __m256d x)
{
  _mm256_store_pd(p, _mm256_add_pd(_mm256_load_pd(p), x));
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

/** Entries of (a, b) by index, the last one first as in _mm512_set_epi64(). */
template <int... places>
MESOSLIP_INLINE __m512d pick(const __m512d a, const __m512d b)
{
  return _mm512_maskz_permutex2var_pd(0xff, a, _mm512_set_epi64(places...), b);
}

MESOSLIP_INLINE void
load_nodes(const double *field, const std::uint32_t *node, vdouble (&value)[2])
{
  const auto four_nodes = [&](const unsigned int l) __attribute__((always_inline))
  {
    const auto pair = [&](const unsigned int k) __attribute__((always_inline))
    {
      return _mm_load_pd(field + node[l + k]);
    };
    return join(join(pair(0), pair(1)), join(pair(2), pair(3)));
  };
  const __m512d a = four_nodes(0), b = four_nodes(4);
  value[0] = (vdouble)even(a, b);
  value[1] = (vdouble)odd(a, b);
}

MESOSLIP_INLINE void
add_to_nodes(double *field, const std::uint32_t *node, const vdouble (&value)[2])
{
  const auto add_to_four = [&](const unsigned int l, const __m512d v)
    __attribute__((always_inline))
  {
    const __m256d low  = _mm512_castpd512_pd256(v);
    const __m256d high = _mm512_maskz_extractf64x4_pd(0xf, v, 1);
    add(field + node[l], _mm256_castpd256_pd128(low));
    add(field + node[l + 1], _mm256_extractf128_pd(low, 1));
    add(field + node[l + 2], _mm256_castpd256_pd128(high));
    add(field + node[l + 3], _mm256_extractf128_pd(high, 1));
  };
  const __m512d x = (__m512d)value[0], y = (__m512d)value[1];
  add_to_four(0, even(x, y));
  add_to_four(4, odd(x, y));
}

MESOSLIP_INLINE void
load_nodes(const double *field, const std::uint32_t *node, vdouble (&value)[3])
{
  const auto two_nodes = [&](const unsigned int l) __attribute__((always_inline))
  {
    return join(_mm256_load_pd(field + node[l]), _mm256_load_pd(field + node[l + 4]));
  };
  const __m512d a = two_nodes(0), b = two_nodes(1), c = two_nodes(2), d = two_nodes(3);
  const __m512d xz_ab = even(a, b), xz_cd = even(c, d); // x x z z | x x z z
  value[0] = (vdouble)_mm512_maskz_shuffle_f64x2(0xff, xz_ab, xz_cd, 0x88);
  value[1] = (vdouble)_mm512_maskz_shuffle_f64x2(0xff, odd(a, b), odd(c, d), 0x88);
  value[2] = (vdouble)_mm512_maskz_shuffle_f64x2(0xff, xz_ab, xz_cd, 0xdd);
}

MESOSLIP_INLINE void
add_to_nodes(double *field, const std::uint32_t *node, const vdouble (&value)[3])
{
  const auto add_to_two = [&](const unsigned int l, const __m512d v)
    __attribute__((always_inline))
  {
    add(field + node[l], _mm512_castpd512_pd256(v));
    add(field + node[l + 4], _mm512_maskz_extractf64x4_pd(0xf, v, 1));
  };
  const __m512d x = (__m512d)value[0], y = (__m512d)value[1], z = (__m512d)value[2];
  const __m512d nothing  = _mm512_setzero_pd();
  const auto add_to_four = [&](const unsigned int l, const __m512d xy, const __m512d z0)
    __attribute__((always_inline))
  {
    add_to_two(l, pick<11, 10, 3, 2, 9, 8, 1, 0>(xy, z0));
    add_to_two(l + 2, pick<15, 14, 7, 6, 13, 12, 5, 4>(xy, z0));
  };
  add_to_four(0, even(x, y), even(z, nothing));
  add_to_four(1, odd(x, y), odd(z, nothing));
}

MESOSLIP_INLINE void load_row(const double *node, vdouble (&value)[2])
{
  const __m512d a = _mm512_load_pd(node), b = _mm512_load_pd(node + 8);
  value[0] = (vdouble)pick<14, 12, 10, 8, 6, 4, 2, 0>(a, b);
  value[1] = (vdouble)pick<15, 13, 11, 9, 7, 5, 3, 1>(a, b);
}

MESOSLIP_INLINE void store_row(double *node, const vdouble (&value)[2])
{
  const __m512d x = (__m512d)value[0], y = (__m512d)value[1];
  _mm512_store_pd(node, pick<11, 3, 10, 2, 9, 1, 8, 0>(x, y));
  _mm512_store_pd(node + 8, pick<15, 7, 14, 6, 13, 5, 12, 4>(x, y));
}

MESOSLIP_INLINE void load_row(const double *node, vdouble (&value)[3])
{
  const auto four_nodes = [&](const int first, __m512d &xy, __m512d &z) {
    const __m512d a = _mm512_load_pd(node + first), b = _mm512_load_pd(node + first + 8);
    xy = pick<13, 12, 9, 8, 5, 4, 1, 0>(a, b); // x y x y x y x y
    z  = pick<15, 14, 11, 10, 7, 6, 3, 2>(a, b);
  };
  __m512d xy[2], z[2];
  four_nodes(0, xy[0], z[0]);
  four_nodes(16, xy[1], z[1]);
  value[0] = (vdouble)pick<14, 12, 10, 8, 6, 4, 2, 0>(xy[0], xy[1]);
  value[1] = (vdouble)pick<15, 13, 11, 9, 7, 5, 3, 1>(xy[0], xy[1]);
  value[2] = (vdouble)pick<14, 12, 10, 8, 6, 4, 2, 0>(z[0], z[1]);
}

MESOSLIP_INLINE void store_row(double *node, const vdouble (&value)[3])
{
  const __m512d x = (__m512d)value[0], y = (__m512d)value[1], z = (__m512d)value[2];
  const __m512d nothing = _mm512_setzero_pd();
  const auto store_four = [&](double *p, const __m512d xy, const __m512d z0) {
    _mm512_store_pd(p, pick<11, 10, 3, 2, 9, 8, 1, 0>(xy, z0));
    _mm512_store_pd(p + 8, pick<15, 14, 7, 6, 13, 12, 5, 4>(xy, z0));
  };
  store_four(node, pick<11, 3, 10, 2, 9, 1, 8, 0>(x, y),
             pick<8, 3, 8, 2, 8, 1, 8, 0>(z, nothing));
  store_four(node + 16, pick<15, 7, 14, 6, 13, 5, 12, 4>(x, y),
             pick<8, 7, 8, 6, 8, 5, 8, 4>(z, nothing));
}
#else
template <int dim>
MESOSLIP_INLINE void
load_nodes(const double *field, const std::uint32_t *node, vdouble (&value)[dim])
{
  for (int c = 0; c < dim; ++c)
    {
      for (unsigned int l = 0; l < n_lanes; ++l)
        value[c][l] = field[node[l] + c];
    }
}

template <int dim>
MESOSLIP_INLINE void
add_to_nodes(double *field, const std::uint32_t *node, const vdouble (&value)[dim])
{
  for (unsigned int l = 0; l < n_lanes; ++l)
    for (int c = 0; c < dim; ++c)
      field[node[l] + c] += value[c][l];
}

template <int dim>
MESOSLIP_INLINE void load_row(const double *node, vdouble (&value)[dim])
{
  for (int c = 0; c < dim; ++c)
    for (unsigned int l = 0; l < n_lanes; ++l)
      value[c][l] = node[node_stride<dim> * l + c];
}

template <int dim>
MESOSLIP_INLINE void store_row(double *node, const vdouble (&value)[dim])
{
  for (unsigned int l = 0; l < n_lanes; ++l)
    for (int c = 0; c < dim; ++c)
      node[node_stride<dim> * l + c] = value[c][l];
}
#endif
