#include "grid/sweep_options.h"

#include <algorithm>
#include <cstddef>
#include <unistd.h>

namespace mesoslip
{
namespace
{
constexpr std::size_t row_bytes_per_node = 4 * sizeof(double);

std::size_t second_level_cache()
{
  const long size = sysconf(_SC_LEVEL2_CACHE_SIZE);
  return size > 0 ? size : 1 << 20;
}

std::size_t
suggested(const unsigned int n_columns, const unsigned int n_rows, const bool is_slab)
{
  const std::size_t cache = second_level_cache(), row = n_columns * row_bytes_per_node;
  if (row * n_rows < (is_slab ? cache / 8 * 7 : cache / 2))
    return 1;
  // What a stage has just written is read by the next one, so more stages pay even when
  // they do not all fit: measured on rows of 0.6 to 36 kB. A stage is at five rows.
  const std::size_t stages = std::clamp<std::size_t>(cache / 2 / (5 * row), 8, 16);
  if (!is_slab)
    return stages;
  // (n - 1) / 2 more rows a step on each side.
  return std::min<std::size_t>(stages, 1 + n_rows * 3 / 100);
}
} // namespace

unsigned int choose_steps_at_once(const unsigned int n_columns,
                                  const unsigned int n_rows,
                                  const unsigned int n_ranks,
                                  const unsigned int requested)
{
  const unsigned int of_a_rank = n_rows / n_ranks;
  // Every rank has to own what its neighbours ask for; slabs differ by two rows.
  const unsigned int most = n_ranks > 1 ? std::clamp(of_a_rank, 3u, 66u) - 2 : 64u;
  if (n_rows < 3)
    return 1;
  const std::size_t n =
    requested > 0 ? requested : suggested(n_columns, of_a_rank, n_ranks > 1);
  return std::min<std::size_t>(n, most);
}
} // namespace mesoslip
