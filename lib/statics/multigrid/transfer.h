#ifndef mesoslip_statics_multigrid_transfer_h
#define mesoslip_statics_multigrid_transfer_h

#include "grid/nodal_field.h"
#include "statics/multigrid/interpolation.h"
#include "statics/multigrid/kernels/kernels.h"

namespace mesoslip::multigrid
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
   * coarse = P^T fine, a fine node having 2 or 3 components. The duplicate column and row
   * that @p fine may have at periodic sides are not read.
   */
  template <int n_components>
  void restrict_to(const NodalField<Number> &fine, NodalField<Number> &coarse) const;

  /** fine += P coarse, duplicates left alone; fills the ghosts of @p coarse. */
  template <int n_components>
  void prolongate_from(NodalField<Number> &coarse, NodalField<Number> &fine) const;

private:
  void split(const Number *row, const unsigned int component) const;
  void merge(Number *row, const unsigned int component) const;
  /** Fine row at coarse node row J, middle row of cell row J from below and above. */
  TransferRow<Number> at_node(const unsigned int J) const;
  TransferRow<Number> to_lower(const unsigned int J) const;
  TransferRow<Number> to_upper(const unsigned int J) const;
  /** With even(I), left(I) and right(I), the weights of coarse nodes I, I and I + 1. */
  template <typename Even, typename Left, typename Right>
  TransferRow<Number> row_of_weights(const double dy,
                                     const Even &even,
                                     const Left &left,
                                     const Right &right) const;

  const Interpolation *p = nullptr;
  unsigned int n_vectors = 0;
  NodalField<Number> distances;
  mutable NodalField<Number> weights, even, odd;
};
} // namespace mesoslip::multigrid

#endif
