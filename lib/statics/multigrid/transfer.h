#ifndef mesoslip_statics_multigrid_transfer_h
#define mesoslip_statics_multigrid_transfer_h

#include "grid/nodal_field.h"
#include "statics/multigrid/interpolation.h"
#include "statics/multigrid/kernels/kernels.h"

#include <algorithm>

namespace mesoslip::multigrid
{
/** Applies an Interpolation P and its transpose to fields, row by row. */
template <typename Number>
class Transfer
{
public:
  Transfer() = default;

  /** @p interpolation must outlive this object. */
  explicit Transfer(const Interpolation &interpolation)
    : p(&interpolation)
    , n_vectors(whole_vectors<Number>(interpolation.x.n_coarse_cells() + 1))
    , distances(interpolation.x.n_coarse_cells() + 1, 1, 2)
    , weights(interpolation.x.n_coarse_cells() + 1, 1, 3)
    , even(weights)
    , odd(weights)
  {
    for (unsigned int I = 0; I < p->x.n_coarse_cells(); ++I)
      for (unsigned int side = 0; side < 2; ++side)
        distances.row(side, 0)[I] = static_cast<Number>(p->x_distance[I][side]);
  }

  /**
   * coarse = P^T fine, with 2 or 3 components per fine node. Periodic copies in @p fine
   * are not read.
   */
  template <int n_components>
  void restrict_to(const NodalField<Number> &fine, NodalField<Number> &coarse) const
  {
    const auto restrict_row = grid_kernels<Number>().restrict_row[n_components - 2];
    const Number *e[]       = {even.row(0, 0), even.row(1, 0), even.row(2, 0)},
                 *o[]       = {odd.row(0, 0), odd.row(1, 0), odd.row(2, 0)};
    const auto add          = [&](const TransferRow<Number> &row, const unsigned int J) {
      Number *to[3] = {coarse.row(0, J), coarse.row(1, J), coarse.row(2, J)};
      restrict_row(n_vectors, row, e, o, to);
    };

    const unsigned int n_rows = p->coarse_y.n_nodes();
    coarse.set_zero();
    for (unsigned int J = 0; J < n_rows; ++J)
      {
        for (unsigned int c = 0; c < n_components; ++c)
          split(fine.row(c, p->y.start(J)), c);
        add(at_node(J), J);
        if (J == p->y.n_coarse_cells() || !p->y.has_middle(J))
          continue;
        for (unsigned int c = 0; c < n_components; ++c)
          split(fine.row(c, p->y.start(J) + 1), c);
        add(to_lower(J), J);
        add(to_upper(J), (J + 1) % n_rows);
      }
    if (p->coarse_x.periodic)
      for (unsigned int J = 0; J < n_rows; ++J)
        for (unsigned int c = 0; c < 3; ++c)
          {
            Number *row = coarse.row(c, J);
            row[0] += row[coarse.n_columns()];
            row[coarse.n_columns()] = 0;
          }
  }

  /** fine += P coarse, without periodic copies; fills the ghosts of @p coarse. */
  template <int n_components>
  void prolongate_from(NodalField<Number> &coarse, NodalField<Number> &fine) const
  {
    const auto prolongate_row = grid_kernels<Number>().prolongate_row[n_components - 2];
    coarse.fill_ghosts(p->coarse_x.periodic, p->coarse_y.periodic);
    Number *e[]    = {even.row(0, 0), even.row(1, 0), even.row(2, 0)},
           *o[]    = {odd.row(0, 0), odd.row(1, 0), odd.row(2, 0)};
    const auto get = [&](const TransferRow<Number> &row, const bool add,
                         const unsigned int J) {
      const Number *from[3] = {coarse.row(0, J), coarse.row(1, J), coarse.row(2, J)};
      prolongate_row(n_vectors, row, add, from, e, o);
    };
    const auto merge_row = [&](const unsigned int j) {
      for (unsigned int c = 0; c < n_components; ++c)
        merge(fine.row(c, j), c);
    };

    for (unsigned int J = 0; J < p->coarse_y.n_nodes(); ++J)
      {
        get(at_node(J), false, J);
        merge_row(p->y.start(J));
        if (J == p->y.n_coarse_cells() || !p->y.has_middle(J))
          continue;
        get(to_lower(J), false, J);
        get(to_upper(J), true, J + 1);
        merge_row(p->y.start(J) + 1);
      }
  }

private:
  void split(const Number *row, const unsigned int component) const
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
    // A prolongation may have left values beyond the end.
    std::fill(e + m + 1, e + n_vectors, Number(0));
    std::fill(o + m, o + n_vectors, Number(0));
  }

  void merge(Number *row, const unsigned int component) const
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

  /** Transfer to the fine row at coarse node row J; below, to the middle row of cell row
   * J from below and above. */
  TransferRow<Number> at_node(const unsigned int J) const
  {
    const float *left = p->left.row(0, J);
    return row_of_weights(
      0., [](unsigned int) { return Number(1); },
      [=](const unsigned int I) { return Number(left[I]); },
      [=](const unsigned int I) { return 1 - Number(left[I]); });
  }

  TransferRow<Number> to_lower(const unsigned int J) const
  {
    const float *lower = p->lower.row(0, J), *left = p->corners.row(0, J),
                *right  = p->corners.row(1, J);
    const auto as_it_is = [](const float *weight) {
      return [=](const unsigned int I) { return Number(weight[I]); };
    };
    return row_of_weights(p->y_distance[J][0], as_it_is(lower), as_it_is(left),
                          as_it_is(right));
  }

  TransferRow<Number> to_upper(const unsigned int J) const
  {
    const float *lower = p->lower.row(0, J), *c0 = p->corners.row(0, J),
                *c1 = p->corners.row(1, J), *c2 = p->corners.row(2, J);
    return row_of_weights(
      -p->y_distance[J][1], [=](const unsigned int I) { return 1 - Number(lower[I]); },
      [=](const unsigned int I) { return Number(c2[I]); },
      // The same rounding as in Interpolation::fill_patch().
      [=](const unsigned int I) {
        return 1 - Number(c0[I]) - Number(c1[I]) - Number(c2[I]);
      });
  }

  /** A row with even(I), left(I) and right(I), the weights of coarse nodes I, I and I +
   * 1. */
  template <typename Even, typename Left, typename Right>
  TransferRow<Number> row_of_weights(const double dy,
                                     const Even &even_weight,
                                     const Left &left,
                                     const Right &right) const
  {
    Number *w = weights.row(0, 0), *l = weights.row(1, 0), *r = weights.row(2, 0);
    const unsigned int m = p->x.n_coarse_cells();
    for (unsigned int I = 0; I < m; ++I)
      {
        w[I] = even_weight(I);
        l[I] = left(I);
        r[I] = right(I);
      }
    w[m] = even_weight(m);
    return {w, l, r, distances.row(0, 0), distances.row(1, 0), static_cast<Number>(dy)};
  }

  const Interpolation *p = nullptr;
  unsigned int n_vectors = 0;
  NodalField<Number> distances;
  mutable NodalField<Number> weights, even, odd;
};
} // namespace mesoslip::multigrid

#endif
