// Vectors of the instruction set this translation unit is compiled for. Included by the
// row kernels only, inside their namespace: see row_kernel.cc.
//
// GCC vector extensions where they suffice; intrinsics for fused multiply-add, table
// lookup and widening of bytes. Contraction by the compiler is off, so that only fma() is
// a fused multiply-add and all variants of a kernel agree bit for bit.

#if defined(__AVX512F__)
#  define MESOSLIP_VECTOR_BYTES 64
#elif defined(__AVX2__)
#  define MESOSLIP_VECTOR_BYTES 32
#else
#  define MESOSLIP_VECTOR_BYTES 16
#endif

#define MESOSLIP_INLINE static inline __attribute__((always_inline))

typedef double vdouble __attribute__((vector_size(MESOSLIP_VECTOR_BYTES), may_alias));
typedef float vfloat __attribute__((vector_size(MESOSLIP_VECTOR_BYTES), may_alias));
typedef std::int64_t vint64
  __attribute__((vector_size(MESOSLIP_VECTOR_BYTES), may_alias));
typedef std::int32_t vint32
  __attribute__((vector_size(MESOSLIP_VECTOR_BYTES), may_alias));

template <typename Number>
struct Simd;

template <>
struct Simd<double>
{
  using Vector                         = vdouble;
  using Index                          = vint64;
  static constexpr unsigned int length = MESOSLIP_VECTOR_BYTES / 8;
};

template <>
struct Simd<float>
{
  using Vector                         = vfloat;
  using Index                          = vint32;
  static constexpr unsigned int length = MESOSLIP_VECTOR_BYTES / 4;
};

template <typename Number>
MESOSLIP_INLINE typename Simd<Number>::Vector load(const Number *p)
{
  return *reinterpret_cast<const typename Simd<Number>::Vector *>(p);
}

template <typename Number>
MESOSLIP_INLINE void store(Number *p, const typename Simd<Number>::Vector v)
{
  *reinterpret_cast<typename Simd<Number>::Vector *>(p) = v;
}

template <typename Number>
MESOSLIP_INLINE typename Simd<Number>::Vector splat(const Number x)
{
  return x - typename Simd<Number>::Vector{};
}

#if defined(__AVX512F__)
#  define MESOSLIP_MM(name) _mm512_##name
typedef __m512d mdouble;
typedef __m512 mfloat;
#elif defined(__FMA__)
#  define MESOSLIP_MM(name) _mm256_##name
typedef __m256d mdouble;
typedef __m256 mfloat;
#endif

// fma: a * b + c; fnma: c - a * b
#ifdef MESOSLIP_MM
MESOSLIP_INLINE vdouble fma(const vdouble a, const vdouble b, const vdouble c)
{
  return (vdouble)MESOSLIP_MM(fmadd_pd)((mdouble)a, (mdouble)b, (mdouble)c);
}

MESOSLIP_INLINE vfloat fma(const vfloat a, const vfloat b, const vfloat c)
{
  return (vfloat)MESOSLIP_MM(fmadd_ps)((mfloat)a, (mfloat)b, (mfloat)c);
}

MESOSLIP_INLINE vdouble fnma(const vdouble a, const vdouble b, const vdouble c)
{
  return (vdouble)MESOSLIP_MM(fnmadd_pd)((mdouble)a, (mdouble)b, (mdouble)c);
}

MESOSLIP_INLINE vfloat fnma(const vfloat a, const vfloat b, const vfloat c)
{
  return (vfloat)MESOSLIP_MM(fnmadd_ps)((mfloat)a, (mfloat)b, (mfloat)c);
}

MESOSLIP_INLINE vdouble square_root(const vdouble x)
{
#  ifdef __AVX512F__ // GCC 12 warns about uninitialized parts in _mm512_sqrt_pd()
  return (vdouble)_mm512_maskz_sqrt_pd(0xff, (mdouble)x);
#  else
  return (vdouble)_mm256_sqrt_pd((mdouble)x);
#  endif
}
#else
template <typename Vector>
MESOSLIP_INLINE Vector fma(const Vector a, const Vector b, const Vector c)
{
  return a * b + c;
}

template <typename Vector>
MESOSLIP_INLINE Vector fnma(const Vector a, const Vector b, const Vector c)
{
  return c - a * b;
}

MESOSLIP_INLINE vdouble square_root(vdouble x)
{
  for (unsigned int l = 0; l < Simd<double>::length; ++l)
    x[l] = __builtin_sqrt(x[l]);
  return x;
}
#endif
#undef MESOSLIP_MM

/** The vector (0, 1, 2, ...). */
MESOSLIP_INLINE vint64 iota(const vint64)
{
#if MESOSLIP_VECTOR_BYTES == 64
  return vint64{0, 1, 2, 3, 4, 5, 6, 7};
#elif MESOSLIP_VECTOR_BYTES == 32
  return vint64{0, 1, 2, 3};
#else
  return vint64{0, 1};
#endif
}

MESOSLIP_INLINE vint32 iota(const vint32)
{
#if MESOSLIP_VECTOR_BYTES == 64
  return vint32{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
#elif MESOSLIP_VECTOR_BYTES == 32
  return vint32{0, 1, 2, 3, 4, 5, 6, 7};
#else
  return vint32{0, 1, 2, 3};
#endif
}

/**
 * Window of vector length into (a, b), from entry @p first on. GCC shuffles by vectors,
 * clang by constants.
 */
template <int first, typename Vector>
MESOSLIP_INLINE Vector window(const Vector a, const Vector b)
{
#ifdef __clang__
  constexpr int n = sizeof(Vector) / sizeof(a[0]);
  Vector result   = a;
  for (int i = 0; i < n; ++i)
    result[i] = first + i < n ? a[first + i] : b[first + i - n];
  return result;
#else
  if constexpr (sizeof(a[0]) == 8)
    return __builtin_shuffle(a, b, iota(vint64{}) + first);
  else
    return __builtin_shuffle(a, b, iota(vint32{}) + first);
#endif
}

/** Right neighbours of a: (a_1, a_2, ..., b_0). */
template <typename Vector>
MESOSLIP_INLINE Vector right_neighbours(const Vector a, const Vector b)
{
  return window<1>(a, b);
}

/** Left neighbours of b: (a_last, b_0, b_1, ...). */
template <typename Vector>
MESOSLIP_INLINE Vector left_neighbours(const Vector a, const Vector b)
{
  return window<sizeof(Vector) / sizeof(a[0]) - 1>(a, b);
}

/**
 * Loads one vector of bytes and widens them. (The forms without mask make GCC 12 warn
 * about its own header.)
 */
MESOSLIP_INLINE vint64 load_bytes(const std::uint8_t *p, const vint64)
{
#if defined(__AVX512F__)
  return (vint64)_mm512_maskz_cvtepu8_epi64(0xff, _mm_loadl_epi64((const __m128i *)p));
#elif defined(__AVX2__)
  return (vint64)_mm256_cvtepu8_epi64(_mm_loadu_si32(p));
#else
  return vint64{p[0], p[1]};
#endif
}

MESOSLIP_INLINE vint32 load_bytes(const std::uint8_t *p, const vint32)
{
#if defined(__AVX512F__)
  return (vint32)_mm512_maskz_cvtepu8_epi32(0xffff, _mm_loadu_si128((const __m128i *)p));
#elif defined(__AVX2__)
  return (vint32)_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)p));
#else
  return vint32{p[0], p[1], p[2], p[3]};
#endif
}

/** Loads one vector of two-byte numbers and widens them. */
MESOSLIP_INLINE vint64 load_words(const std::uint16_t *p, const vint64)
{
#if defined(__AVX512F__)
  return (vint64)_mm512_maskz_cvtepu16_epi64(0xff, _mm_loadu_si128((const __m128i *)p));
#elif defined(__AVX2__)
  return (vint64)_mm256_cvtepu16_epi64(_mm_loadl_epi64((const __m128i *)p));
#else
  return vint64{p[0], p[1]};
#endif
}

MESOSLIP_INLINE vint32 load_words(const std::uint16_t *p, const vint32)
{
#if defined(__AVX512F__)
  return (vint32)_mm512_maskz_cvtepu16_epi32(0xffff,
                                             _mm256_loadu_si256((const __m256i *)p));
#elif defined(__AVX2__)
  return (vint32)_mm256_cvtepu16_epi32(_mm_loadu_si128((const __m128i *)p));
#else
  return vint32{p[0], p[1], p[2], p[3]};
#endif
}

#if defined(__AVX512F__)
/** Whether lookup() exists. */
constexpr bool has_lookup = true;

/** table[index] for a table of one vector. */
MESOSLIP_INLINE vdouble lookup(const vdouble table, const vint64 index)
{
  return (vdouble)_mm512_maskz_permutexvar_pd(0xff, (__m512i)index, (__m512d)table);
}

MESOSLIP_INLINE vfloat lookup(const vfloat table, const vint32 index)
{
  return (vfloat)_mm512_maskz_permutexvar_ps(0xffff, (__m512i)index, (__m512)table);
}

/** table[index] for a table of two vectors. */
MESOSLIP_INLINE vdouble lookup(const vdouble low, const vdouble high, const vint64 index)
{
  return (vdouble)_mm512_permutex2var_pd((__m512d)low, (__m512i)index, (__m512d)high);
}

MESOSLIP_INLINE vfloat lookup(const vfloat low, const vfloat high, const vint32 index)
{
  return (vfloat)_mm512_permutex2var_ps((__m512)low, (__m512i)index, (__m512)high);
}

/** table[index] for a table in memory. */
MESOSLIP_INLINE vdouble gather(const double *table, const vint64 index)
{
  return (vdouble)_mm512_mask_i64gather_pd(_mm512_setzero_pd(), 0xff, (__m512i)index,
                                           table, 8);
}

MESOSLIP_INLINE vfloat gather(const float *table, const vint32 index)
{
  return (vfloat)_mm512_mask_i32gather_ps(_mm512_setzero_ps(), 0xffff, (__m512i)index,
                                          table, 4);
}
#else
constexpr bool has_lookup = false;

#  ifdef __AVX2__
// GCC 12 would compile the loop below to stores and loads.
MESOSLIP_INLINE vdouble gather(const double *table, const vint64 index)
{
  return vdouble{table[index[0]], table[index[1]], table[index[2]], table[index[3]]};
}

MESOSLIP_INLINE vfloat gather(const float *table, const vint32 index)
{
  return (vfloat)_mm256_i32gather_ps(table, (__m256i)index, 4);
}
#  else
template <typename Number, typename Index>
MESOSLIP_INLINE typename Simd<Number>::Vector gather(const Number *table,
                                                     const Index index)
{
  typename Simd<Number>::Vector result = {};
  for (unsigned int l = 0; l < Simd<Number>::length; ++l)
    result[l] = table[index[l]];
  return result;
}
#  endif
#endif
