// Galerkin products, 16 coarse cells at once. Included inside a namespace by
// kernels_x86_64*.cc, after kernels_impl.h.
//
// Rigid motions (u, v, r) of nodes are first taken about one common point, the lower
// left corner of the coarse cell: then interpolation multiplies all three by the same
// weights. Unknown 3 J + c is component c of corner J.

/** Position of entry (r, c) in the packed matrix of a cell. */
static constexpr int entry(const int r, const int c)
{
  return packed<12>(r, c);
}

/**
 * K <- T^T K T with T the change of the reference point of the rotation of corner J by
 * (dx, dy): column r becomes r + dy u - dx v.
 */
static inline void shift_reference(tile_vector *k,
                                   const int J,
                                   const tile_vector dx,
                                   const tile_vector dy)
{
  const int u = 3 * J, v = u + 1, r = u + 2;
  k[entry(r, r)] += 2.F * (dy * k[entry(u, r)] - dx * k[entry(v, r)]) +
                    dy * dy * k[entry(u, u)] - 2.F * dx * dy * k[entry(u, v)] +
                    dx * dx * k[entry(v, v)];
  for (int a = 0; a < 12; ++a)
    if (a != r)
      k[entry(a, r)] += dy * k[entry(a, u)] - dx * k[entry(a, v)];
}

static inline tile_vector load_lanes(const float *p)
{
  return *reinterpret_cast<const tile_vector *>(p);
}

/** Corners of the coarse cell: from the common point to the corners themselves. */
static void to_corners(tile_vector *k, const Patch &patch)
{
  const tile_vector width = load_lanes(patch.width), zero = {};
  const tile_vector height = zero + patch.height;
  shift_reference(k, 1, width, zero);
  shift_reference(k, 2, zero, height);
  shift_reference(k, 3, width, height);
}

static void store_matrix(const tile_vector *k, float *out, const std::size_t stride)
{
  for (unsigned int e = 0; e < n_cell_entries; ++e)
    *reinterpret_cast<tile_vector *>(out + e * stride) = k[e];
}

/** result += W^T K W for one fine cell with nodes 0 to 3; w[node][corner]. */
static void add_cell(const tile_vector *k, const tile_vector w[4][4], tile_vector *result)
{
  for (int I = 0; I < 4; ++I)
    for (int c = 0; c < 3; ++c)
      {
        // Column (I, c) of K W.
        tile_vector column[12];
        for (int a = 0; a < 12; ++a)
          {
            column[a] = k[entry(a, c)] * w[0][I];
            for (int f = 1; f < 4; ++f)
              column[a] += k[entry(a, 3 * f + c)] * w[f][I];
          }
        for (int J = 0; J <= I; ++J)
          for (int d = 0; d < 3; ++d)
            if (J < I || d <= c)
              {
                tile_vector sum = w[0][J] * column[d];
                for (int f = 1; f < 4; ++f)
                  sum += w[f][J] * column[3 * f + d];
                result[entry(3 * J + d, 3 * I + c)] += sum;
              }
      }
}

static void galerkin_coarse(const CoarsePatch &patch, float *out, const std::size_t stride)
{
  tile_vector result[n_cell_entries] = {};
  for (unsigned int b = 0; b < patch.n_rows; ++b)
    for (unsigned int a = 0; a < 2; ++a)
      {
        tile_vector k[n_cell_entries], w[4][4];
        for (unsigned int e = 0; e < n_cell_entries; ++e)
          k[e] = load_lanes(patch.matrix[b][a][e]);
        for (int f = 0; f < 4; ++f)
          {
            const unsigned int i = a + f % 2, j = b + f / 2;
            for (int c = 0; c < 4; ++c)
              w[f][c] = load_lanes(patch.weight[j][i][c]);
            shift_reference(k, f, -load_lanes(patch.x[i]), tile_vector{} - patch.y[j]);
          }
        add_cell(k, w, result);
      }
  to_corners(result, patch);
  store_matrix(result, out, stride);
}

/** A linear functional of the coarse unknowns: strain or hourglass mode of a fine cell. */
struct Functional
{
  tile_vector u[4], v[4], r[4];
};

/** Adds the functionals c_u u + c_v v of a fine node to @p f. */
static inline void add_node(const tile_vector *wu,
                            const tile_vector *wv,
                            const tile_vector x,
                            const float y,
                            const float c_u,
                            const float c_v,
                            Functional &f)
{
  for (int J = 0; J < 4; ++J)
    {
      if (c_u != 0.F)
        {
          f.u[J] += c_u * wu[J];
          f.r[J] -= (c_u * y) * wu[J];
        }
      if (c_v != 0.F)
        {
          f.v[J] += c_v * wv[J];
          f.r[J] += c_v * (wv[J] * x);
        }
    }
}

static inline const tile_vector &component(const Functional &f, const int J, const int c)
{
  return c == 0 ? f.u[J] : c == 1 ? f.v[J] : f.r[J];
}

/** result += f g^T + ..., upper triangle; g holds conjugate stresses of f. */
static void add_products(const Functional f[5], const Functional g[5], tile_vector *result)
{
  for (int I = 0; I < 4; ++I)
    for (int c = 0; c < 3; ++c)
      for (int J = 0; J <= I; ++J)
        for (int d = 0; d < 3; ++d)
          if (J < I || d <= c)
            {
              tile_vector sum = component(f[0], J, d) * component(g[0], I, c);
              for (int k = 1; k < 5; ++k)
                sum += component(f[k], J, d) * component(g[k], I, c);
              result[entry(3 * J + d, 3 * I + c)] += sum;
            }
}

/** g = D f: strains to stresses, hourglass modes to their forces. */
static void conjugate(const FinestPatch &patch,
                      const unsigned int b,
                      const unsigned int a,
                      const Functional f[5],
                      Functional g[5])
{
  tile_vector d[n_finest_coefficients];
  for (unsigned int k = 0; k < n_finest_coefficients; ++k)
    d[k] = load_lanes(patch.coefficient[b][a][k]);
  for (int J = 0; J < 4; ++J)
    for (int c = 0; c < 3; ++c)
      {
        const tile_vector xx = component(f[0], J, c), yy = component(f[1], J, c),
                          xy = component(f[2], J, c), hu = component(f[3], J, c),
                          hv    = component(f[4], J, c);
        const tile_vector s[5] = {d[d11] * xx + d[d12] * yy + d[d13] * xy,
                                  d[d12] * xx + d[d22] * yy + d[d23] * xy,
                                  d[d13] * xx + d[d23] * yy + d[d33] * xy,
                                  d[h11] * hu + d[h12] * hv,
                                  d[h12] * hu + d[h22] * hv};
        for (int k = 0; k < 5; ++k)
          (c == 0 ? g[k].u[J] : c == 1 ? g[k].v[J] : g[k].r[J]) = s[k];
      }
}

/**
 * The rotations of the corners mean nothing where the weights are those of bilinear
 * interpolation: they are tied, softly, to the rotation of the coarse cell.
 */
static void add_rotation_stiffness(const FinestPatch &patch, tile_vector *k)
{
  tile_vector m[12];
  const tile_vector stiffness = load_lanes(patch.rotation_stiffness);
  const tile_vector inverse_w = 0.25F / load_lanes(patch.width);
  for (int J = 0; J < 4; ++J)
    {
      m[3 * J]     = tile_vector{} + (J < 2 ? -0.25F : 0.25F) / patch.height;
      m[3 * J + 1] = J % 2 == 0 ? inverse_w : -inverse_w;
      m[3 * J + 2] = tile_vector{} + 0.25F;
    }
  for (int r = 0; r < 12; ++r)
    for (int c = r; c < 12; ++c)
      k[entry(r, c)] += stiffness * m[r] * m[c];
}

static void galerkin_finest(const FinestPatch &patch, float *out, const std::size_t stride)
{
  tile_vector result[n_cell_entries] = {};
  for (unsigned int b = 0; b < patch.n_rows; ++b)
    for (unsigned int a = 0; a < 2; ++a)
      {
        Functional f[5] = {}, g[5];
        for (unsigned int n = 0; n < 4; ++n)
          {
            const unsigned int i = a + n % 2, j = b + n / 2;
            const float dx = n % 2 == 0 ? -0.5F : 0.5F;
            const float dy = (n / 2 == 0 ? -0.5F : 0.5F) / patch.cell_height;
            const float h  = n == 0 || n == 3 ? 1.F : -1.F;
            const tile_vector x = load_lanes(patch.x[i]);
            tile_vector wu[4], wv[4];
            for (int J = 0; J < 4; ++J)
              {
                const tile_vector w = load_lanes(patch.weight[j][i][J]);
                wu[J]               = w * load_lanes(patch.free_x[j][i]);
                wv[J]               = w * load_lanes(patch.free_y[j][i]);
              }
            add_node(wu, wv, x, patch.y[j], dx, 0.F, f[0]);
            add_node(wu, wv, x, patch.y[j], 0.F, dy, f[1]);
            add_node(wu, wv, x, patch.y[j], dy, dx, f[2]);
            add_node(wu, wv, x, patch.y[j], h, 0.F, f[3]);
            add_node(wu, wv, x, patch.y[j], 0.F, h, f[4]);
          }
        conjugate(patch, b, a, f, g);
        add_products(f, g, result);
      }
  to_corners(result, patch);
  add_rotation_stiffness(patch, result);
  store_matrix(result, out, stride);
}
