#ifndef mesoslip_contact_node_loads_h
#define mesoslip_contact_node_loads_h

#include "contact/contact_surface.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/**
 * By what the flat slides past each node in a step (m), with the central increment of the
 * node, (u_(n+1) - u_(n-1)) / 2: times the tangential force it is the energy that the node
 * dissipates in this step as the energy balance counts it.
 */
template <int dim>
class NodeSlip
{
public:
  /** Of the nodes of @p contact, which must outlive it. */
  explicit NodeSlip(const ContactSurface<dim> &contact)
    : contact(contact)
  {
  }

  /** Before a step. */
  void before();

  /** After a step from @p time (s) on. */
  void after(const double time)
  {
    flat = contact.central_flat_increment(time);
  }

  /** After a step: of node @p i along x (@p component 0) or, in 3D, y (1) (m). */
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

/** Sums up in every step what each node of the contact of this rank takes of the load. */
template <int dim>
class NodeLoadObserver : public ContactObserver<dim>
{
public:
  /** Of @p contact, which must outlive it. */
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

  /** Since the start; empty before the first step. */
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
