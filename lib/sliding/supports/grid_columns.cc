#include "sliding/supports/grid_columns.h"

#include <numeric>

namespace mesoslip
{
void restrict_side(LoadedSide &side, const NodeRows &rows)
{
  std::vector<unsigned int> here(rows.n_local());
  std::iota(here.begin(), here.end(), rows.first());
  if (side.support.is_platen)
    {
      here = inner_rows(rows);
      for (unsigned int &row : here)
        row += rows.first();
      side.nodes = side.nodes.at(here);
      return;
    }
  side.nodes = side.nodes.at(here);
  for (unsigned int l = 0; l < rows.n_local(); ++l)
    side.counted.push_back(rows.first() + l >= rows.begin && rows.first() + l < rows.end);
}

std::deque<SideColumn> make_columns(std::deque<SideSurface<2>> &sides,
                                    const SlidingSetup &setup,
                                    const UniformMaterial &material,
                                    const UniformMaterial *damping,
                                    const NodeRows &rows,
                                    NodalField<double> &u,
                                    NodalField<double> &w)
{
  std::deque<SideColumn> columns;
  for (std::size_t k = 0; k < sides.size(); ++k)
    {
      const std::size_t among = setup.loaded.size() - sides.size() + k;
      const bool left         = setup.loaded[among].support.name == "Left";
      columns.emplace_back(sides[k], left ? 0 : material.n_columns() - 1, material, rows,
                           setup.step, damping,
                           left ? setup.sides.left_held : setup.sides.right_held, u, w);
    }
  return columns;
}

std::deque<PlatenColumn> make_platen_columns(std::deque<RigidPlaten<2>> &platens,
                                             const SlidingSetup &setup,
                                             const UniformMaterial &material,
                                             const UniformMaterial *damping,
                                             const NodeRows &rows,
                                             NodalField<double> &u,
                                             NodalField<double> &w)
{
  std::deque<PlatenColumn> columns;
  for (std::size_t k = 0; k < platens.size(); ++k)
    columns.emplace_back(
      platens[k], setup.loaded[k].support.name == "Left" ? 0 : material.n_columns() - 1,
      material, rows, setup.step, damping, u, w, setup.platen_ranks);
  return columns;
}
} // namespace mesoslip
