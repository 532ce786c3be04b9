// The row kernel. Included inside a namespace by row_kernel.cc, after simd.h; the
// mathematics is in row_kernel.h.

/** Coefficients of one vector of cells. */
template <typename Number, MaterialVariant variant>
struct MaterialAccess
{
  using Vector = typename Simd<Number>::Vector;
  using Index  = typename Simd<Number>::Index;

  const Constants<Number> &constants;
  Index index;

  __attribute__((always_inline))
  MaterialAccess(const Constants<Number> &c, const std::uint8_t *phases)
    : constants(c)
    , index(variant == MaterialVariant::homogeneous ? Index{}
                                                    : load_bytes(phases, Index{}))
  {
  }

  template <int k>
  __attribute__((always_inline)) Vector get() const
  {
    constexpr unsigned int n = Simd<Number>::length;
    const Number *table      = constants.coefficient[k];
    if constexpr (variant == MaterialVariant::homogeneous)
      return splat(table[0]);
    else if constexpr (variant == MaterialVariant::two)
      return index != 0 ? splat(table[1]) : splat(table[0]);
    else if constexpr (variant == MaterialVariant::one_register)
      return lookup(load(table), index);
    else if constexpr (variant == MaterialVariant::two_registers)
      return lookup(load(table), load(table + n), index);
    else
      return gather(table, index);
  }
};

template <typename Number,
          MaterialVariant variant,
          bool anisotropic,
          bool damping,
          bool gravity,
          bool step,
          int n_rows>
struct Kernel
{
  using Vector            = typename Simd<Number>::Vector;
  using Index             = typename Simd<Number>::Index;
  static constexpr int vl = Simd<Number>::length;

  /** Differences and sums of neighbours in a node row, for the x and y component. */
  struct RowStrain
  {
    Vector dx, sx, dy, sy;
  };

  /**
   * Data carried along the row: nodal values of the current column of vectors, and P + Q
   * + B' of the previous column.
   */
  struct Carry
  {
    Vector zx[n_rows + 1], zy[n_rows + 1];
    Vector left_x[n_rows], left_y[n_rows];
  };

  static __attribute__((always_inline)) Vector
  nodal(const Constants<Number> &c, const Number *u, const Number *w)
  {
    if constexpr (damping)
      return fma(splat(c.beta), load(w), load(u));
    else
      return load(u);
  }

  static __attribute__((always_inline)) void start(const Constants<Number> &c,
                                                   const Rows<Number> &r,
                                                   const unsigned int i,
                                                   Carry &carry)
  {
#pragma GCC unroll 8
    for (int k = 0; k <= n_rows; ++k)
      {
        const std::size_t at = k * r.stride + i;
        carry.zx[k]          = nodal(c, r.ux + at, r.wx + at);
        carry.zy[k]          = nodal(c, r.uy + at, r.wy + at);
      }
  }

  /** Differences and sums of node row k; loads the next column of vectors. */
  static __attribute__((always_inline)) RowStrain strain(const Constants<Number> &c,
                                                         const Rows<Number> &r,
                                                         const unsigned int i,
                                                         const int k,
                                                         Carry &carry)
  {
    const std::size_t at = k * r.stride + i + vl;
    const Vector next_x  = nodal(c, r.ux + at, r.wx + at);
    const Vector next_y  = nodal(c, r.uy + at, r.wy + at);
    const Vector right_x = right_neighbours(carry.zx[k], next_x);
    const Vector right_y = right_neighbours(carry.zy[k], next_y);

    const RowStrain result = {right_x - carry.zx[k], right_x + carry.zx[k],
                              right_y - carry.zy[k], right_y + carry.zy[k]};
    carry.zx[k]            = next_x;
    carry.zy[k]            = next_y;
    return result;
  }

  /**
   * One vector of columns, all cell rows; cells that are not @p valid contribute nothing.
   */
  template <bool masked, bool output>
  static __attribute__((always_inline)) void column(const Constants<Number> &c,
                                                    const Rows<Number> &r,
                                                    const unsigned int i,
                                                    const Index valid,
                                                    Carry &carry)
  {
    RowStrain lower = strain(c, r, i, 0, carry);

    Vector below_qx  = load(r.qx + i);
    Vector below_qy  = load(r.qy + i);
    Vector below_sxy = load(r.sxy + i);
    Vector below_syy = load(r.syy + i);

#pragma GCC unroll 8
    for (int k = 0; k < n_rows; ++k)
      {
        const RowStrain upper = strain(c, r, i, k + 1, carry);

        Vector ex  = lower.dx + upper.dx;
        Vector ey  = lower.dy + upper.dy;
        Vector dx  = upper.sx - lower.sx;
        Vector dy  = upper.sy - lower.sy;
        Vector gx_ = upper.dx - lower.dx;
        Vector gy_ = upper.dy - lower.dy;
        if constexpr (masked)
          {
            ex  = valid ? ex : Vector{};
            ey  = valid ? ey : Vector{};
            dx  = valid ? dx : Vector{};
            dy  = valid ? dy : Vector{};
            gx_ = valid ? gx_ : Vector{};
            gy_ = valid ? gy_ : Vector{};
          }

        const MaterialAccess<Number, variant> m(c, r.phases + k * r.phase_stride + i);

        const Vector ratio = splat(c.ratio);
        const Vector shear = fma(ratio, dx, ey);
        const Vector exs   = ratio * ex;
        const Vector cc12  = m.template get<c12>();

        Vector ax  = fma(m.template get<c11>(), exs, cc12 * dy);
        Vector syy = fma(m.template get<c22>(), dy, cc12 * exs);
        Vector sxy = m.template get<c33>() * shear;
        Vector qx, qy, px, py;
        if constexpr (anisotropic)
          {
            const Vector cc13 = m.template get<c13>();
            const Vector cc23 = m.template get<c23>();
            ax                = fma(cc13, shear, ax);
            syy               = fma(cc23, shear, syy);
            sxy               = fma(cc13, exs, fma(cc23, dy, sxy));
            const Vector ccg  = m.template get<gxy>();
            const Vector hx_  = fma(m.template get<gx>(), gx_, ccg * gy_);
            const Vector hy_  = fma(m.template get<gy>(), gy_, ccg * (ratio * gx_));
            qx                = ax + hx_;
            px                = ax - hx_;
            qy                = sxy + hy_;
            py                = sxy - hy_;
          }
        else
          {
            const Vector kx = m.template get<gx>();
            const Vector ky = m.template get<gy>();
            qx              = fma(kx, gx_, ax);
            px              = fnma(kx, gx_, ax);
            qy              = fma(ky, gy_, sxy);
            py              = fnma(ky, gy_, sxy);
          }

        const Vector tx     = px + below_qx;
        const Vector ty     = py + below_qy;
        const Vector bx     = below_sxy - sxy;
        const Vector by     = below_syy - syy;
        const Vector left_x = tx + bx;
        const Vector left_y = ty + by;
        const Vector fx     = left_neighbours(carry.left_x[k], left_x) - (tx - bx);
        const Vector fy     = left_neighbours(carry.left_y[k], left_y) - (ty - by);
        carry.left_x[k]     = left_x;
        carry.left_y[k]     = left_y;

        if constexpr (output)
          write(c, r, i, k, fx, fy);

        below_qx  = qx;
        below_qy  = qy;
        below_sxy = sxy;
        below_syy = syy;
        lower     = upper;
      }

    if constexpr (output)
      {
        store(r.qx + i, below_qx);
        store(r.qy + i, below_qy);
        store(r.sxy + i, below_sxy);
        store(r.syy + i, below_syy);
      }
  }

  /** Stores the forces on node row k, or advances the row. */
  static __attribute__((always_inline)) void write(const Constants<Number> &c,
                                                   const Rows<Number> &r,
                                                   const unsigned int i,
                                                   const int k,
                                                   Vector fx,
                                                   Vector fy)
  {
    if constexpr (!step)
      {
        fx = fx * splat(c.scale_x);
        fy = fy * splat(c.scale_y);
      }
    if constexpr (gravity)
      {
        const Vector mass    = load(r.mass + k * r.mass_stride + i);
        const std::size_t at = k * r.stride + i;
        const Vector gx      = splat(step ? c.scaled_gravity_x : c.gravity_x),
                     gy      = splat(step ? c.scaled_gravity_y : c.gravity_y),
                     ax      = splat(step ? c.scaled_alpha_x : c.alpha),
                     ay      = splat(step ? c.scaled_alpha_y : c.alpha);
        fx                   = fnma(fnma(ax, load(r.wx + at), gx), mass, fx);
        fy                   = fnma(fnma(ay, load(r.wy + at), gy), mass, fy);
      }
    if constexpr (step)
      {
        const std::size_t at = k * r.stride + i;
        const std::size_t m  = k * r.factor_stride + i;
        move(c, r.ux + at, r.wx + at, fx, load(r.factor_x + m));
        move(c, r.uy + at, r.wy + at, fy, load(r.factor_y + m));
      }
    else
      {
        store(r.fx + k * r.f_stride + i, fx);
        store(r.fy + k * r.f_stride + i, fy);
      }
  }

  static __attribute__((always_inline)) void move(
    const Constants<Number> &c, Number *u, Number *w, const Vector f, const Vector factor)
  {
    const Vector w_old = load(w);
    const Vector w_new = fma(factor, f, w_old);
    store(w, w_new);
    store(u, fma(splat(c.c_new), w_new, fma(splat(c.c_old), w_old, load(u))));
  }

  static __attribute__((always_inline)) Index valid_cells(const Constants<Number> &c,
                                                          const unsigned int i)
  {
    return iota(Index{}) + static_cast<int>(i) < static_cast<int>(c.n_cells);
  }

  /**
   * In a periodic row, P + Q + B' of the last cell is the left neighbour of the first
   * one.
   */
  static __attribute__((always_inline)) void
  wrap(const Constants<Number> &c, const Rows<Number> &r, Carry &carry)
  {
    const unsigned int last = c.n_cells - 1;
    const unsigned int i    = last / vl * vl;
    start(c, r, i, carry);
    column<true, false>(c, r, i, valid_cells(c, i), carry);
#pragma GCC unroll 8
    for (int k = 0; k < n_rows; ++k)
      {
        carry.left_x[k] =
          splat(reinterpret_cast<const Number *>(&carry.left_x[k])[last - i]);
        carry.left_y[k] =
          splat(reinterpret_cast<const Number *>(&carry.left_y[k])[last - i]);
      }
  }

  static void run(const Constants<Number> &constants, const Rows<Number> &rows)
  {
    const Constants<Number> &c = constants;
    const Rows<Number> r       = rows;
    Carry carry;
#pragma GCC unroll 8
    for (int k = 0; k < n_rows; ++k)
      carry.left_x[k] = carry.left_y[k] = Vector{};
    if (c.periodic)
      wrap(c, r, carry);
    start(c, r, 0, carry);
    const unsigned int last = c.n_cells / vl * vl;
    for (unsigned int i = 0; i < last; i += vl)
      column<false, true>(c, r, i, Index{}, carry);
    column<true, true>(c, r, last, valid_cells(c, last), carry);
  }
};
