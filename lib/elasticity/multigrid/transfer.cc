#include "elasticity/multigrid/transfer.h"

#include <algorithm>

namespace mesoslip
{
namespace multigrid
{
Transfer::Transfer(const Interpolation &interpolation)
  : p(&interpolation)
  , n_vectors(whole_vectors<float>(interpolation.x.n_coarse_cells() + 1))
  , ones(1, 1, interpolation.x.n_coarse_cells() + 1)
  , complement(1, 1, interpolation.x.n_coarse_cells() + 1)
  , even(3, 1, interpolation.x.n_coarse_cells() + 1)
  , odd(3, 1, interpolation.x.n_coarse_cells() + 1)
{
  std::fill_n(ones.row(0, 0), interpolation.x.n_coarse_cells() + 1, 1.F);
}

void Transfer::split(const float *row, const unsigned int component) const
{
  const AxisCoarsening &x = p->x;
  const unsigned int m    = x.n_coarse_cells();
  float *e = even.row(component, 0), *o = odd.row(component, 0);
  const unsigned int regular = x.n_regular();
  kernels().split(regular, row, e, o);
  for (unsigned int I = regular; I < m; ++I)
    {
      e[I] = row[x.start(I)];
      o[I] = x.has_middle(I) ? row[x.start(I) + 1] : 0.F;
    }
  e[m] = p->coarse_x.periodic ? 0.F : row[x.start(m)];
}

void Transfer::merge(float *row, const unsigned int component) const
{
  const AxisCoarsening &x = p->x;
  const unsigned int m    = x.n_coarse_cells();
  const float *e = even.row(component, 0), *o = odd.row(component, 0);
  const unsigned int regular = x.n_regular();
  kernels().merge(regular, e, o, row);
  for (unsigned int I = regular; I < m; ++I)
    {
      row[x.start(I)] += e[I];
      if (x.has_middle(I))
        row[x.start(I) + 1] += o[I];
    }
  if (!p->coarse_x.periodic)
    row[x.start(m)] += e[m];
}

void Transfer::set_complement(const float *weights) const
{
  float *c = complement.row(0, 0);
  for (unsigned int i = 0; i <= p->x.n_coarse_cells(); ++i)
    c[i] = 1.F - weights[i];
}

TransferRow Transfer::at_node(const unsigned int J) const
{
  const float *left = p->left.row(0, static_cast<int>(J));
  set_complement(left);
  return {ones.row(0, 0),         left, complement.row(0, 0), p->x_distance.row(0, 0),
          p->x_distance.row(1, 0), 0.F};
}

TransferRow Transfer::to_lower(const unsigned int J) const
{
  const int j = static_cast<int>(J);
  return {p->lower.row(0, j),      p->corners.row(0, j),     p->corners.row(1, j),
          p->x_distance.row(0, 0), p->x_distance.row(1, 0), p->y_distance[J][0]};
}

TransferRow Transfer::to_upper(const unsigned int J) const
{
  const int j = static_cast<int>(J);
  set_complement(p->lower.row(0, j));
  return {complement.row(0, 0),    p->corners.row(2, j),     p->corners.row(3, j),
          p->x_distance.row(0, 0), p->x_distance.row(1, 0), -p->y_distance[J][1]};
}
} // namespace multigrid
} // namespace mesoslip
