#ifndef mesoslip_statics_multigrid_transfer_h
#define mesoslip_statics_multigrid_transfer_h

#include "grid/padded_rows.h"
#include "statics/multigrid/interpolation.h"
#include "statics/multigrid/kernels/kernels.h"

namespace mesoslip
{
namespace multigrid
{
/** Applies an Interpolation P and its transpose to fields, row by row. */
template <typename Number>
class Transfer
{
public:
  Transfer() = default;

  /** @p interpolation must outlive this object. */
  explicit Transfer(const Interpolation &interpolation);

  /**
   * coarse = P^T fine. The duplicate column and row that @p fine may have at periodic
   * sides are not read. Field: NodalField<Number> (2 components) or PaddedRows<Number>
   * (3).
   */
  template <int n_components, typename Field>
  void restrict_to(const Field &fine, PaddedRows<Number> &coarse) const;

  /** fine += P coarse, duplicates left alone; fills the ghosts of @p coarse. */
  template <int n_components, typename Field>
  void prolongate_from(PaddedRows<Number> &coarse, Field &fine) const;

private:
  void split(const Number *row, const unsigned int component) const;
  void merge(Number *row, const unsigned int component) const;

  /** Fine row at coarse node row J, middle row of cell row J from below and above. */
  TransferRow<Number> at_node(const unsigned int J) const;
  TransferRow<Number> to_lower(const unsigned int J) const;
  TransferRow<Number> to_upper(const unsigned int J) const;

  /** The weights of the row in question: even, odd_left, odd_right. */
  TransferRow<Number> row_of_weights(const double dy) const;

  const Interpolation *p = nullptr;
  unsigned int n_vectors = 0;
  PaddedRows<Number> distances;
  mutable PaddedRows<Number> weights;
  mutable PaddedRows<Number> even;
  mutable PaddedRows<Number> odd;
};

template <typename Number>
template <int n_components, typename Field>
void Transfer<Number>::restrict_to(const Field &fine, PaddedRows<Number> &coarse) const
{
  const auto restrict_row = grid_kernels<Number>().restrict_row[n_components - 2];
  const Number *e[3], *o[3];
  for (unsigned int c = 0; c < n_components; ++c)
    {
      e[c] = even.row(c, 0);
      o[c] = odd.row(c, 0);
    }
  const auto add = [&](const TransferRow<Number> &row, const unsigned int J) {
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

template <typename Number>
template <int n_components, typename Field>
void Transfer<Number>::prolongate_from(PaddedRows<Number> &coarse, Field &fine) const
{
  const auto prolongate_row = grid_kernels<Number>().prolongate_row[n_components - 2];
  coarse.fill_ghosts(p->coarse_x.periodic, p->coarse_y.periodic);
  Number *e[3], *o[3];
  for (unsigned int c = 0; c < n_components; ++c)
    {
      e[c] = even.row(c, 0);
      o[c] = odd.row(c, 0);
    }
  const auto get = [&](const TransferRow<Number> &row, const bool add,
                       const unsigned int J) {
    const Number *from[3] = {coarse.row(0, J), coarse.row(1, J), coarse.row(2, J)};
    prolongate_row(n_vectors, row, add, from, e, o);
  };
  for (unsigned int J = 0; J < p->coarse_y.n_nodes(); ++J)
    {
      get(at_node(J), false, J);
      for (unsigned int c = 0; c < n_components; ++c)
        merge(fine.row(c, p->y.start(J)), c);
      if (J == p->y.n_coarse_cells() || !p->y.has_middle(J))
        continue;
      get(to_lower(J), false, J);
      get(to_upper(J), true, J + 1);
      for (unsigned int c = 0; c < n_components; ++c)
        merge(fine.row(c, p->y.start(J) + 1), c);
    }
}

extern template class Transfer<float>;
extern template class Transfer<double>;
} // namespace multigrid
} // namespace mesoslip

#endif
