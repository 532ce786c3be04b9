#ifndef mesoslip_contact_laws_free_gap_h
#define mesoslip_contact_laws_free_gap_h

#include "dynamics/stepper.h"
#include "dynamics/surface_condition.h"

#include <cstddef>

namespace mesoslip
{
/**
 * Gap (m) at which node @p i of @p surface would end the step without contact, computed
 * as in the contact kernel; @p gap is the gap of the undeformed node after the step (m).
 */
template <int dim>
double free_gap(const SurfaceView<dim> &surface,
                const double gap,
                const std::size_t i,
                const StepParameters &step)
{
  const double c = (0.5 + step.beta2) * step.dt * step.dt,
               a = -surface.force[dim - 1][i] * surface.inverse_mass[dim - 1][i];
  return gap + surface.u[dim - 1][i] + step.dt * surface.w[dim - 1][i] + c * a;
}
} // namespace mesoslip

#endif
