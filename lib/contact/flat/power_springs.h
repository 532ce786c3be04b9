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
 * Contact nodes on springs whose pressure is a power of their depth. With F the force of a node's spring at the depth h
 * and W its integral, the force of a step is
 *
 *     f = [W(h_(n+1)) - W(h_(n-1))] / [h_(n+1) - h_(n-1)] + (1 - phi)/2 [F(h_(n+1)) - F(h_(n-1))]
 *
 * but not less than 0, with phi of ContactFunction for the stiffness at the largest of the known depths and that
 * without a force: of a linear spring the same. It stores (W(h_(n+1)) + W(h_n)) / 2 and takes (1 - phi)/4 [F(h_(n+1)) - F(h_(n-1))] [h_(n+1) - h_(n-1)] >= 0 for good.
 */
template <int dim>
class PowerSprings
{
public:
  /** Of nodes with these @p areas (m^2, in 2D m), of which the first @p n_owned count for energies. */
  PowerSprings(const PowerSpring &spring,
               const std::vector<double> &areas,
               const unsigned int n_owned,
               const StepParameters &step);

  /** Sets ContactArrays::pressing for the step that begins with @p surface. */
  void press(const SurfaceView<dim> &surface, const ContactArrays &contact);

  /** After the step of the nodes: adds what is stored, and what that is more than before to what impacts took. */
  void add_energies(const SurfaceView<dim> &surface,
                    const ContactArrays &contact,
                    ContactSums &sums) const;

  /** Stored before the first step, the increments of the step before it being known (J, in 2D J/m). */
  double stored_at_start(const SurfaceView<dim> &surface,
                         const ContactArrays &contact) const;

private:
  /** Of a node that would end at @p gap < 0 without force; @p yields is what a unit force moves it in the step. */
  double force(const double area,
               const double gap,
               const double now,
               const double before,
               const double yields) const;

  const PowerSpring spring;
  const std::vector<double> areas;
  const unsigned int n_owned;
  const StepParameters step;
  std::vector<double> earlier; ///< depths a step ago (m)
};
} // namespace mesoslip

#endif
