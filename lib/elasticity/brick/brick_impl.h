// Stiffness of a brick, one vector of neighbouring cells at a time. Included inside a
// namespace by the kernels of steps and of statics, after simd.h.
//
// In the basis of products of nodal sums and differences u_S = sum over the nodes of
// chi_S(n) u(n), chi_S(n) = product over the axes d in S of (2 n_d - 1), S being a set of
// axes (bit 0: x, 1: y, 2: z), the displacement is 1/8 sum of u_S xi^S with xi from -1 to
// 1. The gradient is a polynomial of few terms: constants, coefficients of one xi, and of
// two. Integrals of products of different terms vanish; equal terms have the weights 1,
// 1/3 and 1/9. Differences along x and z are multiplied by r = h_y / h_x and h_y / h_z.
// This leaves 2 / h_y in front of every gradient and 1 / r^2 for every further xi.

/** Loads a vector from an unaligned address. */
template <typename Number>
MESOSLIP_INLINE typename Simd<Number>::Vector load_any(const Number *p)
{
  typedef Number vector __attribute__((vector_size(MESOSLIP_VECTOR_BYTES),
                                       aligned(sizeof(Number)), may_alias));
  return (typename Simd<Number>::Vector) * reinterpret_cast<const vector *>(p);
}

/** Voigt index of component (c, d). */
constexpr int voigt(const int c, const int d)
{
  return c == d ? c : 6 - c - d;
}

/** Index of entry (i, j) in the upper triangle of a symmetric 6x6 matrix. */
constexpr int triangle(const int i, const int j)
{
  return i <= j ? i * 6 - i * (i - 1) / 2 + j - i : triangle(j, i);
}

/** Stiffness coefficients of neighbouring cells of a row, and stresses from strains. */
template <typename Number, unsigned int n_coefficients>
struct Stiffness;

template <typename Number>
struct Stiffness<Number, n_isotropic>
{
  using Vector = typename Simd<Number>::Vector;
  Vector lambda, mu;

  template <typename Load>
  MESOSLIP_INLINE Stiffness of(const Load &load_one)
  {
    return {load_one(0), load_one(1)};
  }

  /** Voigt stress of a Voigt strain. */
  inline __attribute__((always_inline)) void stress(const Vector e[6], Vector s[6]) const
  {
    const Vector trace = lambda * (e[0] + e[1] + e[2]), twice = mu + mu;
    for (int i = 0; i < 3; ++i)
      {
        s[i]     = trace + twice * e[i];
        s[i + 3] = mu * e[i + 3];
      }
  }

  /**
   * Stress of a strain whose component (axis, axis) is zero, without that stress
   * component.
   */
  template <int axis>
  inline __attribute__((always_inline)) void plane_stress(const Vector e[6],
                                                          Vector s[6]) const
  {
    constexpr int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const Vector trace = lambda * (e[a] + e[b]), twice = mu + mu;
    s[a] = trace + twice * e[a];
    s[b] = trace + twice * e[b];
    for (int i = 3; i < 6; ++i)
      s[i] = mu * e[i];
  }

  /** sigma n of the strain u n, n along the axis. */
  template <int axis>
  inline __attribute__((always_inline)) void line_stress(const Vector u[3],
                                                         Vector t[3]) const
  {
    for (int i = 0; i < 3; ++i)
      t[i] = (i == axis ? lambda + mu + mu : mu) * u[i];
  }
};

/** Isotropic cubes, see coefficients.h. */
template <typename Number>
struct Stiffness<Number, n_cubes>
{
  using Vector = typename Simd<Number>::Vector;
  Vector lambda, mu, third_of_lambda, of_products;

  template <typename Load>
  MESOSLIP_INLINE Stiffness of(const Load &load_one)
  {
    return {load_one(0), load_one(1), load_one(2), load_one(3)};
  }

  /** Voigt stress of a Voigt strain. */
  inline __attribute__((always_inline)) void stress(const Vector e[6], Vector s[6]) const
  {
    const Vector trace = lambda * (e[0] + e[1] + e[2]), twice = mu + mu;
    for (int i = 0; i < 3; ++i)
      {
        s[i]     = trace + twice * e[i];
        s[i + 3] = mu * e[i + 3];
      }
  }
};

/** Orthotropic bricks along their material axes. */
template <typename Number>
struct Stiffness<Number, n_orthotropic>
{
  using Vector = typename Simd<Number>::Vector;
  Vector c[n_orthotropic];

  template <typename Load>
  MESOSLIP_INLINE Stiffness of(const Load &load_one)
  {
    Stiffness result;
    for (unsigned int m = 0; m < n_orthotropic; ++m)
      result.c[m] = load_one(m);
    return result;
  }

  /** Index of the coefficient of normal components i and j. */
  static constexpr int normal(const int i, const int j)
  {
    return i <= j ? i * 3 - i * (i + 1) / 2 + j : normal(j, i);
  }

  inline __attribute__((always_inline)) void stress(const Vector e[6], Vector s[6]) const
  {
    for (int i = 0; i < 3; ++i)
      {
        s[i] = c[normal(i, 0)] * e[0];
        s[i] += c[normal(i, 1)] * e[1];
        s[i] += c[normal(i, 2)] * e[2];
        s[i + 3] = c[i + 6] * e[i + 3];
      }
  }

  template <int axis>
  inline __attribute__((always_inline)) void plane_stress(const Vector e[6],
                                                          Vector s[6]) const
  {
    constexpr int a = (axis + 1) % 3, b = (axis + 2) % 3;
    s[a] = c[normal(a, a)] * e[a] + c[normal(a, b)] * e[b];
    s[b] = c[normal(a, b)] * e[a] + c[normal(b, b)] * e[b];
    for (int i = 3; i < 6; ++i)
      s[i] = c[i + 3] * e[i];
  }

  template <int axis>
  inline __attribute__((always_inline)) void line_stress(const Vector u[3],
                                                         Vector t[3]) const
  {
    for (int i = 0; i < 3; ++i)
      t[i] = (i == axis ? c[normal(i, i)] : c[voigt(i, axis) + 3]) * u[i];
  }
};

template <typename Number>
struct Stiffness<Number, n_general>
{
  using Vector = typename Simd<Number>::Vector;
  Vector c[n_general];

  template <typename Load>
  MESOSLIP_INLINE Stiffness of(const Load &load_one)
  {
    Stiffness result;
    for (unsigned int m = 0; m < n_general; ++m)
      result.c[m] = load_one(m);
    return result;
  }

  inline __attribute__((always_inline)) void stress(const Vector e[6], Vector s[6]) const
  {
    for (int i = 0; i < 6; ++i)
      {
        s[i] = c[triangle(i, 0)] * e[0];
        for (int j = 1; j < 6; ++j)
          s[i] += c[triangle(i, j)] * e[j];
      }
  }

  template <int axis>
  inline __attribute__((always_inline)) void plane_stress(const Vector e[6],
                                                          Vector s[6]) const
  {
    for (int i = 0; i < 6; ++i)
      if (i != axis)
        {
          s[i] = c[triangle(i, 3)] * e[3];
          for (int j = 0; j < 6; ++j)
            if (j != axis && j != 3)
              s[i] += c[triangle(i, j)] * e[j];
        }
  }

  template <int axis>
  inline __attribute__((always_inline)) void line_stress(const Vector u[3],
                                                         Vector t[3]) const
  {
    for (int i = 0; i < 3; ++i)
      {
        t[i] = c[triangle(voigt(i, axis), voigt(0, axis))] * u[0];
        for (int j = 1; j < 3; ++j)
          t[i] += c[triangle(voigt(i, axis), voigt(j, axis))] * u[j];
      }
  }
};

/**
 * Adds to the forces @p g the contribution of the terms linear in xi of the axis, from
 * the modes @p u.
 */
template <int axis, typename Vector, typename Material, typename Number>
MESOSLIP_INLINE void add_linear_terms(const Material &material,
                                      const Vector u[3][8],
                                      const Number weight,
                                      Vector g[3][8])
{
  constexpr int a = (axis + 1) % 3, b = (axis + 2) % 3;
  constexpr int A = 1 << a | 1 << axis, B = 1 << b | 1 << axis;
  Vector e[6], s[6];
  e[axis]           = Vector{};
  e[a]              = u[a][A];
  e[b]              = u[b][B];
  e[voigt(a, b)]    = u[a][B] + u[b][A];
  e[voigt(axis, a)] = u[axis][A];
  e[voigt(axis, b)] = u[axis][B];
  material.template plane_stress<axis>(e, s);
  g[a][A] += weight * s[a];
  g[b][B] += weight * s[b];
  g[a][B] += weight * s[voigt(a, b)];
  g[b][A] += weight * s[voigt(a, b)];
  g[axis][A] += weight * s[voigt(axis, a)];
  g[axis][B] += weight * s[voigt(axis, b)];
}

/** Adds the contribution of the term with the xi of both other axes. */
template <int axis, typename Vector, typename Material, typename Number>
MESOSLIP_INLINE void add_product_term(const Material &material,
                                      const Vector u[3][8],
                                      const Number weight,
                                      Vector g[3][8])
{
  const Vector v[3] = {u[0][7], u[1][7], u[2][7]};
  Vector t[3];
  material.template line_stress<axis>(v, t);
  for (int c = 0; c < 3; ++c)
    g[c][7] += weight * t[c];
}

/** Voigt strain of the constant gradient. */
template <typename Vector>
MESOSLIP_INLINE void mean_strain(const Vector u[3][8], Vector e[6])
{
  for (int c = 0; c < 3; ++c)
    e[c] = u[c][1 << c];
  e[3] = u[1][4] + u[2][2];
  e[4] = u[0][4] + u[2][1];
  e[5] = u[0][2] + u[1][1];
}

/**
 * Forces @p g on the modes from the stresses @p s of the constant gradient and the modes
 * @p u.
 */
template <typename Vector, typename Material, typename Number>
MESOSLIP_INLINE void mode_forces(const Material &material,
                                 const Vector u[3][8],
                                 const Vector s[6],
                                 const Number weight[3],
                                 Vector g[3][8])
{
  for (int c = 0; c < 3; ++c)
    {
      for (int d = 0; d < 3; ++d)
        g[c][1 << d] = s[voigt(c, d)];
      g[c][3] = g[c][5] = g[c][6] = g[c][7] = Vector{};
    }
  add_linear_terms<0>(material, u, weight[0], g);
  add_linear_terms<1>(material, u, weight[1], g);
  add_linear_terms<2>(material, u, weight[2], g);
  add_product_term<0>(material, u, weight[1] * weight[2], g);
  add_product_term<1>(material, u, weight[2] * weight[0], g);
  add_product_term<2>(material, u, weight[0] * weight[1], g);
}

/**
 * mode_forces() of isotropic cubes: all weights are 1/3, equal terms of the three axes
 * are combined.
 */
template <typename Vector, typename Number>
MESOSLIP_INLINE void mode_forces(const Stiffness<Number, n_cubes> &material,
                                 const Vector u[3][8],
                                 const Vector s[6],
                                 const Number weight[3],
                                 Vector g[3][8])
{
  const Vector third_of_mu = weight[1] * material.mu;
  Vector shear[3];
  for (int q = 0; q < 3; ++q)
    {
      const int p = (q + 1) % 3, r = (q + 2) % 3, pq = 1 << p | 1 << q,
                rq       = 1 << r | 1 << q;
      const Vector trace = material.third_of_lambda * (u[p][pq] + u[r][rq]);
      g[p][pq]           = material.mu * u[p][pq] + trace;
      g[r][rq]           = material.mu * u[r][rq] + trace;
      shear[q]           = third_of_mu * (u[p][rq] + u[r][pq]);
      for (int d = 0; d < 3; ++d)
        g[q][1 << d] = s[voigt(q, d)];
      g[q][7] = material.of_products * u[q][7];
    }
  g[0][6] = shear[1] + shear[2];
  g[1][5] = shear[0] + shear[2];
  g[2][3] = shear[0] + shear[1];
}
