// Galerkin products of 8 coarse cells at once. Included inside a namespace by
// kernels_table.cc, after kernels_impl.h.
//
// Rigid motions (u, v, r) of all nodes first refer to a common point, the lower left
// corner of the coarse cell: then interpolation multiplies all three by the same weights.
// Unknown 3 J + c is component c of corner J.

using vector8 = line<double>;

/** Position of entry (r, c) in the packed matrix of a cell. */
static constexpr int entry(const int r, const int c)
{
  return packed<12>(r, c);
}

/**
 * K <- T^T K T with T the change of the reference point of the rotation of corner J by
 * (dx, dy): column r becomes r + dy u - dx v.
 */
static inline void
shift_reference(vector8 *k, const int J, const vector8 dx, const vector8 dy)
{
  const int u = 3 * J, v = u + 1, r = u + 2;
  k[entry(r, r)] += 2. * (dy * k[entry(u, r)] - dx * k[entry(v, r)]) +
                    dy * dy * k[entry(u, u)] - 2. * dx * dy * k[entry(u, v)] +
                    dx * dx * k[entry(v, v)];
  for (int a = 0; a < 12; ++a)
    if (a != r)
      k[entry(a, r)] += dy * k[entry(a, u)] - dx * k[entry(a, v)];
}

/** Moves the reference point from the common point to the corners of the coarse cell. */
static void to_corners(vector8 *k, const Patch<double> &patch)
{
  const vector8 width = load(patch.width), zero = {};
  const vector8 height = zero + patch.height;
  shift_reference(k, 1, width, zero);
  shift_reference(k, 2, zero, height);
  shift_reference(k, 3, width, height);
}

static void store_matrix(const vector8 *k, double *out, const std::size_t stride)
{
  for (unsigned int e = 0; e < n_cell_entries; ++e)
    store(out + e * stride, k[e]);
}

/** result += W^T K W for one fine cell with nodes 0 to 3; w[node][corner]. */
static void add_cell(const vector8 *k, const vector8 w[4][4], vector8 *result)
{
#pragma GCC unroll 4
  for (int I = 0; I < 4; ++I)
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c)
      {
        // Column (I, c) of K W.
        vector8 column[12];
#pragma GCC unroll 12
        for (int a = 0; a < 12; ++a)
          {
            column[a] = k[entry(a, c)] * w[0][I];
            for (int f = 1; f < 4; ++f)
              column[a] += k[entry(a, 3 * f + c)] * w[f][I];
          }
#pragma GCC unroll 12
        for (int r = 0; r <= 3 * I + c; ++r)
          {
            const int J = r / 3, d = r % 3;
            vector8 sum = w[0][J] * column[d];
            for (int f = 1; f < 4; ++f)
              sum += w[f][J] * column[3 * f + d];
            result[entry(r, 3 * I + c)] += sum;
          }
      }
}

static void
galerkin_coarse(const CoarsePatch &patch, double *out, const std::size_t stride)
{
  vector8 result[n_cell_entries] = {};
  for (unsigned int b = 0; b < patch.n_rows; ++b)
    for (unsigned int a = 0; a < 2; ++a)
      {
        vector8 k[n_cell_entries], w[4][4];
        for (unsigned int e = 0; e < n_cell_entries; ++e)
          k[e] = load(patch.matrix[b][a][e]);
        for (int f = 0; f < 4; ++f)
          {
            const unsigned int i = a + f % 2, j = b + f / 2;
            for (int c = 0; c < 4; ++c)
              w[f][c] = load(patch.weight[j][i][c]);
            shift_reference(k, f, -load(patch.x[i]), vector8{} - patch.y[j]);
          }
        add_cell(k, w, result);
      }
  to_corners(result, patch);
  store_matrix(result, out, stride);
}

// Linear functionals of the 12 coarse unknowns: three strains and two hourglass modes of
// a fine cell are vector8 [5][12].

/** Adds the functionals c_u u + c_v v of a fine node to @p f. */
static inline void add_node(const vector8 *wu,
                            const vector8 *wv,
                            const vector8 x,
                            const double y,
                            const double c_u,
                            const double c_v,
                            vector8 f[12])
{
  for (int u = 0, v = 1, r = 2, J = 0; J < 4; ++J, u += 3, v += 3, r += 3)
    {
      if (c_u != 0.)
        {
          f[u] += c_u * wu[J];
          f[r] -= (c_u * y) * wu[J];
        }
      if (c_v != 0.)
        {
          f[v] += c_v * wv[J];
          f[r] += c_v * (wv[J] * x);
        }
    }
}

/** result += f g^T + ..., upper triangle; g holds conjugate stresses of f. */
static void add_products(const vector8 f[5][12], const vector8 g[5][12], vector8 *result)
{
#pragma GCC unroll 12
  for (int c = 0; c < 12; ++c)
#pragma GCC unroll 12
    for (int r = 0; r <= c; ++r)
      {
        vector8 sum = f[0][r] * g[0][c];
        for (int k = 1; k < 5; ++k)
          sum += f[k][r] * g[k][c];
        result[entry(r, c)] += sum;
      }
}

/** g = D f: strains to stresses, hourglass modes to their forces. */
static void conjugate(const FinestPatch &patch,
                      const unsigned int b,
                      const unsigned int a,
                      const vector8 f[5][12],
                      vector8 g[5][12])
{
  vector8 d[n_finest_coefficients];
  for (unsigned int k = 0; k < n_finest_coefficients; ++k)
    d[k] = load(patch.coefficient[b][a][k]);
  for (int i = 0; i < 12; ++i)
    {
      const vector8 xx = f[0][i], yy = f[1][i], xy = f[2][i], hu = f[3][i], hv = f[4][i];
      g[0][i] = d[d11] * xx + d[d12] * yy + d[d13] * xy;
      g[1][i] = d[d12] * xx + d[d22] * yy + d[d23] * xy;
      g[2][i] = d[d13] * xx + d[d23] * yy + d[d33] * xy;
      g[3][i] = d[h11] * hu + d[h12] * hv;
      g[4][i] = d[h12] * hu + d[h22] * hv;
    }
}

/**
 * Ties the rotations of the corners softly to the rotation of the coarse cell: with
 * bilinear weights they would have no effect.
 */
static void add_rotation_stiffness(const FinestPatch &patch, vector8 *k)
{
  vector8 m[12];
  const vector8 stiffness = load(patch.rotation_stiffness);
  const vector8 inverse_w = 0.25 / load(patch.width);
  for (std::size_t J = 0; J < 4; ++J)
    {
      m[3 * J]     = vector8{} + (J < 2 ? -0.25 : 0.25) / patch.height;
      m[3 * J + 1] = J % 2 == 0 ? inverse_w : -inverse_w;
      m[3 * J + 2] = vector8{} + 0.25;
    }
  for (int r = 0; r < 12; ++r)
    for (int c = r; c < 12; ++c)
      k[entry(r, c)] += stiffness * m[r] * m[c];
}

static void
galerkin_finest(const FinestPatch &patch, double *out, const std::size_t stride)
{
  vector8 result[n_cell_entries] = {};
  for (unsigned int b = 0; b < patch.n_rows; ++b)
    for (unsigned int a = 0; a < 2; ++a)
      {
        vector8 f[5][12] = {}, g[5][12];
        for (unsigned int n = 0; n < 4; ++n)
          {
            const unsigned int i = a + n % 2, j = b + n / 2;
            const double dx = n % 2 == 0 ? -0.5 : 0.5;
            const double dy = (n / 2 == 0 ? -0.5 : 0.5) / patch.cell_height;
            const double h  = n == 0 || n == 3 ? 1. : -1.;
            const vector8 x = load(patch.x[i]);
            vector8 wu[4], wv[4];
            for (int J = 0; J < 4; ++J)
              {
                const vector8 w = load(patch.weight[j][i][J]);
                wu[J]           = w * load(patch.free_x[j][i]);
                wv[J]           = w * load(patch.free_y[j][i]);
              }
            add_node(wu, wv, x, patch.y[j], dx, 0., f[0]);
            add_node(wu, wv, x, patch.y[j], 0., dy, f[1]);
            add_node(wu, wv, x, patch.y[j], dy, dx, f[2]);
            add_node(wu, wv, x, patch.y[j], h, 0., f[3]);
            add_node(wu, wv, x, patch.y[j], 0., h, f[4]);
          }
        conjugate(patch, b, a, f, g);
        add_products(f, g, result);
      }
  to_corners(result, patch);
  add_rotation_stiffness(patch, result);
  store_matrix(result, out, stride);
}
