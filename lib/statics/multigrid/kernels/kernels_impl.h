// The row kernels of the multigrid, documented in kernels.h. Included inside a namespace
// by kernels_table.cc.

/** Position of entry (r, c) of the upper triangle of a symmetric block. */
template <int n>
constexpr int packed(const int r, const int c)
{
  return r <= c ? r * n - r * (r - 1) / 2 + (c - r) : packed<n>(c, r);
}

/** A cache line of numbers at any address, and four of them for transposition. */
template <typename Number>
struct Vectors;

template <>
struct Vectors<float>
{
  typedef float line __attribute__((vector_size(64), aligned(4), may_alias));
  typedef float four __attribute__((vector_size(16), aligned(4), may_alias));
  static constexpr int n = 16;
};

template <>
struct Vectors<double>
{
  typedef double line __attribute__((vector_size(64), aligned(8), may_alias));
  typedef double four __attribute__((vector_size(32), aligned(8), may_alias));
  static constexpr int n = 8;
};

template <typename Number>
using line = typename Vectors<Number>::line;

#define MESOSLIP_INLINE static inline __attribute__((always_inline))

template <typename Number>
MESOSLIP_INLINE line<Number> load(const Number *p)
{
  return *reinterpret_cast<const line<Number> *>(p);
}

template <typename Number>
MESOSLIP_INLINE void store(Number *p, const line<Number> v)
{
  *reinterpret_cast<line<Number> *>(p) = v;
}

/** sum += a block of the stencil times a neighbour's three values. */
template <int row_step, int column_step, typename Number>
MESOSLIP_INLINE void add_block(const Number *a,
                               const std::size_t s,
                               const Number *const x[3],
                               const long i,
                               line<Number> sum[3])
{
  for (int c = 0; c < 3; ++c)
    {
      const line<Number> value = load(x[c] + i);
      for (int r = 0; r < 3; ++r)
        sum[r] += load(a + (r * row_step + c * column_step) * s) * value;
    }
}

template <typename Number>
static void stencil_residual(const unsigned int n,
                             const Number *a,
                             const Number *below,
                             const std::size_t s,
                             const Number *const x[9],
                             const Number *const b[3],
                             Number *const r[3])
{
  const Number *const *lower = x, *const *middle = x + 3, *const *upper = x + 6;
  for (long i = 0; i < static_cast<long>(n); i += Vectors<Number>::n)
    {
      line<Number> sum[3], value[3];
      for (int c = 0; c < 3; ++c)
        value[c] = load(middle[c] + i);
      for (int c = 0; c < 3; ++c)
        {
          sum[c] = load(a + (centre + packed<3>(c, 0)) * s + i) * value[0];
          for (int k = 1; k < 3; ++k)
            sum[c] += load(a + (centre + packed<3>(c, k)) * s + i) * value[k];
        }
      // Blocks of the node with its neighbours, then of neighbours with the node.
      add_block<3, 1>(a + east * s + i, s, middle, i + 1, sum);
      add_block<3, 1>(a + north_west * s + i, s, upper, i - 1, sum);
      add_block<3, 1>(a + north * s + i, s, upper, i, sum);
      add_block<3, 1>(a + north_east * s + i, s, upper, i + 1, sum);
      add_block<1, 3>(a + east * s + i - 1, s, middle, i - 1, sum);
      add_block<1, 3>(below + north_west * s + i + 1, s, lower, i + 1, sum);
      add_block<1, 3>(below + north * s + i, s, lower, i, sum);
      add_block<1, 3>(below + north_east * s + i - 1, s, lower, i - 1, sum);
      for (int c = 0; c < 3; ++c)
        store<Number>(r[c] + i, load(b[c] + i) - sum[c]);
    }
}

template <typename Number>
static void split(const unsigned int n,
                  const Number *__restrict__ row,
                  Number *__restrict__ even,
                  Number *__restrict__ odd)
{
  for (std::size_t i = 0; i < n; ++i)
    {
      even[i] = row[2 * i];
      odd[i]  = row[2 * i + 1];
    }
}

template <typename Number>
static void merge(const unsigned int n,
                  const Number *__restrict__ even,
                  const Number *__restrict__ odd,
                  Number *__restrict__ row)
{
  for (std::size_t i = 0; i < n; ++i)
    {
      row[2 * i] += even[i];
      row[2 * i + 1] += odd[i];
    }
}

template <int nc, typename Number>
static void restrict_row(const unsigned int n,
                         const TransferRow<Number> &row,
                         const Number *const even[],
                         const Number *const odd[],
                         Number *const coarse[3])
{
  const Number dy = row.dy;
  for (long i = 0; i < static_cast<long>(n); i += Vectors<Number>::n)
    {
      // q and its factors belong to the cell on the left.
      const line<Number> w = load(row.even + i), p = load(row.odd_left + i),
                         q = load(row.odd_right + i - 1);
      const auto add       = [=](Number *to, const line<Number> value) {
        store<Number>(to + i, load(to + i) + value);
      };
      for (int c = 0; c < nc; ++c)
        add(coarse[c],
            w * load(even[c] + i) + p * load(odd[c] + i) + q * load(odd[c] + i - 1));
      add(coarse[2],
          p * (load(row.to_left + i) * load(odd[1] + i) - dy * load(odd[0] + i)) -
            q * (load(row.to_right + i - 1) * load(odd[1] + i - 1) +
                 dy * load(odd[0] + i - 1)) -
            dy * w * load(even[0] + i));
    }
}

template <int nc, typename Number>
static void prolongate_row(const unsigned int n,
                           const TransferRow<Number> &row,
                           const bool add,
                           const Number *const coarse[3],
                           Number *const even[],
                           Number *const odd[])
{
  const Number dy = row.dy;
  for (unsigned int i = 0; i < n; i += Vectors<Number>::n)
    {
      const line<Number> w = load(row.even + i), p = load(row.odd_left + i),
                         q = load(row.odd_right + i);
      const line<Number> t = load(coarse[2] + i), t1 = load(coarse[2] + i + 1);
      const line<Number> u  = load(coarse[0] + i) - dy * t,
                         u1 = load(coarse[0] + i + 1) - dy * t1;
      const line<Number> v = load(coarse[1] + i), v1 = load(coarse[1] + i + 1);
      const auto put = [=](Number *to, const line<Number> value) {
        store<Number>(to + i, add ? load(to + i) + value : value);
      };
      put(even[0], w * u);
      put(odd[0], p * u + q * u1);
      put(even[1], w * v);
      put(odd[1],
          p * (v + load(row.to_left + i) * t) + q * (v1 - load(row.to_right + i) * t1));
      if constexpr (nc == 3)
        {
          put(even[2], w * t);
          put(odd[2], p * t + q * t1);
        }
    }
}

// Kernels of the conjugate gradients and of the bottom of the hierarchy.

static void dense(const unsigned int n,
                  const double *__restrict__ matrix,
                  const std::size_t stride,
                  const double *__restrict__ x,
                  double *__restrict__ y)
{
  const unsigned int whole = (n + 7) / 8 * 8;
  for (unsigned int i = 0; i < whole; ++i)
    y[i] = 0.;
  for (unsigned int j = 0; j < n; ++j)
    {
      const double factor               = x[j];
      const double *__restrict__ column = matrix + j * stride;
      for (unsigned int i = 0; i < whole; ++i)
        y[i] += factor * column[i];
    }
}

/** Sums run in 16 lanes that are added up in the end: the compiler may not reorder. */
static double add_up(const double *lanes)
{
  double sum = 0.;
  for (int l = 0; l < 16; ++l)
    sum += lanes[l];
  return sum;
}

static double dot(const std::size_t n, const double *a, const double *b)
{
  double sums[16] = {};
  for (std::size_t i = 0; i < n; i += 16)
    for (int l = 0; l < 16; ++l)
      sums[l] += a[i + l] * b[i + l];
  return add_up(sums);
}

static double step(const std::size_t n,
                   const double alpha,
                   const double *__restrict__ p,
                   const double *__restrict__ q,
                   double *__restrict__ x,
                   double *__restrict__ r)
{
  double sums[16] = {};
  for (std::size_t i = 0; i < n; i += 16)
    for (int l = 0; l < 16; ++l)
      {
        x[i + l] += alpha * p[i + l];
        const double v = r[i + l] - alpha * q[i + l];
        r[i + l]       = v;
        sums[l] += v * v;
      }
  return add_up(sums);
}

template <typename Number>
static void direction(const std::size_t n,
                      const double scale,
                      const double beta,
                      const Number *__restrict__ z,
                      double *__restrict__ p)
{
  for (std::size_t i = 0; i < n; ++i)
    p[i] = scale * static_cast<double>(z[i]) + beta * p[i];
}

template <typename Number>
static void scaled(const std::size_t n,
                   const double scale,
                   const double *__restrict__ x,
                   Number *__restrict__ y)
{
  for (std::size_t i = 0; i < n; ++i)
    y[i] = static_cast<Number>(scale * x[i]);
}

template <typename Number>
static void two_dots(const std::size_t n,
                     const double *__restrict__ r,
                     const double *__restrict__ q,
                     const Number *__restrict__ z,
                     double results[2])
{
  double rz[16] = {}, qz[16] = {};
  for (std::size_t i = 0; i < n; i += 16)
    for (int l = 0; l < 16; ++l)
      {
        const double v = z[i + l];
        rz[l] += r[i + l] * v;
        qz[l] += q[i + l] * v;
      }
  results[0] = add_up(rz);
  results[1] = add_up(qz);
}

template <typename Number>
static void
subtract_from(const std::size_t n, const Number *__restrict__ b, Number *__restrict__ r)
{
  for (std::size_t i = 0; i < n; ++i)
    r[i] = b[i] - r[i];
}
