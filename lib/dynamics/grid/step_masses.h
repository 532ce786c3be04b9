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
 * Masses in the formats of a time step. Inner rows have the factor -dt / mass of the
 * kernel, times h/2, which is missing in the forces of the kernel. With uniform density
 * it is one row, which stays in the first-level cache; otherwise one row per node row.
 * Internal to the stepper.
 */
template <typename Number>
class StepMasses
{
public:
  /** Lumped masses of the rows of one rank, combined with constants of the time scheme. */
  StepMasses(const UniformMaterial &material,
             const NodeRows &rows,
             const StepParameters &parameters,
             const SideConstraints &sides,
             const UniformMaterial *damping = nullptr);

  /** Sets the factors (and masses) of the stepping kernel for local node row @p l and
   * above. */
  void set_inner(kernels::Rows<Number> &r, const unsigned int l) const;

  /** Adds the guest masses of columns to the end nodes of the bottom or @p top row. */
  void add_guests(const bool top, const std::vector<SideColumn *> &columns);

  /** Sets masses and inverse masses of the bottom or top row. */
  void set_boundary(kernels::Rows<Number> &r, SurfaceView<2> &view, const bool top) const;

private:
  /** Bottom and top row. */
  NodalField<double> inverse_boundary[2];
  NodalField<Number> mass_boundary[2];

  /** Inner rows. */
  NodalField<Number> factor, mass;
  bool one_row;
  bool has_mass;
  /** Whether the factors of x and y are equal. */
  bool equal_components;
};

extern template class StepMasses<double>;
extern template class StepMasses<float>;
} // namespace mesoslip

#endif
