#ifndef mesoslip_contact_node_loads_h
#define mesoslip_contact_node_loads_h

#include "contact/contact_surface.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/**
 * Slip of each node in a step (m): increment of the flat minus the central increment of
 * the node, (u_(n+1) - u_(n-1)) / 2. Slip times tangential force is the energy that the
 * node dissipates in this step, as in the energy balance.
 */
template <int dim>
class NodeSlip
{
public:
  /** Slip of the nodes of @p contact, which must outlive it. */
  explicit NodeSlip(const ContactSurface<dim> &contact)
    : contact(contact)
  {
  }

  /** Call before a step. */
  void before();

  /** Call after a step that begins at @p time (s). */
  void after(const double time)
  {
    flat = contact.central_flat_increment(time);
  }

  /** After a step: slip of node @p i along x (@p component 0) or, in 3D, y (1) (m). */
  double operator()(const unsigned int component, const unsigned int i) const
  {
    return flat[component] -
           0.5 * (contact.increment(component)[i] + increment_before[component][i]);
  }

private:
  const ContactSurface<dim> &contact;
  std::array<std::vector<double>, dim - 1> increment_before;
  std::array<double, 2> flat = {};
};

/** Sums the load of each contact node of this rank in every step. */
template <int dim>
class NodeLoadObserver : public ContactObserver<dim>
{
public:
  /** Observes @p contact, which must outlive it. */
  explicit NodeLoadObserver(const ContactSurface<dim> &contact)
    : slip(contact)
  {
  }

  bool wants(const std::uint64_t) const override
  {
    return true;
  }
  void before(const SurfaceView<dim> &) override
  {
    slip.before();
  }
  void after(const SurfaceView<dim> &surface, ContactSurface<dim> &contact) override;

  /** Loads since the start; empty before the first step. */
  const NodeLoads &loads() const
  {
    return sums;
  }

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &sums;
  }

private:
  NodeSlip<dim> slip;
  NodeLoads sums;
};
} // namespace mesoslip

#endif
