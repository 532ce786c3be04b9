#include "statics/multigrid/constrained_unknowns.h"

namespace mesoslip::multigrid
{
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
                                         const Interpolation &interpolation)
  : rows(interpolation.coarse_y.n_nodes())
{
  const AxisCoarsening &x = interpolation.x;
  const unsigned int n    = interpolation.coarse_x.n_nodes();
  for (unsigned int J = 0; J < rows.size(); ++J)
    {
      unsigned int I = 0;
      for (const Node &node : fine.rows[interpolation.y.start(J)])
        {
          while (I < n && x.start(I) < node.column)
            ++I;
          if (I < n && x.start(I) == node.column)
            rows[J].push_back({I, node.bits});
        }
    }
}
} // namespace mesoslip::multigrid
