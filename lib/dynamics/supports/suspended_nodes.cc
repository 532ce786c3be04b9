#include "dynamics/supports/suspended_nodes.h"

#include <Eigen/LU>

#include <cassert>

namespace mesoslip
{
template <int dim>
SuspendedNodes<dim>::SuspendedNodes(const Suspension &suspension,
                                    const StepParameters &step,
                                    const SideNodes &nodes,
                                    const std::vector<bool> &counted)
  : suspension(suspension)
  , step(step)
  , nodes(nodes)
  , counted(counted.empty() ? std::vector<bool>(nodes.area.size(), true) : counted)
  , stiffness(Vector::Map(suspension.stiffness.data()))
  , mobilities(nodes.area.size(), Matrix::Zero())
  , implicit(nodes.area.size(), Matrix::Zero())
  , ledger(nodes.area.size())
{
  assert(!suspension.absorbing || nodes.impedance.size() == std::size_t{dim} * dim);
  for (std::size_t k = 0; k < nodes.area.size(); ++k)
    {
      Matrix Z = Vector::Map(suspension.dashpot.data()).asDiagonal();
      for (unsigned int r = 0; r < dim && suspension.absorbing; ++r)
        for (unsigned int c = 0; c < dim; ++c)
          Z(r, c) += nodes.impedance[dim * r + c][k];
      dashpots.push_back(nodes.area[k] * Z);
    }
  const Traction &traction = suspension.traction;
  for (std::size_t k = 0; k < nodes.area.size() && traction.is_there(); ++k)
    {
      Vector &here = lasting.emplace_back(Vector::Zero());
      for (unsigned int c = 0; c < dim; ++c)
        if (!traction.varies_in_time(c))
          here[c] = traction(c, nodes.place_of(k), 0.);
    }
}

template <int dim>
SuspensionLoad<dim> SuspendedNodes<dim>::load_at(const double time,
                                                 const double pressure) const
{
  SuspensionLoad<dim> load = {time, pressure, {suspension, time, step.dt}, {}};
  const Traction &traction = suspension.traction;
  for (unsigned int c = 0; c < dim; ++c)
    if (traction.varies_in_time(c) && !traction.varies_in_place(c))
      load.traction[c] = traction(c, {}, time);
  return load;
}

/** Force of pressure and traction (N, in 2D N/m). */
template <int dim>
typename SuspendedNodes<dim>::Vector
SuspendedNodes<dim>::push_on(const unsigned int k, const SuspensionLoad<dim> &load) const
{
  const Traction &traction = suspension.traction;
  Vector force;
  for (unsigned int c = 0; c < dim; ++c)
    {
      force[c] = load.pressure * nodes.push_of(k, c);
      if (!traction.acts(c))
        continue;
      const bool is_local = traction.varies_in_time(c) && traction.varies_in_place(c);
      force[c] += nodes.area[k] * (is_local ? traction(c, nodes.place_of(k), load.time)
                                            : lasting[k][c] + load.traction[c]);
    }
  return force;
}

/**
 * theta of component @p c of a node with this @p mass, including the suspension (kg, in
 * 2D kg/m).
 */
template <int dim>
double SuspendedNodes<dim>::theta(const unsigned int k,
                                  const unsigned int c,
                                  const double mass) const
{
  return dashpot_theta(step.dt * dashpots[k](c, c) / mass);
}

template <int dim>
void SuspendedNodes<dim>::start(const unsigned int k,
                                const SurfaceView<dim> &surface,
                                const unsigned int i)
{
  // Constrained components move neither by themselves nor by dashpots of other
  // components.
  const double more = mass(k) * step.inertia();
  Matrix inertia    = Matrix::Identity();
  implicit[k]       = dashpots[k];
  for (unsigned int c = 0; c < dim; ++c)
    if (const double inverse = surface.inverse_mass[c][i]; inverse > 0.)
      {
        implicit[k].col(c) *= theta(k, c, 1. / inverse + more);
        inertia(c, c) = 1. / inverse + more;
      }
    else
      {
        implicit[k].row(c).setZero();
        implicit[k].col(c).setZero();
      }
  inertia += step.dt * implicit[k];
  mobilities[k] = inertia.inverse();
  for (unsigned int c = 0; c < dim; ++c)
    if (!(surface.inverse_mass[c][i] > 0.))
      mobilities[k](c, c) = 0.;
  start_guest(k, surface, i);
}

template <int dim>
double SuspendedNodes<dim>::guest_mass(const unsigned int k,
                                       const unsigned int c,
                                       const double inertia)
{
  const double more = mass(k) * step.inertia();
  dashpots[k]       = Matrix(dashpots[k].diagonal().asDiagonal());
  implicit[k](c, c) = dashpots[k](c, c) * theta(k, c, inertia + more);
  return more + step.dt * implicit[k](c, c);
}

template <int dim>
void SuspendedNodes<dim>::start_guest(const unsigned int k,
                                      const SurfaceView<dim> &surface,
                                      const unsigned int i)
{
  if (!counted[k])
    return;
  const FarEnd<dim> far(suspension, surface.time, step.dt);
  Ledger &energy = ledger[k];
  for (unsigned int c = 0; c < dim; ++c)
    {
      const double w = surface.w[c][i], u = surface.u[c][i];
      energy.kinetic += 0.5 * mass(k) * w * w;
      energy.at_start += 0.5 * nodes.area[k] * stiffness[c] * (u - far.now[c]) *
                         (u - step.dt * w - far.before[c]);
    }
  energy.at_start += energy.kinetic;
}

template <int dim>
typename SuspendedNodes<dim>::Vector
SuspendedNodes<dim>::force(const unsigned int k,
                           const SurfaceView<dim> &surface,
                           const unsigned int i,
                           const SuspensionLoad<dim> &load) const
{
  Vector slid, f = push_on(k, load);
  for (unsigned int c = 0; c < dim; ++c)
    {
      const double w = surface.w[c][i];
      slid[c]        = w - load.far.velocity[c];
      f[c] += mass(k) * (step.acceleration[c] - step.common_alpha() * w) -
              nodes.area[k] * stiffness[c] * (surface.u[c][i] - load.far.now[c]);
    }
  return f - dashpots[k] * slid;
}

template <int dim>
typename SuspendedNodes<dim>::Vector
SuspendedNodes<dim>::advance(const unsigned int k,
                             const SurfaceView<dim> &surface,
                             const unsigned int i,
                             const SuspensionLoad<dim> &load,
                             std::array<std::vector<double>, dim> &increment)
{
  const double dt = step.dt, c_a = (step.beta2 - 0.5) * dt * dt;
  Vector all = force(k, surface, i, load);
  for (unsigned int c = 0; c < dim; ++c)
    all[c] -= surface.force[c][i];
  const Vector a = mobilities[k] * all;
  NodeStep<dim> moved;
  for (unsigned int c = 0; c < dim; ++c)
    {
      double &u = surface.u[c][i], &w = surface.w[c][i];
      moved.u_before[c] = u;
      moved.w_before[c] = w;
      w += dt * a[c];
      u += dt * w + c_a * a[c];
      moved.u_after[c] = u;
      moved.w_after[c] = w;
    }
  return account(k, moved, load, increment);
}

template <int dim>
typename SuspendedNodes<dim>::Vector
SuspendedNodes<dim>::account(const unsigned int k,
                             const NodeStep<dim> &moved,
                             const SuspensionLoad<dim> &load,
                             std::array<std::vector<double>, dim> &increment)
{
  const FarEnd<dim> &far = load.far;
  const double dt = step.dt, c_a = (step.beta2 - 0.5) * dt * dt, m = mass(k);
  Vector pull, slid, a;
  for (unsigned int c = 0; c < dim; ++c)
    {
      pull[c] = nodes.area[k] * stiffness[c] * (moved.u_before[c] - far.now[c]);
      slid[c] = moved.w_before[c] - far.velocity[c];
      a[c]    = (moved.w_after[c] - moved.w_before[c]) / dt;
    }
  const Vector drag   = dashpots[k] * slid + dt * implicit[k] * a,
               pushed = push_on(k, load);
  Ledger next         = ledger[k];
  next.stored = next.kinetic = 0.;
  double of_inertia          = 0.;
  for (unsigned int c = 0; c < dim; ++c)
    {
      const double w = moved.w_after[c], f = pull[c] + drag[c],
                   by      = moved.u_after[c] - moved.u_before[c],
                   central = 0.5 * (by + increment[c][k]),
                   push    = m * step.acceleration[c] + pushed[c];
      increment[c][k]      = by;
      next.work += push * central - f * far.moved(c);
      next.lost += drag[c] * (central - far.moved(c)) +
                   m * step.common_alpha() * 0.5 * (w + moved.w_before[c]) * central;
      next.stored += 0.5 * pull[c] * (moved.u_after[c] - far.after[c]);
      next.kinetic += 0.5 * m * w * w + 0.25 * c_a * m * a[c] * a[c];
      of_inertia += m * a[c] * central;
    }
  next.lost += of_inertia - (next.kinetic - ledger[k].kinetic);
  if (counted[k])
    ledger[k] = next;
  return pushed - pull - drag;
}

template <int dim>
SuspensionEnergies SuspendedNodes<dim>::energies() const
{
  SuspensionEnergies sum;
  for (const Ledger &node : ledger)
    sum += {node.stored + node.kinetic, node.at_start, node.lost};
  return sum;
}

template <int dim>
double SuspendedNodes<dim>::work() const
{
  double sum = 0.;
  for (const Ledger &node : ledger)
    sum += node.work;
  return sum;
}

template <int dim>
void SuspendedNodes<dim>::accelerate(const unsigned int k,
                                     const double mass,
                                     const double pressure,
                                     const std::array<double, dim> &velocity,
                                     std::array<double, dim> &acceleration) const
{
  const SuspensionLoad<dim> load = load_at(0., pressure);
  const FarEnd<dim> &far         = load.far;
  const Vector pushed            = push_on(k, load);
  const Matrix Z                 = dashpots[k];
  const double other = this->mass(k), m = mass + other;
  Vector slid, f;
  for (unsigned int c = 0; c < dim; ++c)
    {
      slid[c] = (velocity[c] - far.velocity[c]) * dashpot_at_start(step.dt * Z(c, c) / m);
      f[c]    = mass * acceleration[c] + other * step.acceleration[c] + pushed[c] +
             nodes.area[k] * stiffness[c] * far.now[c];
    }
  Vector::Map(acceleration.data()) = (f - Z * slid) / m;
}

template class SuspendedNodes<2>;
template class SuspendedNodes<3>;
} // namespace mesoslip
