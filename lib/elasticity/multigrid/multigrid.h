#ifndef mesoslip_elasticity_multigrid_multigrid_h
#define mesoslip_elasticity_multigrid_multigrid_h

#include "elasticity/dof_mask.h"
#include "elasticity/multigrid/held_unknowns.h"
#include "elasticity/multigrid/interpolation.h"
#include "elasticity/multigrid/line_smoother.h"
#include "elasticity/multigrid/rigid_modes.h"
#include "elasticity/multigrid/stencil.h"
#include "elasticity/multigrid/transfer.h"
#include "elasticity/uniform_grid_operator.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"

#include <memory>
#include <vector>

namespace mesoslip
{
namespace multigrid
{
/**
 * A preconditioner for the stiffness of a uniform grid: one multigrid cycle in single
 * precision, symmetric and positive definite (on the complement of rigid motions).
 *
 * Finest grid matrix-free; coarse grids of rigid nodes (displacement and rotation) with
 * Galerkin operators; weights of interpolation that follow the stiffness; columns, then
 * rows as smoothers, backwards after the coarse grid; dense inverse at the bottom. Its
 * convergence depends little on size, cell shape and contrast (stiff fibres one cell
 * wide, soft inclusions). With strong contrast coarse grids are visited twice.
 */
class Multigrid
{
public:
  /** Both arguments must outlive this object, which still lacks set_held(). */
  Multigrid(const UniformMaterial &material, const UniformGridOperator &stiffness);

  /** Builds the operators for these held degrees of freedom; weights are kept. */
  void set_held(const DofMask &mask);

  /**
   * x = M^-1 b. Held unknowns of @p b must be zero, those of @p x become so. Duplicate
   * columns and rows of @p b are ignored, those of @p x are set.
   */
  void vmult(NodalField<float> &x, const NodalField<float> &b);

  unsigned int n_levels() const
  {
    return static_cast<unsigned int>(interpolations.size()) + 1;
  }

  const RigidModes &rigid_modes() const
  {
    return modes;
  }

private:
  struct Level
  {
    LineSmoother<3> smoother;
    PaddedRows<float> x, b, r;
  };

  void build_interpolations();
  void build_finest_smoother();
  void build_bottom();
  void finest_residual(const NodalField<float> &x, const NodalField<float> &b);
  void copy_duplicates(NodalField<float> &x) const;
  void visit(const unsigned int l);
  void sweep(const unsigned int l, const bool from_zero);
  void solve_bottom();

  const UniformMaterial &material;
  const UniformGridOperator &stiffness;
  Axis finest_x, finest_y;
  bool strong_contrast = false;

  std::vector<Interpolation> interpolations;
  std::vector<Transfer> transfers;
  std::vector<HeldUnknowns> held;
  RigidModes modes;
  LineSmoother<2> finest_smoother;
  NodalField<float> finest_r;
  std::vector<Stencil> stencils;
  std::vector<Level> levels;

  /** Inverse on the coarsest grid (all unknowns of a node together). */
  PaddedRows<float> bottom_inverse;
  PaddedRows<float> bottom_vectors;
};
} // namespace multigrid
} // namespace mesoslip

#endif
