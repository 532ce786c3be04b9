// Rows of nodes and phases in memory, as read by a sweep over a box of bricks. Included
// inside a namespace by brick_kernel.cc.

/** Source of the values of a row: x, or u + beta w. */
struct Source
{
  const double *x[3], *w[3];
  double beta;
};

/** Prefetches nodes of @p source at @p place. */
MESOSLIP_INLINE void prefetch_row(const Source &source, const std::size_t place)
{
  for (int c = 0; c < 3; ++c)
    {
      __builtin_prefetch(source.x[c] + place);
      if (source.beta != 0.)
        __builtin_prefetch(source.w[c] + place);
    }
}

/** Coefficients of the cells of a row by phase. */
template <unsigned int n>
struct OfPhases
{
  static constexpr unsigned int n_coefficients = n;
  static constexpr bool adds_stress            = false;
  static constexpr bool cubes                  = n == n_cubes;

  /** @p place: first of the nodes to be prefetched. */
  OfPhases(const BrickSweep &a,
           const std::size_t row,
           const Source &source,
           const std::size_t place)
    : first(a.phase + row * a.stride)
    , table(a.stiffness)
    , is_short(has_lookup && a.n_phases <= Simd<double>::length)
    , source(source)
    , place(place)
  {
  }

  inline __attribute__((always_inline)) void prefetch(const std::size_t i) const
  {
    prefetch_row(source, place + i);
  }

  inline __attribute__((always_inline)) Stiffness<double, n> at(const std::size_t i) const
  {
    const vint64 index = load_bytes(first + i, vint64{});
#if defined(__AVX512F__)
    if (is_short)
      return Stiffness<double, n>::of([&](const unsigned int m) __attribute__((
        always_inline)) { return lookup(load(table + std::size_t{256} * m), index); });
#endif
    return Stiffness<double, n>::of([&](const unsigned int m) __attribute__((
      always_inline)) { return gather(table + std::size_t{256} * m, index); });
  }

  const std::uint8_t *first;
  const double *table;
  const bool is_short;
  const Source &source;
  const std::size_t place;
};

/**
 * Coefficients of the cells of a row by material; there may be more than 256 materials.
 * The coefficients of a material are contiguous, as a large table exceeds the first-level
 * cache.
 */
template <unsigned int n>
struct OfMaterials
{
  static constexpr unsigned int n_coefficients = n;
  static constexpr bool adds_stress            = false;
  static constexpr bool cubes                  = false;

  OfMaterials(const BrickSweep &a,
              const std::size_t row,
              const Source &source,
              const std::size_t place)
    : first(a.material + row * a.stride)
    , table(a.stiffness)
    , source(source)
    , place(place)
  {
  }

  inline __attribute__((always_inline)) void prefetch(const std::size_t i) const
  {
    prefetch_row(source, place + i);
  }

  inline __attribute__((always_inline)) Stiffness<double, n> at(const std::size_t i) const
  {
    const vint64 index = load_words(first + i, vint64{}) * int{n_of_material(n)};
    return Stiffness<double, n>::of([&](const unsigned int m) __attribute__((
      always_inline)) { return gather(table + m, index); });
  }

  const std::uint16_t *first;
  const double *table;
  const Source &source;
  const std::size_t place;
};

#if defined(__AVX512F__)
/**
 * Mask of the first @p n numbers of a vector. Copying numbers one by one to the stack
 * would cost a third of the step for short rows.
 */
MESOSLIP_INLINE __mmask8 first_of(const std::size_t n)
{
  return static_cast<__mmask8>((1U << n) - 1U);
}

/**
 * Loads @p n numbers from an unaligned address, n below the vector length; the rest is
 * zero.
 */
MESOSLIP_INLINE vdouble load_some(const double *p, const std::size_t n)
{
  return (vdouble)_mm512_maskz_loadu_pd(first_of(n), p);
}

/** Stores the first @p n numbers of a vector. */
MESOSLIP_INLINE void store_some(double *p, const vdouble v, const std::size_t n)
{
  _mm512_mask_storeu_pd(p, first_of(n), (mdouble)v);
}
#else
/**
 * Loads @p n numbers from an unaligned address, n below the vector length; the rest is
 * zero.
 */
MESOSLIP_INLINE vdouble load_some(const double *p, const std::size_t n)
{
  vdouble v = {};
  for (std::size_t l = 0; l < n; ++l)
    v[l] = p[l];
  return v;
}

/** Stores the first @p n numbers of a vector. */
MESOSLIP_INLINE void store_some(double *p, const vdouble v, const std::size_t n)
{
  for (std::size_t l = 0; l < n; ++l)
    p[l] = v[l];
}
#endif

/** Stores a vector to an unaligned address. */
MESOSLIP_INLINE void store_any(double *p, const vdouble v)
{
  typedef double vector __attribute__((vector_size(MESOSLIP_VECTOR_BYTES),
                                       aligned(sizeof(double)), may_alias));
  *reinterpret_cast<vector *>(p) = (vector)v;
}

/**
 * Copies a row of nodes that starts at @p place, followed by the first node again if x is
 * periodic.
 */
MESOSLIP_INLINE void
copy_row(const BrickSweep &a, const Source &source, const std::size_t place, double *row)
{
  constexpr std::size_t length = Simd<double>::length;
  const std::size_t n = a.n[0], whole = n / length * length;
  for (int c = 0; c < 3; ++c, row += a.stride)
    {
      const double *x = source.x[c] + place;
      if (source.beta == 0.)
        {
          for (std::size_t i = 0; i < whole; i += length)
            store(row + i, load_any(x + i));
          store_some(row + whole, load_some(x + whole, n - whole), n - whole);
        }
      else
        {
          const double *w = source.w[c] + place;
          for (std::size_t i = 0; i < whole; i += length)
            store(row + i, fma(splat(source.beta), load_any(w + i), load_any(x + i)));
          store_some(row + whole,
                     fma(splat(source.beta), load_some(w + whole, n - whole),
                         load_some(x + whole, n - whole)),
                     n - whole);
        }
      if (a.periodic)
        row[n] = row[0];
    }
}
