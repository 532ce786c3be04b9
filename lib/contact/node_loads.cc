#include "contact/node_loads.h"

namespace mesoslip
{
template <int dim>
void NodeSlip<dim>::before()
{
  for (unsigned int k = 0; k < dim - 1; ++k)
    increment_before[k].assign(contact.increment(k),
                               contact.increment(k) + contact.n_distinct_nodes());
}

template <int dim>
void NodeLoadObserver<dim>::after(const SurfaceView<dim> &surface,
                                  ContactSurface<dim> &contact)
{
  const unsigned int n = contact.n_distinct_nodes();
  sums.normal_force.resize(n);
  sums.friction_energy.resize(n);
  slip.after(surface.time);
  const double *normal = contact.normal_force(), *along = contact.tangential_force();
  for (unsigned int i = 0; i < n; ++i)
    {
      sums.normal_force[i] += normal[i];
      sums.friction_energy[i] += along[i] * slip(0, i);
    }
  if constexpr (dim == 3)
    for (unsigned int i = 0; i < n; ++i)
      sums.friction_energy[i] += contact.lateral_force()[i] * slip(1, i);
}

template class NodeSlip<2>;
template class NodeSlip<3>;
template class NodeLoadObserver<2>;
template class NodeLoadObserver<3>;
} // namespace mesoslip
