// Input and output of a kernel of general cells, batch by batch. Included by these
// kernels only, inside their namespace, after node_transpose.h.

/** Nodes of corner @p i of a batch. */
MESOSLIP_INLINE const std::uint32_t *corner(const std::uint32_t *nodes,
                                            const std::size_t i)
{
  return nodes + i * n_lanes;
}

/**
 * Overlaps memory access with arithmetic: while a batch is computed, its kernel calls
 * move() corner by corner, which stores the forces of the previous batch and loads the
 * displacements of the next one. A processor looks ahead some 300 instructions, fewer
 * than a batch has. Shapes (see ShapeFunction) are prefetched.
 */
template <int dim, int n_corners, bool has_shapes = true>
class CellStream
{
public:
  /** Reads displacements @p u and adds to forces @p f. */
  CellStream(const CellBatches &cells, const double *u, double *f)
    : cells(cells)
    , u(u)
    , f(f)
    , before(cells.nodes)
  {
    for (int i = 0; i < n_corners; ++i)
      load_nodes(u, corner(before, i), next[i]);
  }

  /** Returns the displacements of batch @p k; call it for consecutive batches. */
  inline __attribute__((always_inline)) void start(const std::size_t k,
                                                   vdouble (&value)[n_corners][dim])
  {
    for (int i = 0; i < n_corners; ++i)
      for (int c = 0; c < dim; ++c)
        value[i][c] = next[i][c];
    constexpr std::size_t step = std::size_t(n_corners) * n_lanes;
    here                       = cells.nodes + k * step;
    after                      = k + 1 == cells.n ? here : here + step;
    if (has_shapes)
      shapes = cells.shapes + k * n_shape * n_lanes;
  }

  /** Component @p c of number @p i (from 1 on) of the shapes of the batch. */
  vdouble shape(const int i, const int c) const
  {
    return load(shapes + std::size_t((i - 1) * dim + c) * n_lanes);
  }

  /** Moves corner @p i; call it once per corner between start() and finish(). */
  inline __attribute__((always_inline)) void move(const int i)
  {
    add_to_nodes(f, corner(before, i), done[i]);
    load_nodes(u, corner(after, i), next[i]);
    constexpr int n_ahead = 8, n_lines = (n_shape + n_corners - 1) / n_corners;
    if (has_shapes)
      for (int l = 0; l < n_lines; ++l)
        __builtin_prefetch(shapes +
                           std::size_t(n_ahead * n_shape + i * n_lines + l) * n_lanes);
  }

  /** Takes the forces of the batch. */
  inline __attribute__((always_inline)) void
  finish(const vdouble (&force)[n_corners][dim])
  {
    for (int i = 0; i < n_corners; ++i)
      for (int c = 0; c < dim; ++c)
        done[i][c] = force[i][c];
    before = here;
  }

  /** Writes the forces of the last batch. */
  void end() const
  {
    for (int i = 0; i < n_corners; ++i)
      add_to_nodes(f, corner(before, i), done[i]);
  }

private:
  static constexpr int n_shape = dim * (n_corners - 1);

  const CellBatches cells;
  const double *const u;
  double *const f;
  const std::uint32_t *before, *here = nullptr, *after = nullptr;
  const double *shapes = nullptr;
  vdouble next[n_corners][dim], done[n_corners][dim] = {};
};
