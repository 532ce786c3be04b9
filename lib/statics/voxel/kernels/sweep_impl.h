// A sweep over all nodes: computes the forces of the cells layer by layer and row by row
// (see layer_impl.h), and uses the forces on a row of nodes as soon as they are complete.
// No later row needs this one, so it may be changed in place. Included inside a namespace
// by voxel_kernels.cc.

/** The row of nodes of the upper plane needed after the row of cells @p row. */
template <typename Number>
MESOSLIP_INLINE const Number *next_nodes(const SweepArguments<Number> &a,
                                         const std::size_t row)
{
  const std::size_t k = row / (a.n[1] + 1), j = row % (a.n[1] + 1);
  return a.x + ((k + 1) * (a.n[1] + 2) + j + 2) * 3 * a.stride;
}

/** Prefetches a row of nodes. */
template <typename Number>
MESOSLIP_INLINE void
prefetch_nodes(const Number *row, const std::size_t stride, const std::size_t i)
{
  for (int c = 0; c < 3; ++c)
    __builtin_prefetch(row + c * stride + i);
}

/** Coefficients of the cells of a row in memory. */
template <typename Number, Cells cells>
struct Stored
{
  using Vector                      = typename Simd<Number>::Vector;
  static constexpr bool cubes       = cells == Cells::cubes;
  static constexpr bool adds_stress = false;
  static constexpr unsigned int n   = n_stored(cells);

  Stored(const SweepArguments<Number> &a, const std::size_t row)
    : first(a.stiffness + row * n * a.stride)
    , stride(a.stride)
    , next(is_flat(cells) ? nullptr : next_nodes(a, row))
  {
  }
  inline __attribute__((always_inline)) Stiffness<Number, n_in_table(cells)>
  at(const std::size_t i) const
  {
    if constexpr (cubes)
      {
        const Vector lambda = load(first + i), mu = load(first + stride + i);
        return {lambda, mu, Number(1. / 3.) * lambda,
                Number(1. / 9.) * (lambda + 4 * mu)};
      }
    else
      return Stiffness<Number, n>::of([&](const unsigned int m) __attribute__((
        always_inline)) { return load(first + m * stride + i); });
  }
  Vector inside(const std::size_t) const
  {
    return Vector{};
  }

  inline __attribute__((always_inline)) void prefetch(const std::size_t i) const
  {
    prefetch_nodes(next, stride, i);
  }

  const Number *first;
  std::size_t stride;
  const Number *next;
};

/** Numbers of a table that fit in registers. */
constexpr unsigned int few_phases = MESOSLIP_VECTOR_BYTES / sizeof(float);

/** table[index] of few_phases numbers. */
template <typename Number, typename Index>
MESOSLIP_INLINE typename Simd<Number>::Vector look_up(const Number *table,
                                                      const Index index)
{
#if defined(__AVX512F__)
  if constexpr (sizeof(Number) == sizeof(float))
    return lookup(load(table), index);
  else
    return lookup(load(table), load(table + Simd<Number>::length), index);
#elif defined(__AVX2__)
  if constexpr (sizeof(Number) == sizeof(float))
    return (vfloat)_mm256_permutevar8x32_ps((__m256)load(table), (__m256i)index);
  else
    return gather(table, index);
#else
  return gather(table, index);
#endif
}

/** Coefficients looked up by the phase of the cell; in double precision strain and stress
 * are added. */
template <typename Number, Cells cells, bool few>
struct OfPhases
{
  using Vector                      = typename Simd<Number>::Vector;
  using Index                       = typename Simd<Number>::Index;
  static constexpr bool cubes       = cells == Cells::cubes;
  static constexpr bool adds_stress = sizeof(Number) == sizeof(double);
  static constexpr unsigned int n   = n_in_table(cells);

  OfPhases(const SweepArguments<Number> &a, const std::size_t row)
    : first(a.phase + row * a.stride)
    , table(a.table)
    , stride(a.stride)
    , next(is_flat(cells) ? nullptr : next_nodes(a, row))
  {
  }
  inline __attribute__((always_inline)) Vector of(const unsigned int m,
                                                  const Index index) const
  {
    if constexpr (few)
      return look_up(table + std::size_t(m) * 256, index);
    else
      return gather(table + std::size_t(m) * 256, index);
  }
  inline __attribute__((always_inline)) Stiffness<Number, n> at(const std::size_t i) const
  {
    const Index index = load_bytes(first + i, Index{});
    return Stiffness<Number, n>::of([&](
      const unsigned int m) __attribute__((always_inline)) { return of(m, index); });
  }
  inline __attribute__((always_inline)) Vector inside(const std::size_t i) const
  {
    return of(n, load_bytes(first + i, Index{}));
  }

  inline __attribute__((always_inline)) void prefetch(const std::size_t i) const
  {
    prefetch_nodes(next, stride, i);
  }

  const std::uint8_t *first;
  const Number *table;
  std::size_t stride;
  const Number *next;
};

/** Coefficients looked up by the material of the cell; there may be too many for a
 * byte. */
template <typename Number, Cells cells>
struct OfMaterials
{
  using Vector                      = typename Simd<Number>::Vector;
  using Index                       = typename Simd<Number>::Index;
  static constexpr bool cubes       = false;
  static constexpr bool adds_stress = sizeof(Number) == sizeof(double);
  static constexpr unsigned int n   = n_in_table(cells);

  OfMaterials(const SweepArguments<Number> &a, const std::size_t row)
    : first(a.material + row * a.stride)
    , table(a.table)
    , stride(a.stride)
    , next(next_nodes(a, row))
  {
  }
  inline __attribute__((always_inline)) Index place(const std::size_t i) const
  {
    return load_words(first + i, Index{}) * int{n_of_material(n)};
  }
  inline __attribute__((always_inline)) Stiffness<Number, n> at(const std::size_t i) const
  {
    const Index index = place(i);
    return Stiffness<Number, n>::of([&](const unsigned int m) __attribute__((
      always_inline)) { return gather(table + m, index); });
  }
  Vector inside(const std::size_t i) const
  {
    return gather(table + n, place(i));
  }

  inline __attribute__((always_inline)) void prefetch(const std::size_t i) const
  {
    prefetch_nodes(next, stride, i);
  }

  const std::uint16_t *first;
  const Number *table;
  std::size_t stride;
  const Number *next;
};

/** Pointers to a row of a field, aligned to a cache line; null stays null. */
template <typename T>
MESOSLIP_INLINE T *at_row(T *field, const std::size_t first)
{
  return field ? field + first : nullptr;
}

/** Uses the complete forces @p f on a row of nodes; prefetches data of the next row. */
template <Sweep kind, unsigned int n_components = 3, typename Number>
MESOSLIP_INLINE double
finish_row(const SweepArguments<Number> &a, const std::size_t row, Number *__restrict f)
{
  using Vector            = typename Simd<Number>::Vector;
  const std::size_t first = n_components * row * a.stride, n = n_components * a.stride;
  const float *__restrict b = at_row(a.b, first);
  float *__restrict d = at_row(a.d, first), *__restrict out = at_row(a.out, first);
  double *__restrict exact = at_row(a.exact, first);
  Number *__restrict x     = a.x + first;
  const float keep = a.keep, step = a.step;
  Vector sum = {};
  for (unsigned int c = 0; c < n_components; ++c)
    {
      f[c * a.stride] = 0;
      for (std::size_t i = a.n[0] + 1; i < a.stride; ++i)
        f[c * a.stride + i] = 0;
    }
  for (std::size_t i = 0; kind != Sweep::chebyshev && i < n; i += Simd<Number>::length)
    if constexpr (kind == Sweep::product)
      {
        sum += load(f + i) * load(x + i);
        store(out + i, load(f + i));
      }
    else if constexpr (kind == Sweep::residual)
      {
        __builtin_prefetch(b + i + n);
        store(out + i, load(b + i) - load(f + i));
      }
    else if constexpr (kind == Sweep::outer)
      {
        sum += load(f + i) * load(f + i);
        for (unsigned int l = 0; l < Simd<Number>::length; ++l)
          out[i + l] = static_cast<float>(-f[i + l]);
        if (exact)
          store(exact + i, -load(f + i));
      }
  if constexpr (kind == Sweep::chebyshev)
    {
      const std::size_t all = a.n_diagonals * a.stride;
      const float *inverse  = a.inverse + row * all;
      for (std::size_t c = 0; c < n_components; ++c)
        for (std::size_t i = c * a.stride, j = a.n_diagonals == n_components ? i : 0;
             i < (c + 1) * a.stride; i += Simd<Number>::length, j += Simd<Number>::length)
          {
            __builtin_prefetch(b + i + n);
            __builtin_prefetch(inverse + j + all);
            __builtin_prefetch(d + i + n);
            const Vector last = a.x_is_d ? load(x + i) : load(d + i);
            const Vector change =
              keep * last + step * load(inverse + j) * (load(b + i) - load(f + i));
            if (!a.is_last)
              store(d + i, change);
            store(x + i, load(x + i) + change);
          }
    }
  for (unsigned int c = 0; kind == Sweep::chebyshev && a.periodic && c < n_components;
       ++c)
    {
      x[c * a.stride]              = x[c * a.stride + a.n[0]];
      x[c * a.stride + a.n[0] + 1] = x[c * a.stride + 1];
    }
  double total = 0.;
  for (unsigned int l = 0; l < Simd<Number>::length; ++l)
    total += sum[l];
  return total;
}

/** Initializes the layer of a sweep from the arguments; forces of the plane are set to
 * zero. */
template <typename Layer, typename Number>
MESOSLIP_INLINE Layer first_layer(const SweepArguments<Number> &a,
                                  const std::size_t n_in_plane)
{
  Layer layer     = {};
  layer.plane     = a.work + n_work_rows * a.stride;
  layer.stride    = a.stride;
  layer.n_vectors = a.n[0] / Simd<Number>::length + 1;
  layer.x         = a.ratio[0];
  layer.z         = a.ratio[1];
  layer.weight[0] = 1 / (3 * layer.x * layer.x);
  layer.weight[1] = Number(1) / 3;
  layer.weight[2] = 1 / (3 * layer.z * layer.z);
  for (int m = 0; m < 6; ++m)
    {
      layer.strain[m] = a.strain[m];
      layer.stress[m] = a.stress[m];
    }
  for (std::size_t i = 0; i < n_in_plane; ++i)
    layer.plane[i] = 0;
  return layer;
}

/** A sweep, see kernels.h. */
template <typename Number, typename Material, Sweep kind>
double sweep(const SweepArguments<Number> &a)
{
  const std::size_t s = a.stride, line = 3 * s, plane = (a.n[1] + 2) * line;
  auto layer     = first_layer<Layer<Number, Material::cubes>>(a, (a.n[1] + 1) * 6 * s);
  layer.combined = a.work;
  layer.forces   = a.work + 12 * s;
  layer.complete = a.work + 24 * s;
  double sum     = 0.;
  for (std::size_t k = 0; k <= a.n[2]; ++k)
    {
      layer.lower = a.x + k * plane;
      layer.upper = layer.lower + plane;
      start_layer(layer);
      for (std::size_t j = 0; j <= a.n[1]; ++j)
        {
          row_of_cells(layer, Material(a, k * (a.n[1] + 1) + j), j);
          if (k > 0 && j > 0)
            sum += finish_row<kind>(a, k * (a.n[1] + 2) + j, layer.complete);
        }
    }
  return sum;
}
