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
 * cell by cell. A row of the next coarser grid is computed as soon as its cell rows are
 * available, so each grid stores at most two rows of cell matrices.
 *
 * In double precision: a smooth displacement of a large grid has tiny energy, less than
 * the round-off of single precision if one phase is much stiffer than another.
 */
class Galerkin
{
public:
  /** interpolations[l] is between grids l and l + 1, constrained[l] belongs to grid l. */
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

  /** Per phase: d11 etc. and hourglass coefficients. */
  std::vector<std::array<double, n_finest_coefficients>> coefficients;
  double cell_height;

  FinestPatch finest = {};
  CoarsePatch coarse = {};

  /** rows[l][b]: matrices of row b of the current pair of cell rows of grid l. */
  std::vector<std::array<NodalField<double>, 2>> rows;
};
} // namespace mesoslip::multigrid

#endif
