#ifndef mesoslip_statics_multigrid_galerkin_h
#define mesoslip_statics_multigrid_galerkin_h

#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"
#include "statics/multigrid/axis.h"
#include "statics/multigrid/interpolation.h"
#include "statics/multigrid/stencil.h"

#include <array>
#include <vector>

namespace mesoslip::multigrid
{
/**
 * Computes the operators P^T A P of all coarse grids in one sweep over the finest grid,
 * cell by cell. As soon as the cell rows are there that make a row of the next coarser
 * grid, that row follows, so no more than two rows of cell matrices are kept a grid.
 *
 * In double precision: a smooth displacement of a large grid has next to no energy, less
 * than the round-off of single precision where a phase is much stiffer than another.
 */
class Galerkin
{
public:
  /** interpolations[l] lies between grids l and l + 1, constrained[l] is of grid l. */
  Galerkin(const UniformMaterial &material,
           const std::vector<Interpolation> &interpolations,
           const std::vector<ConstrainedUnknowns> &constrained);

  /** Fills @p first, the operator of grid 1, and rest[l - 2], the operator of grid l. */
  template <typename Number>
  void compute(Stencil<Number> &first, std::vector<Stencil<double>> &rest);

private:
  void finest_row(const unsigned int J, NodalField<double> &matrices);
  void set_coefficients(const unsigned int I0, const unsigned int J);
  void set_free_nodes(const unsigned int I0, const unsigned int J);
  void
  coarse_row(const unsigned int l, const unsigned int J, NodalField<double> &matrices);
  const UniformMaterial &material;
  const std::vector<Interpolation> &interpolations;
  const std::vector<ConstrainedUnknowns> &constrained;

  /** By phase; d11 etc. and hourglass. */
  std::vector<std::array<double, n_finest_coefficients>> coefficients;
  double cell_height;

  FinestPatch finest = {};
  CoarsePatch coarse = {};

  /** rows[l][b]: matrices of row b of the current pair of cell rows of grid l. */
  std::vector<std::array<NodalField<double>, 2>> rows;
};
} // namespace mesoslip::multigrid

#endif
