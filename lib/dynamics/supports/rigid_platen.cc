#include "dynamics/supports/rigid_platen.h"

#include "base/exchange.h"

#include <algorithm>

namespace mesoslip
{
template <int dim>
RigidPlaten<dim>::RigidPlaten(const SideSupport &support,
                              const std::array<bool, 3> &moves,
                              const StepParameters &step,
                              const SideNodes &nodes,
                              const unsigned int n_owned,
                              const MPI_Comm ranks)
  : support(support)
  , moves(moves)
  , step(step)
  , n_owned(n_owned)
  , ranks(ranks)
  , area(nodes.whole_area(n_owned))
  , whole_area(mpi::sum(area, ranks))
{
  const std::array<double, 3> push = nodes.whole_push(n_owned);
  for (unsigned int c = 0; c < dim; ++c)
    into[c] = mpi::sum(push[c], ranks);
  if (!(whole_area > 0.))
    return;
  for (double &component : into)
    component /= whole_area;
  mass = support.platen_mass * (area / whole_area);
}

template <int dim>
void RigidPlaten<dim>::start(const SurfaceView<dim> &surface)
{
  const Suspension &suspension = support.suspension;
  const FarEnd<dim> far(suspension, surface.time, step.dt);
  moving_mass.fill(mass);
  for (unsigned int c = 0; c < dim; ++c)
    {
      for (unsigned int i = 0; i < n_owned; ++i)
        if (surface.inverse_mass[c][i] > 0.)
          moving_mass[c] += 1. / surface.inverse_mass[c][i];
      moving_mass[c] = mpi::sum(moving_mass[c], ranks);
      if (surface.n == 0 || !moves[c])
        continue;
      w[c]           = surface.w[c][0];
      moved[c]       = step.dt * w[c];
      const double u = surface.u[c][0];
      kinetic += 0.5 * mass * w[c] * w[c];
      at_start += 0.5 * suspension.stiffness[c] * area * (u - far.now[c]) *
                  (u - moved[c] - far.before[c]);
    }
  at_start += kinetic;
  started = true;
}

template <int dim>
void RigidPlaten<dim>::advance(const SurfaceView<dim> &surface)
{
  if (!started)
    start(surface);
  if (surface.n == 0)
    return;
  const double pressure = support.pressure(surface.time), kinetic_before = kinetic;
  const FarEnd<dim> far(support.suspension, surface.time, step.dt);
  in_springs = kinetic = 0.;
  for (unsigned int c = 0; c < dim; ++c)
    if (moves[c])
      move(surface, c, pressure, far);
  lost -= kinetic - kinetic_before;
}

template <int dim>
void RigidPlaten<dim>::move(const SurfaceView<dim> &surface,
                            const unsigned int c,
                            const double pressure,
                            const FarEnd<dim> &far)
{
  const double k = support.suspension.stiffness[c], z = support.suspension.dashpot[c],
               of_body = surface.total_force != nullptr
                           ? surface.total_force[c]
                           : sum_of(surface.force[c], n_owned),
               dt = step.dt, c_a = (step.beta2 - 0.5) * dt * dt,
               pushed = into[c] * pressure;
  const double before = surface.u[c][0], w_before = surface.w[c][0],
               stretched = before - far.now[c],
               theta     = dashpot_theta(dt * z * whole_area / moving_mass[c]),
               a         = -((k * stretched - pushed + z * (w_before - far.velocity[c])) *
                       whole_area +
                     of_body) /
                   (moving_mass[c] + theta * dt * z * whole_area);
  w[c]           = w_before + dt * a;
  const double u = before + (dt * w[c] + c_a * a), by = u - before,
               central = 0.5 * (by + moved[c]),
               drag    = z * area * (w_before + theta * dt * a - far.velocity[c]),
               pull    = k * area * stretched + drag;
  moved[c]             = by;
  force[c]             = pushed * area - pull;
  total_work += pushed * area * central - pull * far.moved(c);
  in_springs += 0.5 * k * area * stretched * (u - far.after[c]);
  kinetic += 0.5 * mass * w[c] * w[c] + 0.25 * c_a * mass * a * a;
  lost += drag * (central - far.moved(c)) + mass * a * central;
  std::fill_n(surface.u[c], surface.n, u);
  std::fill_n(surface.w[c], surface.n, w[c]);
}

template <int dim>
double RigidPlaten<dim>::stop()
{
  double work = 0.;
  for (unsigned int c = 0; c < dim; ++c)
    work += 0.5 * mass * w[c] * ((step.beta2 - 0.5) * w[c] - moved[c] / step.dt);
  lost += kinetic + work;
  kinetic = 0.;
  w.fill(0.);
  return work;
}

template <int dim>
std::array<double, dim>
RigidPlaten<dim>::start_acceleration(const std::vector<NodeAtStart> &nodes,
                                     const std::array<double, 3> &velocity) const
{
  const Suspension &suspension = support.suspension;
  const FarEnd<dim> far(suspension, 0., step.dt);
  const double pressure = support.pressure(0.);
  const auto sum        = [&](const auto &of_node) {
    double values = 0.;
    for (unsigned int i = 0; i < n_owned; ++i)
      values += of_node(nodes[i]);
    return mpi::sum(values, ranks);
  };
  const double all =
    support.platen_mass + sum([](const NodeAtStart &node) { return node.mass; });
  std::array<double, dim> a = {};
  for (unsigned int c = 0; c < dim; ++c)
    {
      const double k = suspension.stiffness[c], z = suspension.dashpot[c],
                   share = dashpot_at_start(step.dt * z * whole_area / all),
                   load  = k * far.now[c] - share * z * (velocity[c] - far.velocity[c]) +
                          into[c] * pressure,
                   others = sum([c](const NodeAtStart &node) {
                     return node.mass * node.acceleration[c];
                   });
      if (moves[c])
        a[c] = (others + load * whole_area) / all;
    }
  return a;
}

template class RigidPlaten<2>;
template class RigidPlaten<3>;
} // namespace mesoslip
