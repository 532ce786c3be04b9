#ifndef mesoslip_localization_strain_side_integrals_h
#define mesoslip_localization_strain_side_integrals_h

#include "grid/cell_block.h"
#include "material/voigt.h"

namespace mesoslip
{
/**
 * Adds to sums [2][dim][dim] the contributions of the sides of the layers from @p begin
 * to @p end of a grid to the integral of du_c / dx_d (Gauss' theorem); the second half
 * is the compensation of round-off. @p u is the displacement of the nodes of the cells
 * @p known. Sums run layer by layer, so the result does not depend on the distribution
 * of layers over ranks.
 */
template <int dim>
void add_side_integrals(const UniformGrid<dim> &grid,
                        const CellBlock<dim> &known,
                        const double *u,
                        const unsigned int begin,
                        const unsigned int end,
                        double *sums);

/** The mean strain over a grid from the side sums of all its layers. */
template <int dim>
VoigtVector<dim> mean_strain(const UniformGrid<dim> &grid, const double *sums);
} // namespace mesoslip

#endif
