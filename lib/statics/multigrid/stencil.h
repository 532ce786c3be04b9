#ifndef mesoslip_statics_multigrid_stencil_h
#define mesoslip_statics_multigrid_stencil_h

#include "grid/nodal_field.h"
#include "statics/multigrid/axis.h"
#include "statics/multigrid/kernels/kernels.h"

#include <Eigen/Core>

namespace mesoslip::multigrid
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
  void add_cell_row(const unsigned int j, const NodalField<double> &matrices);

  /** After the last row: constrained and empty rows get a unit diagonal, ghosts are filled. */
  void finish(const ConstrainedUnknowns &constrained);

  /** r = b - A x; fills the ghosts of @p x. Three components. */
  void residual(NodalField<Number> &x,
                const NodalField<Number> &b,
                NodalField<Number> &r) const;

  /** Array @p k of node row @p j. */
  const Number *row(const unsigned int k, const int j) const
  {
    return arrays.row(k, j);
  }

  /** Numbers from one array of a row to the next. */
  std::size_t component_stride() const
  {
    return arrays.component_stride();
  }

  /** The whole matrix; unknown 3 (j n_columns + i) + c. For small grids. */
  Eigen::MatrixXd dense() const;

private:
  bool periodic_x = false;
  bool periodic_y = false;
  NodalField<Number> arrays;
};

extern template class Stencil<float>;
extern template class Stencil<double>;
} // namespace mesoslip::multigrid

#endif
