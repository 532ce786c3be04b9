#include "morphology/fibre_sampler.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
long whole_cells(const double length, const double h)
{
  return std::max(1L, std::lround(length / h));
}
} // namespace

FibreSampler::FibreSampler(const UniformGrid<2> &box, const FibrePlacement &placement)
  : random(placement.seed)
  , grid(box)
  , rules(placement)
  , fibre_width(whole_cells(placement.width, box.spacing[0]))
  , lowest(whole_cells(placement.min_height, box.spacing[1]))
  , tallest(std::max(lowest, whole_cells(placement.max_height, box.spacing[1])))
{
  if (!rules.cut_by_border)
    tallest = std::min(tallest, static_cast<long>(grid.cells[1]));
}

bool FibreSampler::possible() const
{
  return rules.cut_by_border ||
         (fibre_width <= static_cast<long>(grid.cells[0]) && lowest <= tallest &&
          rules.width <= grid.extent(0) * (1. + 1e-9) &&
          rules.min_height <= grid.extent(1) * (1. + 1e-9));
}

Rectangle FibreSampler::aligned(const long x, const long y, const long height) const
{
  const auto [h_x, h_y] = grid.spacing;
  return {grid.origin[0] + static_cast<double>(x) * h_x,
          grid.origin[1] + static_cast<double>(y) * h_y,
          static_cast<double>(fibre_width) * h_x, static_cast<double>(height) * h_y,
          rules.phase};
}

Rectangle FibreSampler::draw_aligned()
{
  const long n_x    = grid.cells[0];
  const long n_y    = grid.cells[1];
  const long height = random.whole(lowest, tallest);
  if (rules.cut_by_border)
    {
      const long x = random.whole(1 - fibre_width, n_x - 1);
      const long y = random.whole(1 - height, n_y - 1);
      return aligned(x, y, height);
    }
  const long x = random.whole(0, n_x - fibre_width);
  const long y = random.whole(0, n_y - height);
  return aligned(x, y, height);
}

Rectangle FibreSampler::draw()
{
  if (rules.align_to_grid)
    return draw_aligned();
  const bool cut = rules.cut_by_border;
  const double limit =
    cut ? rules.max_height : std::min(rules.max_height, grid.extent(1));
  const double height = random.between(rules.min_height, limit);
  const double x      = cut ? random.between(-rules.width, grid.extent(0))
                            : random.between(0., grid.extent(0) - rules.width);
  const double y      = cut ? random.between(-height, grid.extent(1))
                            : random.between(0., grid.extent(1) - height);
  return {grid.origin[0] + x, grid.origin[1] + y, rules.width, height, rules.phase};
}
} // namespace mesoslip
