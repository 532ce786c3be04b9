// The row kernels of LineSmoother, documented in kernels.h. Included inside a namespace
// by kernels_table.cc, after kernels_impl.h.

template <int nc, typename Number>
static void eliminate(const unsigned int n,
                      const Number *f,
                      const std::size_t s,
                      const Number *const y_before[],
                      Number *const y[],
                      Number *const r[])
{
  const Number *d = f + s * nc * nc;
  for (unsigned int i = 0; i < n; i += Vectors<Number>::n)
    {
      line<Number> v[nc];
      for (int c = 0; c < nc; ++c)
        {
          v[c] = load(r[c] + i);
          if (y_before != nullptr)
            for (int k = 0; k < nc; ++k)
              v[c] -= load(f + (c * nc + k) * s + i) * load(y_before[k] + i);
          store<Number>(y[c] + i, v[c]);
        }
      for (int c = 0; c < nc; ++c)
        {
          line<Number> result = load(d + packed<nc>(c, 0) * s + i) * v[0];
          for (int k = 1; k < nc; ++k)
            result += load(d + packed<nc>(c, k) * s + i) * v[k];
          store<Number>(r[c] + i, result);
        }
    }
}

template <int nc, typename Number>
static void substitute(const unsigned int n,
                       const Number *next_f,
                       const std::size_t s,
                       const Number *const r_next[],
                       Number *const r[],
                       const Number omega,
                       const bool add,
                       Number *const x[])
{
  for (unsigned int i = 0; i < n; i += Vectors<Number>::n)
    for (int c = 0; c < nc; ++c)
      {
        line<Number> v = load(r[c] + i);
        if (next_f != nullptr)
          {
            for (int k = 0; k < nc; ++k)
              v -= load(next_f + (k * nc + c) * s + i) * load(r_next[k] + i);
            store<Number>(r[c] + i, v);
          }
        v *= omega;
        store<Number>(x[c] + i, add ? load(x[c] + i) + v : v);
      }
}

template <int nc, typename Number>
static void solve_tile(const unsigned int n, const Number *factor, Number *tile)
{
  constexpr int nf = n_factor_entries(nc), vl = Vectors<Number>::n;
  line<Number> y[nc] = {};
  for (unsigned int i = 0; i < n; ++i)
    {
      const Number *f = factor + i * nf * vl;
      Number *t       = tile + i * nc * vl;
      line<Number> v[nc];
      for (int c = 0; c < nc; ++c)
        {
          v[c] = load(t + c * vl);
          for (int k = 0; k < nc; ++k)
            v[c] -= load(f + (c * nc + k) * vl) * y[k];
        }
      for (int c = 0; c < nc; ++c)
        {
          y[c]                = v[c];
          line<Number> result = load(f + (nc * nc + packed<nc>(c, 0)) * vl) * v[0];
          for (int k = 1; k < nc; ++k)
            result += load(f + (nc * nc + packed<nc>(c, k)) * vl) * v[k];
          store<Number>(t + c * vl, result);
        }
    }
  for (int c = 0; c < nc; ++c)
    y[c] = load(tile + ((n - 1) * nc + c) * vl);
  for (unsigned int i = n - 1; i-- > 0;)
    {
      const Number *f = factor + (i + 1) * nf * vl;
      Number *t       = tile + i * nc * vl;
      line<Number> v[nc];
      for (int c = 0; c < nc; ++c)
        {
          v[c] = load(t + c * vl);
          for (int k = 0; k < nc; ++k)
            v[c] -= load(f + (k * nc + c) * vl) * y[k];
        }
      for (int c = 0; c < nc; ++c)
        {
          y[c] = v[c];
          store<Number>(t + c * vl, v[c]);
        }
    }
}

template <typename Number>
MESOSLIP_INLINE void transpose(typename Vectors<Number>::four v[4])
{
  using four   = typename Vectors<Number>::four;
  const four a = __builtin_shufflevector(v[0], v[1], 0, 4, 1, 5),
             b = __builtin_shufflevector(v[2], v[3], 0, 4, 1, 5),
             c = __builtin_shufflevector(v[0], v[1], 2, 6, 3, 7),
             d = __builtin_shufflevector(v[2], v[3], 2, 6, 3, 7);
  v[0]         = __builtin_shufflevector(a, b, 0, 1, 4, 5);
  v[1]         = __builtin_shufflevector(a, b, 2, 3, 6, 7);
  v[2]         = __builtin_shufflevector(c, d, 0, 1, 4, 5);
  v[3]         = __builtin_shufflevector(c, d, 2, 3, 6, 7);
}

template <typename Number>
static void load_tile(const unsigned int n,
                      const unsigned int nc,
                      const Number *const rows[],
                      Number *tile)
{
  using four       = typename Vectors<Number>::four;
  constexpr int vl = Vectors<Number>::n;
  for (unsigned int i = 0; i < n; i += 4)
    for (int l = 0; l < vl; l += 4)
      {
        four v[4];
        for (int k = 0; k < 4; ++k)
          v[k] = *reinterpret_cast<const four *>(rows[l + k] + i);
        transpose<Number>(v);
        for (int k = 0; k < 4; ++k)
          *reinterpret_cast<four *>(tile + (i + k) * nc * vl + l) = v[k];
      }
}

template <typename Number>
static void add_tile(const unsigned int n,
                     const unsigned int nc,
                     const unsigned int n_lanes,
                     const Number *tile,
                     const Number omega,
                     Number *const rows[])
{
  using four       = typename Vectors<Number>::four;
  constexpr int vl = Vectors<Number>::n;
  for (unsigned int i = 0; i < n; i += 4)
    for (unsigned int l = 0; l < n_lanes; l += 4)
      {
        four v[4];
        for (int k = 0; k < 4; ++k)
          v[k] = *reinterpret_cast<const four *>(tile + (i + k) * nc * vl + l);
        transpose<Number>(v);
        for (unsigned int k = 0; k < 4 && l + k < n_lanes; ++k)
          *reinterpret_cast<four *>(rows[l + k] + i) += omega * v[k];
      }
}
