#include "contact/contact_surface.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace mesoslip
{
template <int dim>
ContactSurface<dim>::ContactSurface(const ContactSetup &setup, const StepParameters &step)
  : setup(setup)
  , step(step)
  , n_nodes(setup.friction_coefficient.size())
  , n_distinct(setup.periodic ? n_nodes - 1 : n_nodes)
  , values(n_nodes, n_columns_stored)
{
  const double infinity = std::numeric_limits<double>::infinity();
  std::fill_n(column(gap), values.stride(), infinity);
  std::fill_n(column(gap), n_distinct, setup.gap);
  std::copy(setup.friction_coefficient.begin(), setup.friction_coefficient.end(),
            column(friction_coefficient));
  const Relaxation relaxation(step.dt, setup.law.time);
  std::fill_n(column(decay), values.stride(), relaxation.decay);
  std::fill_n(column(lag), values.stride(), relaxation.lag);
}

template <int dim>
ContactArrays ContactSurface<dim>::arrays(const SurfaceView<dim> &surface)
{
  constexpr unsigned int x = 0, y = dim - 1;
  ContactArrays a;
  a.n = (n_nodes + contact_lanes - 1) / contact_lanes * contact_lanes;

  a.internal_x           = surface.force[x];
  a.internal_y           = surface.force[y];
  a.inverse_mass_x       = surface.inverse_mass[x];
  a.inverse_mass_y       = surface.inverse_mass[y];
  a.u_x                  = surface.u[x];
  a.u_y                  = surface.u[y];
  a.w_x                  = surface.w[x];
  a.w_y                  = surface.w[y];
  a.gap                  = column(gap);
  a.friction_coefficient = column(friction_coefficient);
  a.decay                = column(decay);
  a.lag                  = column(lag);
  a.increment_x          = column(increment_x);
  a.increment_y          = column(increment_y);
  a.tangential_force     = column(tangential);
  a.target               = column(target);
  a.touching             = column(touching);
  a.normal_force         = column(normal);
  a.sticking             = column(sticking);
  a.stick_count          = column(stick_count);
  a.slip_count           = column(slip_count);
  a.landing_count        = column(landing_count);
  return a;
}

template <int dim>
void ContactSurface<dim>::advance(const SurfaceView<dim> &surface)
{
  AssertDimension(surface.n, n_nodes);
  const double flat_velocity = setup.flat_velocity(surface.time);
  if (!started)
    initialize_increments(surface);
  if (setup.law.node_law)
    setup.law.node_law->update(
      {n_nodes, surface.w[0], flat_velocity}, step.dt,
      {column(friction_coefficient), column(decay), column(lag)});

  for (ContactObserver<dim> *observer : observers)
    if (observer->wants(surface.step))
      observer->before(surface);

  advance_nodes(arrays(surface), {step.dt, step.beta2, flat_velocity * step.dt}, last);

  if (setup.periodic)
    for (unsigned int c = 0; c < dim; ++c)
      {
        surface.u[c][n_nodes - 1] = surface.u[c][0];
        surface.w[c][n_nodes - 1] = surface.w[c][0];
      }

  total.friction += last.friction_energy;
  total.impact += last.impact_energy;
  total.flat += last.tangential_force * flat_velocity * step.dt;
  for (ContactObserver<dim> *observer : observers)
    if (observer->wants(surface.step))
      observer->after(surface, *this);
}

// The work of the first step needs the increment before it.
template <int dim>
void ContactSurface<dim>::initialize_increments(const SurfaceView<dim> &surface)
{
  for (unsigned int i = 0; i < n_nodes; ++i)
    {
      column(increment_x)[i] = step.dt * surface.w[0][i];
      column(increment_y)[i] = step.dt * surface.w[dim - 1][i];
    }
  started = true;
}

template <int dim>
NodeCounts ContactSurface<dim>::take_counts()
{
  const auto take = [&](const Column c) {
    const std::vector<float> counts(column(c), column(c) + n_nodes);
    std::fill_n(column(c), values.stride(), 0.);
    return counts;
  };
  NodeCounts counts;
  counts.stick    = take(stick_count);
  counts.slip     = take(slip_count);
  counts.landings = take(landing_count);
  return counts;
}

template class ContactSurface<2>;
} // namespace mesoslip
