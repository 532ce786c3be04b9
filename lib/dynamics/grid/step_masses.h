#ifndef mesoslip_dynamics_grid_step_masses_h
#define mesoslip_dynamics_grid_step_masses_h

#include "dynamics/stepper.h"
#include "dynamics/supports/side_column.h"
#include "dynamics/surface_condition.h"
#include "elasticity/row_kernel.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"
#include "grid/row_partition.h"

#include <vector>

namespace mesoslip
{
/**
 * Masses in the forms a time step wants them. Inner rows get the kernel's factor
 * -dt / mass (times h/2, in which the kernel's forces lack): one row that stays in the
 * first cache when the density is uniform, else one for each node row. Internal to the
 * stepper.
 */
template <typename Number>
class StepMasses
{
public:
  /** Lumped masses of the rows of one rank, with what the time scheme makes of them. */
  StepMasses(const UniformMaterial &material,
             const NodeRows &rows,
             const StepParameters &parameters,
             const SideConstraints &sides,
             const UniformMaterial *damping = nullptr);

  /** Factors (and masses) of the stepping kernel for local node row @p l and above. */
  void set_inner(kernels::Rows<Number> &r, const unsigned int l) const;

  /** Adds the inertia of nodes at the ends of the bottom or @p top row. */
  void add_guests(const bool top, const std::vector<SideColumn *> &columns);

  /** Masses and inverse masses of the bottom or top row. */
  void set_boundary(kernels::Rows<Number> &r, SurfaceView<2> &view, const bool top) const;

private:
  /** Bottom and top row. */
  NodalField<double> inverse_boundary[2];
  NodalField<Number> mass_boundary[2];

  /** Inner rows. */
  NodalField<Number> factor, mass;
  bool one_row;
  bool has_mass;
  /** The factors of x and y are the same numbers. */
  bool equal_components;
};

extern template class StepMasses<double>;
extern template class StepMasses<float>;
} // namespace mesoslip

#endif
