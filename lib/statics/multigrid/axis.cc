#include "statics/multigrid/axis.h"

namespace mesoslip::multigrid
{
Axis Axis::uniform(const unsigned int n_cells, const double spacing, const bool periodic)
{
  Axis axis;
  axis.periodic = periodic;
  axis.position.resize(n_cells + 1);
  for (unsigned int i = 0; i <= n_cells; ++i)
    axis.position[i] = i * spacing;
  return axis;
}

AxisCoarsening::AxisCoarsening(const Axis &fine, const bool halve)
  : is_halved(halve)
  , coarse_cells(halve ? (fine.n_cells() + 1) / 2 : fine.n_cells())
  , regular_cells(!halve ? 0
                         : (fine.n_cells() % 2 == 0 ? coarse_cells : coarse_cells - 2))
{
}

Axis AxisCoarsening::coarse(const Axis &fine) const
{
  Axis axis;
  axis.periodic = fine.periodic;
  axis.position.resize(coarse_cells + 1);
  for (unsigned int k = 0; k <= coarse_cells; ++k)
    axis.position[k] = fine.position[start(k)];
  return axis;
}
} // namespace mesoslip::multigrid
