#ifndef mesoslip_elasticity_multigrid_galerkin_h
#define mesoslip_elasticity_multigrid_galerkin_h

#include "elasticity/multigrid/held_unknowns.h"
#include "elasticity/multigrid/interpolation.h"
#include "elasticity/multigrid/padded_rows.h"
#include "elasticity/multigrid/stencil.h"
#include "elasticity/uniform_material.h"

#include <array>
#include <vector>

namespace mesoslip
{
namespace multigrid
{
/**
 * Computes the operators P^T A P of all coarse grids in one sweep over the finest grid,
 * cell by cell. As soon as the cell rows are there that make a row of the next coarser
 * grid, that row follows, so no more than two rows of cell matrices are kept a grid.
 */
class Galerkin
{
public:
  /** interpolations[l] lies between grids l and l + 1, held[l] is of grid l. */
  Galerkin(const UniformMaterial &material,
           const std::vector<Interpolation> &interpolations,
           const std::vector<HeldUnknowns> &held);

  /** Fills stencils[l], the operator of grid l, for l > 0; stencils[0] is left alone. */
  void compute(std::vector<Stencil> &stencils);

private:
  void finest_row(const unsigned int J, PaddedRows<float> &matrices);
  void set_coefficients(const unsigned int I0, const unsigned int J);
  void set_free_nodes(const unsigned int I0, const unsigned int J);
  void coarse_row(const unsigned int l, const unsigned int J, PaddedRows<float> &matrices);
  void finish_row(const unsigned int l,
                  const unsigned int J,
                  PaddedRows<float> &matrices,
                  std::vector<Stencil> &stencils);

  const UniformMaterial &material;
  const std::vector<Interpolation> &interpolations;
  const std::vector<HeldUnknowns> &held;

  /** By class; d11 etc. and hourglass. */
  std::vector<std::array<float, n_finest_coefficients>> coefficients;
  double cell_height;

  FinestPatch finest;
  CoarsePatch coarse;

  /** rows[l][b]: matrices of row b of the current pair of cell rows of grid l. */
  std::vector<std::array<PaddedRows<float>, 2>> rows;
};

/** Matrix of a cell of the finest grid: unknown 2 node + component, lengths in widths. */
Eigen::Matrix<double, 8, 8> finest_cell_matrix(const VoigtMatrix<2> &stiffness,
                                               const double cell_height);
} // namespace multigrid
} // namespace mesoslip

#endif
