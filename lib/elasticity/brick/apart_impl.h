// Stiffnesses of cells, some of which have mean dilatation. Included inside a namespace
// by the kernels, after brick_impl.h.

/**
 * Index of coefficient @p m of the stiffness about the mean within the combined
 * coefficients.
 */
template <unsigned int n>
constexpr unsigned int about_mean(const unsigned int m)
{
  return n != n_isotropic ? n + m : m == 0 ? 2 : 1;
}

/**
 * A stiffness of @p n coefficients for the mean strain, and one for the deviation from
 * the mean.
 */
template <typename Number, unsigned int n, unsigned int n_both>
struct ApartStiffness
{
  using Vector = typename Simd<Number>::Vector;
  Stiffness<Number, n> mean, about;

  template <typename Load>
  MESOSLIP_INLINE Stiffness<Number, n_both> of(const Load &load_one)
  {
    Stiffness<Number, n_both> result;
    result.mean = Stiffness<Number, n>::of(load_one);
    result.about =
      Stiffness<Number, n>::of([&](const unsigned int m) __attribute__((always_inline)) {
        return load_one(about_mean<n>(m));
      });
    return result;
  }

  template <int n_strains>
  inline __attribute__((always_inline)) void stress(const Vector (&e)[n_strains],
                                                    Vector (&s)[n_strains]) const
  {
    mean.stress(e, s);
  }

  template <int axis>
  inline __attribute__((always_inline)) void plane_stress(const Vector e[6],
                                                          Vector s[6]) const
  {
    about.template plane_stress<axis>(e, s);
  }

  template <int axis>
  inline __attribute__((always_inline)) void line_stress(const Vector u[3],
                                                         Vector t[3]) const
  {
    about.template line_stress<axis>(u, t);
  }
};

template <typename Number>
struct Stiffness<Number, n_isotropic_apart>
  : ApartStiffness<Number, n_isotropic, n_isotropic_apart>
{
};

template <typename Number>
struct Stiffness<Number, n_general_apart>
  : ApartStiffness<Number, n_general, n_general_apart>
{
};
