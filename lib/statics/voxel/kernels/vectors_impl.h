// Operations on whole fields, documented in kernels.h. Included inside a namespace by
// kernels_table.cc.

/** Sum of the entries in double precision. */
template <typename Number, typename Vector>
MESOSLIP_INLINE double sum_of(const Vector v)
{
  double sum = 0.;
  for (unsigned int l = 0; l < Simd<Number>::length; ++l)
    sum += v[l];
  return sum;
}

static void
combine(const std::size_t n, const float a, const float *x, const float b, float *y)
{
  for (std::size_t i = 0; i < n; i += Simd<float>::length)
    store(y + i, a * load(x + i) + b * load(y + i));
}

static void first_step(const std::size_t n_rows,
                       const std::size_t stride,
                       const unsigned int n_components,
                       const unsigned int n_diagonals,
                       const float a,
                       const float *inverse,
                       const float *b,
                       float *x)
{
  for (std::size_t row = 0; row < n_rows; ++row)
    for (std::size_t c = 0; c < n_components; ++c)
      {
        const std::size_t first = (n_components * row + c) * stride;
        const float *diagonal =
          inverse + (n_diagonals == n_components ? first : row * stride);
        for (std::size_t i = 0; i < stride; i += Simd<float>::length)
          store(x + first + i, a * load(diagonal + i) * load(b + first + i));
      }
}

/** Sums use single precision within pieces of this length, double precision beyond. */
constexpr std::size_t piece = 512;

template <typename Term>
MESOSLIP_INLINE double sum_in_pieces(const std::size_t n, const Term &term)
{
  double sum = 0.;
  for (std::size_t begin = 0; begin < n; begin += piece)
    {
      const std::size_t end = begin + piece < n ? begin + piece : n;
      vfloat part           = {};
      for (std::size_t i = begin; i < end; i += Simd<float>::length)
        part += term(i);
      sum += sum_of<float>(part);
    }
  return sum;
}

static double dot(const std::size_t n, const float *x, const float *y)
{
  return sum_in_pieces(
    n, [=](const std::size_t i)
         __attribute__((always_inline)) { return load(x + i) * load(y + i); });
}

/** A vector converted from single to double precision. */
MESOSLIP_INLINE vdouble widened(const float *p)
{
  typedef float half
    __attribute__((vector_size(MESOSLIP_VECTOR_BYTES / 2), aligned(4), may_alias));
  return __builtin_convertvector(*reinterpret_cast<const half *>(p), vdouble);
}

static double mixed_dot(const std::size_t n, const float *x, const double *y)
{
  vdouble sum = {};
  for (std::size_t i = 0; i < n; i += Simd<double>::length)
    sum += widened(x + i) * load(y + i);
  return sum_of<double>(sum);
}

static double step(
  const std::size_t n, const float a, const float *p, const float *q, double *u, float *r)
{
  const double factor = a;
  return sum_in_pieces(
    n, [=](const std::size_t i) __attribute__((always_inline)) {
      for (std::size_t l = i; l < i + Simd<float>::length; l += Simd<double>::length)
        store(u + l, load(u + l) + factor * widened(p + l));
      const vfloat value = load(r + i) - a * load(q + i);
      store(r + i, value);
      return value * value;
    });
}
