#ifndef mesoslip_contact_pair_paired_contact_h
#define mesoslip_contact_pair_paired_contact_h

#include "contact/contact_surface.h"

#include <array>
#include <functional>

namespace mesoslip
{
/** The contact of a second body, whose nodes are in the order of their partners; PairedContact moves them. The body is
 * computed upside down: its own normal points away from the first one. */
template <int dim>
struct PartnerSurface : SurfaceCondition<dim>
{
  /** What moves the nodes. */
  std::function<void(const SurfaceView<dim> &)> meet;

  /** One step, within one of the first body. */
  void advance(const SurfaceView<dim> &surface) override
  {
    meet(surface);
  }
};

/**
 * Two bodies that meet node by node: the contact sees the motion of the first one relative to the second one, whose
 * nodes yield as well. A contact force f accelerates partners of the inertias m1 and m2 against each other by (1/m1 + 1/m2)
 * f, so that the forward-increment Lagrange multipliers of the rigid flat are those of the pair with this compliance. Partners
 * stay what they are, as displacements are small; the velocity of the flat is that of the second body along the first one.
 */
template <int dim>
class PairedContact : public SurfaceCondition<dim>
{
public:
  /** @p contact is of the nodes of the first body, @p partner of those of the second one, of which @p advance_partner makes one
   * step. Both must outlive this; of a @p periodic contact the last node duplicates the first. */
  PairedContact(ContactSurface<dim> &contact,
                PartnerSurface<dim> &partner,
                const std::function<void()> &advance_partner,
                const StepParameters &step,
                const bool periodic);

  PairedContact(const PairedContact &)            = delete; ///< the partner refers to it
  PairedContact &operator=(const PairedContact &) = delete; ///< see the constructor

  /** One step of the nodes and of the second body. */
  void advance(const SurfaceView<dim> &surface) override;

private:
  void meet(const SurfaceView<dim> &below);
  void take_relative(const SurfaceView<dim> &below);
  void move(const SurfaceView<dim> &surface,
            const unsigned int c,
            const std::size_t i,
            const double f) const;

  ContactSurface<dim> &contact;
  const std::function<void()> advance_partner;
  const StepParameters step;
  const bool periodic;
  const SurfaceView<dim> *above = nullptr; ///< in the step under way

  /** Of the relative motion: displacement (m), velocity of the scheme (m/s), force without contact (N, in 2D N/m) and one over
   * the inertia (1/kg, in 2D m/kg), a column for each node. */
  NodalField<double> u, w, force, inverse_mass;
};
} // namespace mesoslip

#endif
