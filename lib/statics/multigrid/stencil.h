#ifndef mesoslip_statics_multigrid_stencil_h
#define mesoslip_statics_multigrid_stencil_h

#include "grid/padded_rows.h"
#include "statics/multigrid/axis.h"
#include "statics/multigrid/held_unknowns.h"
#include "statics/multigrid/kernels/kernels.h"

#include <Eigen/Core>

namespace mesoslip
{
namespace multigrid
{
/**
 * The operator of a coarse grid as a symmetric 9-point stencil of 3x3 blocks, the
 * arrays of which are listed in StencilArray; one row of the arrays for each node row.
 * Single precision on the first coarse grid, double on the others.
 */
template <typename Number>
class Stencil
{
public:
  Stencil() = default;

  /** All entries zero. */
  Stencil(const Axis &x, const Axis &y);

  /** Adds the matrices of cell row @p j (n_cell_entries arrays of one row). */
  void add_cell_row(const unsigned int j, const PaddedRows<double> &matrices);

  /** After the last row: held and empty rows get a unit diagonal, ghosts are filled. */
  void finish(const HeldUnknowns &held);

  /** r = b - A x; fills the ghosts of @p x. Three components. */
  void residual(PaddedRows<Number> &x,
                const PaddedRows<Number> &b,
                PaddedRows<Number> &r) const;

  /** Array @p k of node row @p j. */
  const Number *row(const unsigned int k, const int j) const
  {
    return arrays.row(k, j);
  }

  /** Numbers from one array of a row to the next. */
  std::size_t array_stride() const
  {
    return arrays.array_stride();
  }

  /** The whole matrix; unknown 3 (j n_columns + i) + c. For small grids. */
  Eigen::MatrixXd dense() const;

private:
  bool periodic_x = false;
  bool periodic_y = false;
  PaddedRows<Number> arrays;
};

extern template class Stencil<float>;
extern template class Stencil<double>;
} // namespace multigrid
} // namespace mesoslip

#endif
