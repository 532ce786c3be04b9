// The kernels of the multigrid for one instruction set, and their table. Compiled once
// for each set, see kernel_variants.h.
#include "elasticity/kernel_variants.h"
#include "statics/multigrid/kernels/kernels.h"

namespace mesoslip::multigrid::MESOSLIP_VARIANT
{
#include "statics/multigrid/kernels/kernels_impl.h"
//
#include "statics/multigrid/kernels/line_kernels_impl.h"
//
#include "statics/multigrid/kernels/galerkin_impl.h"

template <typename Number>
static GridKernels<Number> grid_kernels_of()
{
  return {stencil_residual<Number>,
          {eliminate<2, Number>, eliminate<3, Number>},
          {substitute<2, Number>, substitute<3, Number>},
          {solve_tile<2, Number>, solve_tile<3, Number>},
          load_tile<Number>,
          add_tile<Number>,
          split<Number>,
          merge<Number>,
          {restrict_row<2, Number>, restrict_row<3, Number>},
          {prolongate_row<2, Number>, prolongate_row<3, Number>},
          direction<Number>,
          scaled<Number>,
          two_dots<Number>,
          subtract_from<Number>};
}

const Kernels &kernels()
{
  static const Kernels table = {grid_kernels_of<float>(),
                                grid_kernels_of<double>(),
                                galerkin_finest,
                                galerkin_coarse,
                                dense,
                                dot,
                                step};
  return table;
}
} // namespace mesoslip::multigrid::MESOSLIP_VARIANT
