// A sweep over all nodes: forces of the cells, layer by layer and row by row, and what is
// done with them as soon as those of a row of nodes are complete. Nothing later needs this
// row, so it may be changed in place. Included inside a namespace by kernels_table.cc.

/** Coefficients of the cells of a row in memory. */
template <typename Number, unsigned int n>
struct Stored
{
  using Vector                                 = typename Simd<Number>::Vector;
  static constexpr unsigned int n_coefficients = n;
  static constexpr bool adds_stress            = false;

  Stored(const SweepArguments<Number> &a, const std::size_t row)
    : first(a.stiffness + row * n * a.stride)
    , stride(a.stride)
  {
  }
  inline __attribute__((always_inline)) Stiffness<Number, n> at(const std::size_t i) const
  {
    return Stiffness<Number, n>::of([&](const unsigned int m) __attribute__((
      always_inline)) { return load(first + m * stride + i); });
  }
  Vector inside(const std::size_t) const
  {
    return Vector{};
  }

  const Number *first;
  std::size_t stride;
};

/** The same from a table by the phase of the cell; strain and stress are added. */
template <typename Number, unsigned int n>
struct OfPhases
{
  using Vector                                 = typename Simd<Number>::Vector;
  static constexpr unsigned int n_coefficients = n;
  static constexpr bool adds_stress            = true;

  OfPhases(const SweepArguments<Number> &a, const std::size_t row)
    : first(a.phase + row * a.stride)
    , table(a.table)
  {
  }
  inline __attribute__((always_inline)) Stiffness<Number, n> at(const std::size_t i) const
  {
    const auto index = load_bytes(first + i, typename Simd<Number>::Index{});
    return Stiffness<Number, n>::of([&](const unsigned int m) __attribute__((
      always_inline)) { return gather(table + m * 256, index); });
  }
  inline __attribute__((always_inline)) Vector inside(const std::size_t i) const
  {
    return gather(table + n * 256, load_bytes(first + i, typename Simd<Number>::Index{}));
  }

  const std::uint8_t *first;
  const Number *table;
};

/** What the rows of cells between two planes of nodes share. */
template <typename Number>
struct Layer
{
  const Number *lower, *upper; ///< nodes of the planes, from row 0 on
  Number *combined;            ///< of the last row: sums and differences along z, x
  Number *forces;              ///< on these, from the last row of cells
  Number *plane;               ///< on those along x of the lower plane, then the upper
  Number *complete;            ///< forces on a row of nodes
  std::size_t stride;          ///< of all of these
  unsigned int n_vectors;      ///< in a row
  Number x, z;                 ///< ratios
  Number weight[3];            ///< of terms with xi
  Number strain[6], stress[6]; ///< added
};

/** Sums and differences along x and z of a row of nodes: [component][x + 2 z]. */
template <typename Number, typename Vector>
MESOSLIP_INLINE void
combine_nodes(const Layer<Number> &layer, const std::size_t at, Vector v[3][4])
{
  for (int c = 0; c < 3; ++c)
    {
      const Number *below = layer.lower + c * layer.stride + at,
                   *above = layer.upper + c * layer.stride + at;
      __builtin_prefetch(above + 3 * layer.stride);
      const Vector b0 = load(below), b1 = load_any(below + 1), a0 = load(above),
                   a1 = load_any(above + 1);
      const Vector bs = b0 + b1, bd = layer.x * (b1 - b0), as = a0 + a1,
                   ad = layer.x * (a1 - a0);
      v[c][0]         = bs + as;
      v[c][1]         = bd + ad;
      v[c][2]         = layer.z * (as - bs);
      v[c][3]         = layer.z * (ad - bd);
    }
}

/** Before the first row of cells. */
template <typename Number>
MESOSLIP_INLINE void start_layer(const Layer<Number> &layer)
{
  using Vector = typename Simd<Number>::Vector;
  for (unsigned int n = 0; n < layer.n_vectors; ++n)
    {
      const std::size_t i = std::size_t{n} * Simd<Number>::length;
      Vector v[3][4];
      combine_nodes(layer, i, v);
      for (int m = 0; m < 12; ++m)
        {
          store(layer.combined + m * layer.stride + i, v[m / 4][m % 4]);
          store(layer.forces + m * layer.stride + i, Vector{});
        }
    }
}

/** Row @p j of cells: completes the forces on row j of the nodes of the lower plane. */
template <typename Number, typename Material>
MESOSLIP_INLINE void
row_of_cells(const Layer<Number> &layer, const Material &cells, const std::size_t j)
{
  using Vector        = typename Simd<Number>::Vector;
  const std::size_t s = layer.stride;
  Number *plane       = layer.plane + 6 * j * s;
  Vector before[3]    = {};
  for (unsigned int n = 0; n < layer.n_vectors; ++n)
    {
      const std::size_t i = std::size_t{n} * Simd<Number>::length;
      Vector v[3][4], u[3][8], g[3][8], e[6], t[6];
      combine_nodes(layer, 3 * (j + 1) * s + i, v);
      for (int c = 0; c < 3; ++c)
        for (int m = 0; m < 4; ++m)
          {
            Number *place        = layer.combined + (4 * c + m) * s + i;
            const Vector last    = load(place);
            constexpr int set[4] = {0, 1, 4, 5};
            u[c][set[m]]         = last + v[c][m];
            u[c][set[m] + 2]     = v[c][m] - last;
            store(place, v[c][m]);
          }
      const auto stiffness = cells.at(i);
      mean_strain(u, e);
      if constexpr (Material::adds_stress)
        for (int m = 0; m < 6; ++m)
          e[m] += layer.strain[m];
      stiffness.stress(e, t);
      if constexpr (Material::adds_stress)
        for (int m = 0; m < 6; ++m)
          t[m] -= cells.inside(i) * layer.stress[m];
      mode_forces(stiffness, u, t, layer.weight, g);
      for (int c = 0; c < 3; ++c)
        {
          Vector h[4];
          for (int m = 0; m < 4; ++m)
            {
              Number *place        = layer.forces + (4 * c + m) * s + i;
              constexpr int set[4] = {0, 1, 4, 5};
              const Vector along   = g[c][set[m] + 2];
              if (m == 0)
                {
                  h[m] = load(place) - along;
                  store(place, along);
                }
              else
                {
                  h[m] = load(place) + (g[c][set[m]] - along);
                  store(place, g[c][set[m]] + along);
                }
            }
          Number *sums = plane + std::size_t(2 * c) * s + i, *differences = sums + s;
          const Vector sum   = load(sums) + h[0] - layer.z * h[2],
                       other = load(differences) + h[1] - layer.z * h[3];
          store(sums, h[0] + layer.z * h[2]);
          store(differences, h[1] + layer.z * h[3]);
          const Vector right = sum + layer.x * other;
          store(layer.complete + c * s + i,
                sum - layer.x * other + left_neighbours(before[c], right));
          before[c] = right;
        }
    }
}

/** Rows in a field that begin on a cache line, from their pointers; null stays null. */
template <typename T>
MESOSLIP_INLINE T *at_row(T *field, const std::size_t first)
{
  return field ? field + first : nullptr;
}

/** The forces @p f on a row of nodes are complete. What the next row needs is fetched. */
template <Sweep kind, typename Number>
MESOSLIP_INLINE double
finish_row(const SweepArguments<Number> &a, const std::size_t row, Number *__restrict f)
{
  using Vector            = typename Simd<Number>::Vector;
  const std::size_t first = 3 * row * a.stride, n = 3 * a.stride;
  const float *__restrict b = at_row(a.b, first), *__restrict inverse =
                                                    at_row(a.inverse, first);
  float *__restrict d = at_row(a.d, first), *__restrict out = at_row(a.out, first);
  double *__restrict exact = at_row(a.exact, first);
  Number *__restrict x     = a.x + first;
  const float keep = a.keep, step = a.step;
  Vector sum = {};
  for (int c = 0; c < 3; ++c)
    {
      f[c * a.stride] = 0;
      for (std::size_t i = a.n[0] + 1; i < a.stride; ++i)
        f[c * a.stride + i] = 0;
    }
  for (std::size_t i = 0; i < n; i += Simd<Number>::length)
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
    else if constexpr (kind == Sweep::chebyshev)
      {
        __builtin_prefetch(b + i + n);
        __builtin_prefetch(inverse + i + n);
        __builtin_prefetch(d + i + n);
        const Vector change =
          keep * load(d + i) + step * load(inverse + i) * (load(b + i) - load(f + i));
        store(d + i, change);
        store(x + i, load(x + i) + change);
      }
    else
      {
        sum += load(f + i) * load(f + i);
        for (unsigned int l = 0; l < Simd<Number>::length; ++l)
          out[i + l] = static_cast<float>(-f[i + l]);
        if (exact)
          store(exact + i, -load(f + i));
      }
  for (int c = 0; kind == Sweep::chebyshev && a.periodic && c < 3; ++c)
    {
      x[c * a.stride]              = x[c * a.stride + a.n[0]];
      x[c * a.stride + a.n[0] + 1] = x[c * a.stride + 1];
    }
  double total = 0.;
  for (unsigned int l = 0; l < Simd<Number>::length; ++l)
    total += sum[l];
  return total;
}

/** See kernels.h. */
template <typename Number, typename Material, Sweep kind>
double sweep(const SweepArguments<Number> &a)
{
  const std::size_t s = a.stride, line = 3 * s, plane = (a.n[1] + 2) * line;
  Layer<Number> layer = {};
  layer.combined      = a.work;
  layer.forces        = a.work + 12 * s;
  layer.complete      = a.work + 24 * s;
  layer.plane         = a.work + n_work_rows * s;
  layer.stride        = s;
  layer.n_vectors     = a.n[0] / Simd<Number>::length + 1;
  layer.x             = a.ratio[0];
  layer.z             = a.ratio[1];
  layer.weight[0]     = 1 / (3 * layer.x * layer.x);
  layer.weight[1]     = Number(1) / 3;
  layer.weight[2]     = 1 / (3 * layer.z * layer.z);
  for (int m = 0; m < 6; ++m)
    {
      layer.strain[m] = a.strain[m];
      layer.stress[m] = a.stress[m];
    }
  for (std::size_t i = 0; i < (a.n[1] + 1) * 6 * s; ++i)
    layer.plane[i] = 0;
  double sum = 0.;
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
