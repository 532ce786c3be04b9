#include "statics/multigrid/held_unknowns.h"

namespace mesoslip
{
namespace multigrid
{
HeldUnknowns::HeldUnknowns(const DofMask &mask, const Axis &x, const Axis &y)
  : rows(y.n_nodes())
{
  const unsigned int last_column = mask.n_columns() - 1, last_row = mask.n_rows() - 1;
  for (unsigned int j = 0; j < y.n_nodes(); ++j)
    for (unsigned int i = 0; i < x.n_nodes(); ++i)
      {
        std::uint8_t bits = mask.held(i, j);
        if (x.periodic && i == 0)
          bits |= mask.held(last_column, j);
        if (y.periodic && j == 0)
          bits |= mask.held(i, last_row);
        if (x.periodic && y.periodic && i == 0 && j == 0)
          bits |= mask.held(last_column, last_row);
        if (bits == 0)
          continue;
        rows[j].push_back({i, static_cast<std::uint8_t>(bits == 3 ? 7 : bits)});
        ++n_nodes;
      }
}

HeldUnknowns::HeldUnknowns(const HeldUnknowns &fine, const Interpolation &interpolation)
  : rows(interpolation.coarse_y.n_nodes())
{
  const AxisCoarsening &x = interpolation.x;
  for (unsigned int J = 0; J < rows.size(); ++J)
    {
      unsigned int I = 0;
      for (const Node &node : fine.rows[interpolation.y.start(J)])
        {
          while (I < interpolation.coarse_x.n_nodes() && x.start(I) < node.column)
            ++I;
          if (I == interpolation.coarse_x.n_nodes())
            break;
          if (x.start(I) != node.column)
            continue;
          rows[J].push_back({I, node.bits});
          ++n_nodes;
        }
    }
}
} // namespace multigrid
} // namespace mesoslip
