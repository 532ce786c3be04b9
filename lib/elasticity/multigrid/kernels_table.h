// The table of the kernels. Included inside a namespace by kernels_x86_64*.cc, last.

const Kernels &kernels()
{
  static const Kernels table = {stencil_residual,
                                {eliminate<2>, eliminate<3>},
                                {substitute<2>, substitute<3>},
                                {solve_tile<2>, solve_tile<3>},
                                load_tile,
                                add_tile,
                                split,
                                merge,
                                {restrict_row<2>, restrict_row<3>},
                                {prolongate_row<2>, prolongate_row<3>},
                                galerkin_finest,
                                galerkin_coarse,
                                dense,
                                dot,
                                step,
                                direction,
                                narrow,
                                two_dots,
                                subtract_from};
  return table;
}
