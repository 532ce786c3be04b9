// The row kernels of the multigrid. Included inside a namespace by kernels_x86_64*.cc;
// what they do is in kernels.h. Plain loops: the compiler makes vectors of them.

/** Position of entry (r, c) of the upper triangle of a symmetric block. */
template <int n>
constexpr int packed(const int r, const int c)
{
  return r <= c ? r * n - r * (r - 1) / 2 + (c - r) : packed<n>(c, r);
}

/** Sixteen floats at any address. */
typedef float vector16 __attribute__((vector_size(64), aligned(4), may_alias));
/** Four, for transposition. */
typedef float vector4 __attribute__((vector_size(16), aligned(4), may_alias));
typedef int index4 __attribute__((vector_size(16)));

static inline vector16 load16(const float *p)
{
  return *reinterpret_cast<const vector16 *>(p);
}

static inline void store16(float *p, const vector16 v)
{
  *reinterpret_cast<vector16 *>(p) = v;
}

/** sum += (block of arrays a, a + row_step...) times a neighbour's three values. */
template <int row_step, int column_step>
static inline __attribute__((always_inline)) void
add_block(const float *a, const std::size_t s, const float *const x[3], const long i, vector16 sum[3])
{
  for (int c = 0; c < 3; ++c)
    {
      const vector16 value = load16(x[c] + i);
      for (int r = 0; r < 3; ++r)
        sum[r] += load16(a + (r * row_step + c * column_step) * s) * value;
    }
}

static void stencil_residual(const unsigned int n,
                             const float *a,
                             const float *below,
                             const std::size_t s,
                             const float *const x[9],
                             const float *const b[3],
                             float *const r[3])
{
  const float *const *lower = x, *const *middle = x + 3, *const *upper = x + 6;
  for (long i = 0; i < static_cast<long>(n); i += 16)
    {
      vector16 sum[3], value[3];
      for (int c = 0; c < 3; ++c)
        value[c] = load16(middle[c] + i);
      for (int c = 0; c < 3; ++c)
        {
          sum[c] = load16(a + (centre + packed<3>(c, 0)) * s + i) * value[0];
          for (int k = 1; k < 3; ++k)
            sum[c] += load16(a + (centre + packed<3>(c, k)) * s + i) * value[k];
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
        store16(r[c] + i, load16(b[c] + i) - sum[c]);
    }
}

/** Product of the inverse pivot (upper triangle at d) and y. */
template <int nc>
static inline __attribute__((always_inline)) void
apply_pivot(const float *d, const std::size_t s, const vector16 *y, vector16 *result)
{
  for (int c = 0; c < nc; ++c)
    {
      result[c] = load16(d + packed<nc>(c, 0) * s) * y[0];
      for (int k = 1; k < nc; ++k)
        result[c] += load16(d + packed<nc>(c, k) * s) * y[k];
    }
}

template <int nc>
static void eliminate(const unsigned int n,
                      const float *f,
                      const std::size_t s,
                      const float *const y_before[],
                      float *const y[],
                      float *const r[])
{
  for (unsigned int i = 0; i < n; i += 16)
    {
      vector16 v[nc], result[nc];
      for (int c = 0; c < nc; ++c)
        {
          v[c] = load16(r[c] + i);
          if (y_before != nullptr)
            for (int k = 0; k < nc; ++k)
              v[c] -= load16(f + (c * nc + k) * s + i) * load16(y_before[k] + i);
          store16(y[c] + i, v[c]);
        }
      apply_pivot<nc>(f + nc * nc * s + i, s, v, result);
      for (int c = 0; c < nc; ++c)
        store16(r[c] + i, result[c]);
    }
}

template <int nc>
static void substitute(const unsigned int n,
                       const float *next_f,
                       const std::size_t s,
                       const float *const r_next[],
                       float *const r[],
                       const float omega,
                       const bool add,
                       float *const x[])
{
  for (unsigned int i = 0; i < n; i += 16)
    for (int c = 0; c < nc; ++c)
      {
        vector16 v = load16(r[c] + i);
        if (next_f != nullptr)
          {
            for (int k = 0; k < nc; ++k)
              v -= load16(next_f + (k * nc + c) * s + i) * load16(r_next[k] + i);
            store16(r[c] + i, v);
          }
        store16(x[c] + i, add ? load16(x[c] + i) + omega * v : omega * v);
      }
}

/** Line solver, rows: 16 lines in the lanes of a vector. */
typedef float tile_vector __attribute__((vector_size(64), may_alias));

template <int nc>
static void solve_tile(const unsigned int n, const float *factor, float *tile)
{
  constexpr int nf = n_factor_entries(nc);
  tile_vector y[nc] = {};
  for (unsigned int i = 0; i < n; ++i)
    {
      const tile_vector *f = reinterpret_cast<const tile_vector *>(factor) + i * nf;
      tile_vector *t       = reinterpret_cast<tile_vector *>(tile) + i * nc;
      tile_vector v[nc];
      for (int c = 0; c < nc; ++c)
        {
          v[c] = t[c];
          for (int k = 0; k < nc; ++k)
            v[c] -= f[c * nc + k] * y[k];
        }
      for (int c = 0; c < nc; ++c)
        {
          y[c] = v[c];
          t[c] = f[nc * nc + packed<nc>(c, 0)] * v[0];
          for (int k = 1; k < nc; ++k)
            t[c] += f[nc * nc + packed<nc>(c, k)] * v[k];
        }
    }
  for (int c = 0; c < nc; ++c)
    y[c] = reinterpret_cast<tile_vector *>(tile)[(n - 1) * nc + c];
  for (unsigned int i = n - 1; i-- > 0;)
    {
      const tile_vector *f = reinterpret_cast<const tile_vector *>(factor) + (i + 1) * nf;
      tile_vector *t       = reinterpret_cast<tile_vector *>(tile) + i * nc;
      tile_vector v[nc];
      for (int c = 0; c < nc; ++c)
        {
          v[c] = t[c];
          for (int k = 0; k < nc; ++k)
            v[c] -= f[k * nc + c] * y[k];
        }
      for (int c = 0; c < nc; ++c)
        t[c] = y[c] = v[c];
    }
}

static inline __attribute__((always_inline)) void transpose4(vector4 v[4])
{
  const vector4 a = __builtin_shuffle(v[0], v[1], index4{0, 4, 1, 5}),
                b = __builtin_shuffle(v[2], v[3], index4{0, 4, 1, 5}),
                c = __builtin_shuffle(v[0], v[1], index4{2, 6, 3, 7}),
                d = __builtin_shuffle(v[2], v[3], index4{2, 6, 3, 7});
  v[0]            = __builtin_shuffle(a, b, index4{0, 1, 4, 5});
  v[1]            = __builtin_shuffle(a, b, index4{2, 3, 6, 7});
  v[2]            = __builtin_shuffle(c, d, index4{0, 1, 4, 5});
  v[3]            = __builtin_shuffle(c, d, index4{2, 3, 6, 7});
}

static void load_tile(const unsigned int n,
                      const unsigned int nc,
                      const float *const rows[16],
                      float *tile)
{
  for (unsigned int i = 0; i < n; i += 4)
    for (int l = 0; l < 16; l += 4)
      {
        vector4 v[4];
        for (int k = 0; k < 4; ++k)
          v[k] = *reinterpret_cast<const vector4 *>(rows[l + k] + i);
        transpose4(v);
        for (int k = 0; k < 4; ++k)
          *reinterpret_cast<vector4 *>(tile + (i + k) * nc * 16 + l) = v[k];
      }
}

static void add_tile(const unsigned int n,
                     const unsigned int nc,
                     const unsigned int n_lanes,
                     const float *tile,
                     const float omega,
                     float *const rows[16])
{
  for (unsigned int i = 0; i < n; i += 4)
    for (unsigned int l = 0; l < n_lanes; l += 4)
      {
        vector4 v[4];
        for (int k = 0; k < 4; ++k)
          v[k] = *reinterpret_cast<const vector4 *>(tile + (i + k) * nc * 16 + l);
        transpose4(v);
        for (unsigned int k = 0; k < 4 && l + k < n_lanes; ++k)
          {
            vector4 *x = reinterpret_cast<vector4 *>(rows[l + k] + i);
            *x += omega * v[k];
          }
      }
}

static void split(const unsigned int n,
                  const float *__restrict__ row,
                  float *__restrict__ even,
                  float *__restrict__ odd)
{
  for (unsigned int i = 0; i < n; ++i)
    {
      even[i] = row[2 * i];
      odd[i]  = row[2 * i + 1];
    }
}

static void merge(const unsigned int n,
                  const float *__restrict__ even,
                  const float *__restrict__ odd,
                  float *__restrict__ row)
{
  for (unsigned int i = 0; i < n; ++i)
    {
      row[2 * i] += even[i];
      row[2 * i + 1] += odd[i];
    }
}

template <int nc>
static void restrict_row(const unsigned int n,
                         const TransferRow &row,
                         const float *const even[],
                         const float *const odd[],
                         float *const coarse[3])
{
  const float *__restrict__ w = row.even, *__restrict__ p = row.odd_left,
                           *__restrict__ q = row.odd_right;
  const int m = static_cast<int>(n);
  for (int c = 0; c < nc; ++c)
    {
      const float *__restrict__ e = even[c], *__restrict__ o = odd[c];
      float *__restrict__ r = coarse[c];
      for (int i = 0; i < m; ++i)
        r[i] += w[i] * e[i] + p[i] * o[i] + q[i - 1] * o[i - 1];
    }
  const float *__restrict__ ax = row.to_left, *__restrict__ bx = row.to_right;
  const float *__restrict__ eu = even[0], *__restrict__ ou = odd[0],
                           *__restrict__ ov = odd[1];
  float *__restrict__ r        = coarse[2];
  const float dy               = row.dy;
  for (int i = 0; i < m; ++i)
    r[i] += p[i] * (ax[i] * ov[i] - dy * ou[i]) -
            q[i - 1] * (bx[i - 1] * ov[i - 1] + dy * ou[i - 1]) - dy * w[i] * eu[i];
}

template <int nc>
static void prolongate_row(const unsigned int n,
                           const TransferRow &row,
                           const bool add,
                           const float *const coarse[3],
                           float *const even[],
                           float *const odd[])
{
  const float keep = add ? 1.F : 0.F;
  for (unsigned int i = 0; i < n; i += 16)
    {
      const vector16 w = load16(row.even + i), p = load16(row.odd_left + i),
                     q = load16(row.odd_right + i);
      const vector16 t = load16(coarse[2] + i), t1 = load16(coarse[2] + i + 1);
      const vector16 u = load16(coarse[0] + i) - row.dy * t,
                     u1 = load16(coarse[0] + i + 1) - row.dy * t1;
      const vector16 v = load16(coarse[1] + i), v1 = load16(coarse[1] + i + 1);
      const auto put = [=](float *to, const vector16 value) {
        store16(to + i, keep * load16(to + i) + value);
      };
      put(even[0], w * u);
      put(odd[0], p * u + q * u1);
      put(even[1], w * v);
      put(odd[1], p * (v + load16(row.to_left + i) * t) +
                    q * (v1 - load16(row.to_right + i) * t1));
      if constexpr (nc == 3)
        {
          put(even[2], w * t);
          put(odd[2], p * t + q * t1);
        }
    }
}

static void dense(const unsigned int n,
                  const float *__restrict__ matrix,
                  const std::size_t stride,
                  const float *__restrict__ x,
                  float *__restrict__ y)
{
  const unsigned int whole = (n + 15) / 16 * 16;
  for (unsigned int i = 0; i < whole; ++i)
    y[i] = 0.F;
  for (unsigned int j = 0; j < n; ++j)
    {
      const float factor               = x[j];
      const float *__restrict__ column = matrix + j * stride;
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

static void direction(const std::size_t n,
                      const double scale,
                      const double beta,
                      const float *__restrict__ z,
                      double *__restrict__ p)
{
  for (std::size_t i = 0; i < n; ++i)
    p[i] = scale * static_cast<double>(z[i]) + beta * p[i];
}

static void narrow(const std::size_t n,
                   const double scale,
                   const double *__restrict__ x,
                   float *__restrict__ y)
{
  for (std::size_t i = 0; i < n; ++i)
    y[i] = static_cast<float>(scale * x[i]);
}

static void two_dots(const std::size_t n,
                     const double *__restrict__ r,
                     const double *__restrict__ q,
                     const float *__restrict__ z,
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

static void
subtract_from(const std::size_t n, const float *__restrict__ b, float *__restrict__ r)
{
  for (std::size_t i = 0; i < n; ++i)
    r[i] = b[i] - r[i];
}
