// Sweep over a box of bricks: forces of the cells, tile by tile, layer by layer and row
// by row (layer_impl.h). As soon as the forces on a row of nodes are complete, they are
// processed. A tile consists of some neighbouring rows of all planes, so that data shared
// by two planes stays in the cache; the next tile takes over the forces on the row of
// nodes between them. A complete row is not needed again, so it is advanced in place.
// Included inside a namespace by brick_kernel.cc.

/**
 * Computes the rows of cells between planes k - 1 and k of a tile; this completes the
 * rows of nodes below them. The nodes of plane k are read from @p source.
 */
template <typename Cells, typename Finish>
MESOSLIP_INLINE void advance_layer(const BrickSweep &a,
                                   const Finish &finish,
                                   Layer<double, Cells::cubes> &layer,
                                   double *upper,
                                   const std::size_t k,
                                   const std::size_t first,
                                   const std::size_t n_rows)
{
  const Source source       = Finish::source(finish);
  const std::size_t n_cells = a.n[1] - 1;
  const auto place          = [&](const std::size_t plane, const std::size_t j) {
    return a.plane_start[plane] + (first + j) * a.n[0];
  };
  const auto fetch = [&](const std::size_t j) __attribute__((always_inline))
  {
    if (k < a.n[2] && first + j < a.n[1])
      copy_row(a, source, place(k, j), upper + 3 * j * a.stride);
  };
  // Position of the row of nodes after the next one, inside the tile.
  const auto wanted = [&](const std::size_t j) {
    const std::size_t plane = k < a.n[2] ? k : k - 1, next = j + 2;
    if (next <= n_rows)
      return place(plane, next);
    return plane + 1 < a.n[2] ? place(plane + 1, next - n_rows - 1) : place(plane, j);
  };
  const bool has_cells =
    (k > 0 || a.has_layer_below) && (k < a.n[2] || a.has_layer_above);
  layer.forces = a.carry + k * 12 * a.stride;
  fetch(0);
  if (has_cells)
    start_layer(layer, first > 0);
  for (std::size_t j = 0; j < n_rows; ++j)
    {
      fetch(j + 1);
      if (has_cells && first + j < n_cells)
        row_of_cells(layer, Cells(a, k * n_cells + first + j, source, wanted(j)), j);
      else
        end_of_cells(layer, has_cells, j);
      if (a.periodic)
        for (int c = 0; c < 3; ++c)
          layer.complete[c * a.stride] += layer.complete[c * a.stride + a.n[0]];
      if (k > 0)
        finish.finish(a, k - 1, first + j, layer.complete);
    }
}

/** Sweep over a box, see brick_kernel.h. */
template <typename Cells, typename Finish>
MESOSLIP_INLINE void sweep(const BrickSweep &a, const Finish &finish)
{
  const std::size_t s = a.stride, nodes = 3 * (std::size_t{a.rows_at_once} + 1) * s;
  double *planes[2]                 = {a.scratch + 15 * s, a.scratch + 15 * s + nodes};
  Layer<double, Cells::cubes> layer = {};
  layer.combined                    = a.scratch;
  layer.complete                    = a.scratch + 12 * s;
  layer.plane                       = planes[1] + nodes;
  layer.stride                      = s;
  // The first node follows the last one again.
  layer.n_vectors =
    (a.n[0] + a.periodic + Simd<double>::length - 1) / Simd<double>::length;
  layer.x         = a.ratio[0];
  layer.z         = a.ratio[1];
  layer.weight[0] = 1 / (3 * layer.x * layer.x);
  layer.weight[1] = 1. / 3.;
  layer.weight[2] = 1 / (3 * layer.z * layer.z);
  for (std::size_t i = 0; i < 2 * nodes; ++i)
    planes[0][i] = 0.;
  for (std::size_t first = 0; first < a.n[1]; first += a.rows_at_once)
    {
      const std::size_t rest = a.n[1] - first,
                        rows = rest < a.rows_at_once ? rest : a.rows_at_once;
      for (std::size_t i = 0; i < 6 * rows * s; ++i)
        layer.plane[i] = 0.;
      for (std::size_t k = 0; k <= a.n[2]; ++k)
        {
          double *upper = planes[(k + 1) % 2];
          layer.lower   = k > 0 ? planes[k % 2] : a.below + 3 * first * s;
          layer.upper   = k < a.n[2] ? upper : a.above + 3 * first * s;
          advance_layer<Cells>(a, finish, layer, upper, k, first, rows);
        }
    }
}

template <typename Cells>
void advance(const BrickSweep &a, const BrickStep &step)
{
  sweep<Cells>(a, Advance{step});
}

template <typename Cells>
void multiply(const BrickSweep &a, const BrickProduct &product)
{
  sweep<Cells>(a, WriteForces{product});
}

static void copy_plane(const BrickSweep &a,
                       const double *const x[3],
                       const double *const w[3],
                       const double beta,
                       const unsigned int plane,
                       double *out)
{
  const Source source = {{x[0], x[1], x[2]}, {w[0], w[1], w[2]}, beta};
  for (std::size_t j = 0; j < a.n[1]; ++j)
    {
      const std::size_t place = a.plane_start[plane] + j * a.n[0];
      copy_row(a, source, place, out + 3 * j * a.stride);
    }
}
