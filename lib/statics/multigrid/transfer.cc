#include "statics/multigrid/transfer.h"

#include <algorithm>

namespace mesoslip
{
namespace multigrid
{
template <typename Number>
Transfer<Number>::Transfer(const Interpolation &interpolation)
  : p(&interpolation)
  , n_vectors(whole_vectors<Number>(interpolation.x.n_coarse_cells() + 1))
  , distances(2, 1, interpolation.x.n_coarse_cells() + 1)
  , weights(3, 1, interpolation.x.n_coarse_cells() + 1)
  , even(3, 1, interpolation.x.n_coarse_cells() + 1)
  , odd(3, 1, interpolation.x.n_coarse_cells() + 1)
{
  for (unsigned int I = 0; I < p->x.n_coarse_cells(); ++I)
    for (unsigned int side = 0; side < 2; ++side)
      distances.row(side, 0)[I] = static_cast<Number>(p->x_distance[I][side]);
}

template <typename Number>
void Transfer<Number>::split(const Number *row, const unsigned int component) const
{
  const AxisCoarsening &x = p->x;
  const unsigned int m    = x.n_coarse_cells();
  Number *e = even.row(component, 0), *o = odd.row(component, 0);
  const unsigned int regular = x.n_regular();
  grid_kernels<Number>().split(regular, row, e, o);
  for (unsigned int I = regular; I < m; ++I)
    {
      e[I] = row[x.start(I)];
      o[I] = x.has_middle(I) ? row[x.start(I) + 1] : 0;
    }
  e[m] = p->coarse_x.periodic ? 0 : row[x.start(m)];
  // A prolongation may have left numbers beyond.
  std::fill(e + m + 1, e + n_vectors, Number(0));
  std::fill(o + m, o + n_vectors, Number(0));
}

template <typename Number>
void Transfer<Number>::merge(Number *row, const unsigned int component) const
{
  const AxisCoarsening &x = p->x;
  const unsigned int m    = x.n_coarse_cells();
  const Number *e = even.row(component, 0), *o = odd.row(component, 0);
  const unsigned int regular = x.n_regular();
  grid_kernels<Number>().merge(regular, e, o, row);
  for (unsigned int I = regular; I < m; ++I)
    {
      row[x.start(I)] += e[I];
      if (x.has_middle(I))
        row[x.start(I) + 1] += o[I];
    }
  if (!p->coarse_x.periodic)
    row[x.start(m)] += e[m];
}

template <typename Number>
TransferRow<Number> Transfer<Number>::row_of_weights(const double dy) const
{
  return {weights.row(0, 0),   weights.row(1, 0),   weights.row(2, 0),
          distances.row(0, 0), distances.row(1, 0), static_cast<Number>(dy)};
}

template <typename Number>
TransferRow<Number> Transfer<Number>::at_node(const unsigned int J) const
{
  const float *left = p->left.row(0, static_cast<int>(J));
  Number *w = weights.row(0, 0), *l = weights.row(1, 0), *r = weights.row(2, 0);
  const unsigned int m = p->x.n_coarse_cells();
  for (unsigned int I = 0; I < m; ++I)
    {
      w[I] = 1;
      l[I] = left[I];
      r[I] = 1 - l[I];
    }
  w[m] = 1;
  return row_of_weights(0.);
}

template <typename Number>
TransferRow<Number> Transfer<Number>::to_lower(const unsigned int J) const
{
  const int j        = static_cast<int>(J);
  const float *lower = p->lower.row(0, j), *left = p->corners.row(0, j),
              *right = p->corners.row(1, j);
  Number *w = weights.row(0, 0), *l = weights.row(1, 0), *r = weights.row(2, 0);
  const unsigned int m = p->x.n_coarse_cells();
  for (unsigned int I = 0; I < m; ++I)
    {
      w[I] = lower[I];
      l[I] = left[I];
      r[I] = right[I];
    }
  w[m] = lower[m];
  return row_of_weights(p->y_distance[J][0]);
}

template <typename Number>
TransferRow<Number> Transfer<Number>::to_upper(const unsigned int J) const
{
  const int j        = static_cast<int>(J);
  const float *lower = p->lower.row(0, j), *c0 = p->corners.row(0, j),
              *c1 = p->corners.row(1, j), *c2 = p->corners.row(2, j);
  Number *w = weights.row(0, 0), *l = weights.row(1, 0), *r = weights.row(2, 0);
  const unsigned int m = p->x.n_coarse_cells();
  for (unsigned int I = 0; I < m; ++I)
    {
      w[I] = 1 - static_cast<Number>(lower[I]);
      l[I] = c2[I];
      // The same rounding as in Interpolation::fill_patch().
      r[I] = 1 - static_cast<Number>(c0[I]) - static_cast<Number>(c1[I]) - l[I];
    }
  w[m] = 1 - static_cast<Number>(lower[m]);
  return row_of_weights(-p->y_distance[J][1]);
}

template class Transfer<float>;
template class Transfer<double>;
} // namespace multigrid
} // namespace mesoslip
