#ifndef mesoslip_mesh_cell_order_h
#define mesoslip_mesh_cell_order_h

#include "mesh/mesh.h"

#include <algorithm>
#include <vector>

namespace mesoslip
{
/**
 * Reorders cells slightly so that simplices with a common point are at least
 * @p far_enough apart, or as far as the candidates allow. Adding to a number that has
 * just been written stalls the processor, and simplices share many points. Other cells
 * gain nothing.
 */
template <int dim>
std::vector<std::size_t> spread_out(const std::vector<Cell> &cells,
                                    const std::size_t n_points,
                                    const std::size_t far_enough)
{
  constexpr std::size_t n_candidates = 64;
  std::vector<std::size_t> order, candidates, last_use(n_points, 0);
  const auto distance = [&](const std::size_t k) {
    std::size_t last = 0;
    for (const unsigned int v : cells[k].vertices)
      last = std::max(last, last_use[v]);
    return last == 0 || cells[k].vertices.size() != dim + 1 ? far_enough
                                                            : order.size() + 1 - last;
  };
  for (std::size_t k = 0; order.size() < cells.size();)
    {
      while (candidates.size() < n_candidates && k < cells.size())
        candidates.push_back(k++);
      auto best          = candidates.begin();
      std::size_t so_far = 0;
      for (auto c = candidates.begin(); c != candidates.end() && so_far < far_enough; ++c)
        if (const std::size_t d = distance(*c); d > so_far)
          {
            so_far = d;
            best   = c;
          }
      for (const unsigned int v : cells[*best].vertices)
        last_use[v] = order.size() + 1;
      order.push_back(*best);
      candidates.erase(best);
    }
  return order;
}
} // namespace mesoslip

#endif
