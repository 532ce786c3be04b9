#ifndef mesoslip_statics_multigrid_multigrid_h
#define mesoslip_statics_multigrid_multigrid_h

#include "elasticity/dof_mask.h"
#include "elasticity/uniform_grid_operator.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"
#include "statics/multigrid/axis.h"
#include "statics/multigrid/interpolation.h"
#include "statics/multigrid/line_smoother.h"
#include "statics/multigrid/rigid_modes.h"
#include "statics/multigrid/stencil.h"
#include "statics/multigrid/transfer.h"

#include <memory>
#include <vector>

namespace mesoslip::multigrid
{
/**
 * A preconditioner for the stiffness of a uniform grid: one multigrid cycle, symmetric
 * and positive definite (on the complement of rigid motions).
 *
 * Finest grid matrix-free; coarse grids of rigid nodes (displacement and rotation) with
 * Galerkin operators; weights of interpolation that follow the stiffness; columns, then
 * rows as smoothers, backwards after the coarse grid; dense inverse at the bottom. Its
 * convergence depends little on size, cell shape and contrast (stiff fibres one cell
 * wide, soft inclusions).
 *
 * Symmetric and positive definite: LineSmoother has K <= 2 T, so each smoothing step
 * converges by itself; the coarse operators are P^T K P; so by induction from the dense
 * inverse at the bottom the error of every visit is a positive semidefinite operator, of
 * one or of two sweeps, and no eigenvalue of M^-1 K exceeds 1.
 *
 * Grids 0 and 1 work in the precision Number. Single precision takes two thirds of the
 * time; it is enough unless the smallest energies of the body (a slender strip that
 * bends, soft cells between stiff ones) are below 1e-7 of the largest: then round-off
 * makes M^-1 indefinite. The coarser grids, a sixteenth of the unknowns, always work in
 * double: with strong contrast they are visited twice, and the residual of the second
 * visit would drown.
 */
template <typename Number>
class Multigrid
{
public:
  /** Whether a grid has enough cells in one direction to be halved. */
  static bool can_coarsen(const UniformGrid<2> &grid);

  /** For a grid that can_coarsen(). Both arguments must outlive this object; call
   * set_constrained() before use. */
  Multigrid(const UniformMaterial &material, const UniformGridOperator &stiffness);

  /** Builds the operators for these constraints; interpolation weights are kept. */
  void set_constrained(const DofMask &mask);

  /**
   * x = M^-1 b. Constrained unknowns of @p b must be zero; those of @p x are set to
   * zero. Periodic copies in @p b are ignored; those in @p x are set.
   */
  void vmult(NodalField<Number> &x, const NodalField<Number> &b);

private:
  /** Data of a coarse grid. */
  template <typename T>
  struct Level
  {
    Level() = default;
    explicit Level(const Interpolation &from_finer)
      : x(from_finer.coarse_x.n_nodes(), from_finer.coarse_y.n_nodes(), 3)
      , b(x)
      , r(x)
    {
    }
    void set_stencil(Stencil<T> &&operator_of_level)
    {
      stencil = std::move(operator_of_level);
      smoother =
        LineSmoother<3, T>(x.n_columns(), x.n_rows(), [this](const unsigned int j) {
          return LineBlocks<T>{stencil.row(centre, j), stencil.row(east, j),
                               stencil.row(north, j), stencil.component_stride()};
        });
    }

    Stencil<T> stencil;
    LineSmoother<3, T> smoother;
    Transfer<T> to_coarse;
    NodalField<T> x, b, r;
  };

  void build_interpolations();
  void build_bottom(const DofMask &mask);
  void finest_residual(NodalField<Number> &x, const NodalField<Number> &b);
  void visit_first();
  void visit(const unsigned int l);
  template <typename T, typename Correct>
  void sweep(Level<T> &level, const bool from_zero, const Correct &correct);
  template <typename T>
  void solve_bottom(Level<T> &level);

  /** Number of the coarsest grid. */
  unsigned int bottom() const
  {
    return static_cast<unsigned int>(interpolations.size());
  }

  const UniformMaterial &material;
  const UniformGridOperator &stiffness;
  Axis finest_x, finest_y;
  bool strong_contrast = false;

  /** interpolations[l] is between grids l and l + 1. */
  std::vector<Interpolation> interpolations;
  /** constrained[l] belongs to grid l. */
  std::vector<ConstrainedUnknowns> constrained;

  LineSmoother<2, Number> finest_smoother;
  Transfer<Number> from_finest;
  NodalField<Number> finest_r;

  /** Data of grid 1. */
  Level<Number> first;
  /** Right-hand side and solution of grid 2 in the precision of grid 1. */
  NodalField<Number> interface;
  /** rest[l - 2] belongs to grid l. */
  std::vector<Level<double>> rest;

  /** Inverse on the coarsest grid (all unknowns of a node together). */
  NodalField<double> bottom_inverse;
  NodalField<double> bottom_vectors;
};

} // namespace mesoslip::multigrid

#endif
