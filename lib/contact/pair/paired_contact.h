#ifndef mesoslip_contact_pair_paired_contact_h
#define mesoslip_contact_pair_paired_contact_h

#include "contact/contact_surface.h"
#include "contact/pair/surface_values.h"

#include <functional>
#include <vector>

namespace mesoslip
{
/** The contact of a second body, whose nodes PairedContact moves. */
template <int dim>
struct PartnerSurface : SurfaceCondition<dim>
{
  /** Nodes with the numbers that their partners have in the contact of the first body. */
  NodesOfContact nodes;

  /** 1, or -1 for a body that is computed upside down: its own normal points away from the first one. */
  double normal = 1.;

  /** What moves the nodes. */
  std::function<void(const SurfaceView<dim> &)> meet;

  /** One step, within one of the first body. */
  void advance(const SurfaceView<dim> &surface) override
  {
    meet(surface);
  }
};

/** How the nodes of a contact that a rank has start along the normal. */
struct NormalStart
{
  std::vector<double> inverse_inertia; ///< 1/kg, in 2D m/kg; 0: held
  std::vector<double> acceleration;    ///< without contact (m/s^2)
  double velocity = 0.;                ///< of the whole body along the normal (m/s)
};

/**
 * Two bodies that meet node by node: the contact sees the motion of the first one relative to the second one, whose
 * nodes yield as well. A contact force f accelerates partners of the inertias m1 and m2 against each other by (1/m1 + 1/m2)
 * f, so that the forward-increment Lagrange multipliers of the rigid flat are those of the pair with this compliance. Partners
 * stay what they are, as displacements are small; the velocity of the flat is that of the second body along the first one.
 * Partners may be on different ranks, which tell each other the nodes of both contacts in each step.
 */
template <int dim>
class PairedContact : public SurfaceCondition<dim>
{
public:
  /** @p contact is of the @p nodes of the first body, @p partner of those of the second one, of which @p advance_partner makes
   * one step. Both must outlive this. Collective over the @p communicator of ranks that have them. */
  PairedContact(ContactSurface<dim> &contact,
                const NodesOfContact &nodes,
                PartnerSurface<dim> &partner,
                const std::function<void()> &advance_partner,
                const StepParameters &step,
                const MPI_Comm communicator);

  PairedContact(const PairedContact &)            = delete; ///< the partner refers to it
  PairedContact &operator=(const PairedContact &) = delete; ///< see the constructor

  /** One step of the nodes and of the second body. Collective. */
  void advance(const SurfaceView<dim> &surface) override;

  /** Partners that press on each other from the start get their common acceleration. Collective. */
  void start_as_one(NormalStart &own, NormalStart &other);

private:
  void meet(const SurfaceView<dim> &below);
  void take_relative(const SurfaceView<dim> &below);
  void share_forces();
  void move(const SurfaceView<dim> &surface,
            const NodesOfContact &of_surface,
            const unsigned int c,
            const double sign) const;
  double sign(const unsigned int c) const;

  ContactSurface<dim> &contact;
  const NodesOfContact nodes;
  PartnerSurface<dim> &partner;
  const std::function<void()> advance_partner;
  const StepParameters step;
  const SurfaceView<dim> *above = nullptr; ///< in the step under way
  SurfaceValues
    of_partner;         ///< u, w, force and inverse mass of the second body, by component
  SurfaceValues forces; ///< on the first body (N, in 2D N/m), by component

  /** Of the relative motion: displacement (m), velocity of the scheme (m/s), force without contact (N, in 2D N/m) and one over
   * the inertia (1/kg, in 2D m/kg), a column for each node. */
  NodalField<double> u, w, force, inverse_mass;
};
} // namespace mesoslip

#endif
