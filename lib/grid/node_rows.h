#ifndef mesoslip_grid_node_rows_h
#define mesoslip_grid_node_rows_h

namespace mesoslip
{
/**
 * The node rows of a uniform grid that one rank works on: it owns [begin, end) of the
 * rows 0..n_global-1 and stores, in addition, ghost rows on each side that has a
 * neighbour. Fields on a slab hold n_local() rows, row `local(j)` being global row j.
 */
struct NodeRows
{
  unsigned int n_global = 0; ///< rows of the whole grid
  unsigned int begin    = 0; ///< first row owned
  unsigned int end      = 0; ///< one beyond the last row owned

  /** Ghost rows a side: one is enough for operators, n for n time steps at once. */
  unsigned int ghosts = 1;

  /** All rows on one rank. */
  static NodeRows all(const unsigned int n)
  {
    return {n, 0, n};
  }

  /** Whether a rank below owns rows. */
  bool has_lower_ghost() const
  {
    return begin > 0;
  }

  /** Whether a rank above owns rows. */
  bool has_upper_ghost() const
  {
    return end < n_global;
  }

  /** First stored row, global number. */
  unsigned int first() const
  {
    return begin > ghosts ? begin - ghosts : 0;
  }

  /** One past the last stored row, global number. */
  unsigned int last() const
  {
    return n_global - end > ghosts ? end + ghosts : n_global;
  }

  /** Owned rows and ghosts. */
  unsigned int n_local() const
  {
    return last() - first();
  }

  /** Row of a field that holds global row @p global_row. */
  unsigned int local(const unsigned int global_row) const
  {
    return global_row - first();
  }
};
} // namespace mesoslip

#endif
