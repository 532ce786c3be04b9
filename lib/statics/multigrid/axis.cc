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

ConstrainedUnknowns::ConstrainedUnknowns(const DofMask &mask,
                                         const Axis &x,
                                         const Axis &y)
  : rows(y.n_nodes())
{
  for (unsigned int j = 0; j < y.n_nodes(); ++j)
    for (unsigned int i = 0; i < x.n_nodes(); ++i)
      {
        const unsigned int duplicate_i = x.periodic && i == 0 ? mask.n_columns() - 1 : i,
                           duplicate_j = y.periodic && j == 0 ? mask.n_rows() - 1 : j;
        const unsigned int bits        = mask.bits({i, j}) | mask.bits({duplicate_i, j}) |
                                  mask.bits({i, duplicate_j}) |
                                  mask.bits({duplicate_i, duplicate_j});
        if (bits != 0)
          rows[j].push_back({i, static_cast<std::uint8_t>(bits == 3 ? 7 : bits)});
      }
}

ConstrainedUnknowns::ConstrainedUnknowns(const ConstrainedUnknowns &fine,
                                         const AxisCoarsening &x,
                                         const AxisCoarsening &y)
  // Where y is periodic, the last coarse row is the first one.
  : rows(y.n_coarse_cells() + (y.start(y.n_coarse_cells()) < fine.rows.size() ? 1 : 0))
{
  for (unsigned int J = 0; J < rows.size(); ++J)
    {
      unsigned int I = 0;
      for (const Node &node : fine.rows[y.start(J)])
        {
          while (I <= x.n_coarse_cells() && x.start(I) < node.column)
            ++I;
          if (I <= x.n_coarse_cells() && x.start(I) == node.column)
            rows[J].push_back({I, node.bits});
        }
    }
}
} // namespace mesoslip::multigrid
