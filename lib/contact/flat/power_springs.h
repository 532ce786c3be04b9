#ifndef mesoslip_contact_power_springs_h
#define mesoslip_contact_power_springs_h

#include "contact/contact_kernel.h"
#include "contact/laws/power_spring.h"
#include "dynamics/stepper.h"
#include "dynamics/surface_condition.h"

#include <vector>

namespace mesoslip
{
/**
 * Contact nodes on springs whose pressure is a power of their compression. With the force
 * F of a spring at compression h and its integral W, the force of a step is
 *
 *     f = [W(h_(n+1)) - W(h_(n-1))] / [h_(n+1) - h_(n-1)] + (1 - phi)/2 [F(h_(n+1)) - F(h_(n-1))]
 *
 * but not less than 0, with phi of ContactFunction for the stiffness at the largest of
 * the known compressions and the compression without a force. For a linear spring this is
 * the force of ContactFunction. The spring stores (W(h_(n+1)) + W(h_n)) / 2 and
 * dissipates (1 - phi)/4 [F(h_(n+1)) - F(h_(n-1))] [h_(n+1) - h_(n-1)] >= 0.
 */
template <int dim>
class PowerSprings
{
public:
  /**
   * Springs of nodes with these @p areas (m^2, in 2D m); the first @p n_owned nodes count
   * for energies.
   */
  PowerSprings(const PowerSpring &spring,
               const std::vector<double> &areas,
               const unsigned int n_owned,
               const StepParameters &step);

  /** Sets ContactArrays::pressing for the step that begins with @p surface. */
  void press(const SurfaceView<dim> &surface, const ContactArrays &contact);

  /**
   * Call after the step of the nodes: adds the stored energy to @p sums, and the energy
   * dissipated by normal forces.
   */
  void add_energies(const SurfaceView<dim> &surface,
                    const ContactArrays &contact,
                    ContactSums &sums) const;

  /**
   * Energy stored before the first step, given the increments of the previous step (J, in
   * 2D J/m).
   */
  double stored_at_start(const SurfaceView<dim> &surface,
                         const ContactArrays &contact) const;

private:
  /**
   * Force on a node that would end at @p gap < 0 without force; @p yields is its
   * displacement by a unit force in the step.
   */
  double force(const double area,
               const double gap,
               const double now,
               const double before,
               const double yields) const;

  const PowerSpring spring;
  const std::vector<double> areas;
  const unsigned int n_owned;
  const StepParameters step;
  std::vector<double> earlier; ///< compressions in the previous step (m)
};
} // namespace mesoslip

#endif
