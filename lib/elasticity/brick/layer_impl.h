// Forces of bricks between two planes of nodes, row by row; terms shared by neighbouring
// rows and planes are computed once. Included inside a namespace by the kernels, after
// brick_impl.h.

/**
 * Data shared by the rows of cells between two planes of nodes; for cubes the ratios are
 * 1.
 */
template <typename Number, bool cubes = false>
struct Layer
{
  const Number *lower, *upper; ///< nodes of the two planes, from row 0 on
  Number *combined;            ///< last row: sums and differences along z and x
  Number *forces;              ///< forces on combined from the last row of cells
  Number *plane;               ///< forces on sums and differences along x, both planes
  Number *complete;            ///< complete forces on a row of nodes
  std::size_t stride;          ///< length of a row in all these arrays
  unsigned int n_vectors;      ///< vectors per row
  Number x, z;                 ///< edge ratios
  Number weight[3];            ///< weights of the terms with xi
  Number strain[6], stress[6]; ///< strain and stress to be added

  /** Differences along x in units of the edge along the rows. */
  template <typename Vector>
  inline __attribute__((always_inline)) Vector times_x(const Vector v) const
  {
    if constexpr (cubes)
      return v;
    else
      return x * v;
  }

  /** Differences along z in units of the edge along the rows. */
  template <typename Vector>
  inline __attribute__((always_inline)) Vector times_z(const Vector v) const
  {
    if constexpr (cubes)
      return v;
    else
      return z * v;
  }
};

/** Sums and differences along x and z of a row of nodes: [component][x + 2 z]. */
template <typename Number, bool cubes, typename Vector, int n_components>
MESOSLIP_INLINE void combine_nodes(const Layer<Number, cubes> &layer,
                                   const std::size_t at,
                                   Vector (&v)[n_components][4])
{
  for (int c = 0; c < n_components; ++c)
    {
      const Number *below = layer.lower + c * layer.stride + at,
                   *above = layer.upper + c * layer.stride + at;
      const Vector b0 = load(below), b1 = load_any(below + 1), a0 = load(above),
                   a1 = load_any(above + 1);
      const Vector bs = b0 + b1, bd = layer.times_x(b1 - b0), as = a0 + a1,
                   ad = layer.times_x(a1 - a0);
      v[c][0]         = bs + as;
      v[c][1]         = bd + ad;
      v[c][2]         = layer.times_z(as - bs);
      v[c][3]         = layer.times_z(ad - bd);
    }
}

/**
 * Initializes the layer before its first row of cells; with @p keep it keeps the forces
 * from another row below.
 */
template <typename Number, bool cubes>
MESOSLIP_INLINE void start_layer(const Layer<Number, cubes> &layer,
                                 const bool keep = false)
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
          if (!keep)
            store(layer.forces + m * layer.stride + i, Vector{});
        }
    }
}

/**
 * Distributes the forces @p h on sums and differences along z and x of component @p c to
 * a row of nodes in both planes. Together with the forces from the layer below, the nodes
 * of the lower plane are complete.
 */
template <typename Number, bool cubes, typename Vector>
MESOSLIP_INLINE void complete_nodes(const Layer<Number, cubes> &layer,
                                    Number *plane,
                                    const int c,
                                    const std::size_t i,
                                    const Vector h[4],
                                    Vector &before)
{
  const std::size_t s = layer.stride;
  Number *sums = plane + std::size_t(2 * c) * s + i, *differences = sums + s;
  const Vector sum   = load(sums) + h[0] - layer.times_z(h[2]),
               other = load(differences) + h[1] - layer.times_z(h[3]);
  store(sums, h[0] + layer.times_z(h[2]));
  store(differences, h[1] + layer.times_z(h[3]));
  const Vector right = sum + layer.times_x(other);
  store(layer.complete + c * s + i,
        sum - layer.times_x(other) + left_neighbours(before, right));
  before = right;
}

/** Row @p j of cells: completes the forces on node row j of the lower plane. */
template <typename Number, bool cubes, typename Material>
MESOSLIP_INLINE void row_of_cells(const Layer<Number, cubes> &layer,
                                  const Material &cells,
                                  const std::size_t j)
{
  using Vector        = typename Simd<Number>::Vector;
  const std::size_t s = layer.stride;
  Vector before[3]    = {};
  for (unsigned int n = 0; n < layer.n_vectors; ++n)
    {
      const std::size_t i = std::size_t{n} * Simd<Number>::length;
      Vector v[3][4], u[3][8], g[3][8], e[6], t[6];
      cells.prefetch(i);
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
          complete_nodes(layer, layer.plane + 6 * j * s, c, i, h, before[c]);
        }
    }
}

/**
 * Completes the forces on node row @p j of the lower plane, after the last row of cells;
 * without @p has_cells the whole layer has none.
 */
template <typename Number, bool cubes>
MESOSLIP_INLINE void
end_of_cells(const Layer<Number, cubes> &layer, const bool has_cells, const std::size_t j)
{
  using Vector        = typename Simd<Number>::Vector;
  const std::size_t s = layer.stride;
  Vector before[3]    = {};
  for (unsigned int n = 0; n < layer.n_vectors; ++n)
    {
      const std::size_t i = std::size_t{n} * Simd<Number>::length;
      for (int c = 0; c < 3; ++c)
        {
          Vector h[4] = {};
          for (int m = 0; has_cells && m < 4; ++m)
            h[m] = load(layer.forces + (4 * c + m) * s + i);
          complete_nodes(layer, layer.plane + 6 * j * s, c, i, h, before[c]);
        }
    }
}
