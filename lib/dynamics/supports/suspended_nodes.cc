#include "dynamics/supports/suspended_nodes.h"

#include <Eigen/LU>

#include <cassert>

namespace mesoslip
{
template <int dim>
SuspendedNodes<dim>::SuspendedNodes(const Suspension &suspension,
                                    const StepParameters &step,
                                    const std::vector<double> &area,
                                    const std::vector<std::vector<double>> &impedance)
  : suspension(suspension)
  , step(step)
  , area(area)
  , impedance(impedance)
  , stiffness(Vector::Map(suspension.stiffness.data()))
  , mobilities(area.size(), Matrix::Zero())
  , theta(area.size(), Vector::Constant(0.5))
{
  assert(!suspension.absorbing || impedance.size() == std::size_t{dim} * dim);
}

/** Of the node, for its area (Pa s/m). */
template <int dim>
typename SuspendedNodes<dim>::Matrix
SuspendedNodes<dim>::dashpots_of(const unsigned int i) const
{
  Matrix Z = Vector::Map(suspension.dashpot.data()).asDiagonal();
  for (unsigned int r = 0; r < dim && suspension.absorbing; ++r)
    for (unsigned int c = 0; c < dim; ++c)
      Z(r, c) += impedance[dim * r + c][i];
  return Z;
}

/** z of component @p c of a node of this @p mass with that of the suspension (kg, in 2D kg/m). */
template <int dim>
double SuspendedNodes<dim>::stiffness_of_dashpot(const unsigned int i,
                                                 const unsigned int c,
                                                 const double mass) const
{
  return step.dt * area[i] * dashpots_of(i)(c, c) / mass;
}

template <int dim>
void SuspendedNodes<dim>::start(const SurfaceView<dim> &surface,
                                const unsigned int n_owned)
{
  const FarEnd<dim> far(suspension, surface.time, step.dt);
  for (unsigned int i = 0; i < surface.n; ++i)
    {
      // Held components move neither by themselves nor by the dashpots of others.
      const double more = suspension.mass * area[i] * step.inertia();
      for (unsigned int c = 0; c < dim; ++c)
        if (const double inverse = surface.inverse_mass[c][i]; inverse > 0.)
          theta[i][c] = dashpot_theta(stiffness_of_dashpot(i, c, 1. / inverse + more));
      Matrix inertia = step.dt * area[i] * dashpots_of(i) * theta[i].asDiagonal();
      for (unsigned int c = 0; c < dim; ++c)
        if (const double inverse = surface.inverse_mass[c][i]; inverse > 0.)
          inertia(c, c) += 1. / inverse + more;
        else
          {
            inertia.row(c).setZero();
            inertia.col(c).setZero();
            inertia(c, c) = 1.;
          }
      mobilities[i] = inertia.inverse();
      for (unsigned int c = 0; c < dim; ++c)
        if (!(surface.inverse_mass[c][i] > 0.))
          mobilities[i](c, c) = 0.;
      for (unsigned int c = 0; c < dim && i < n_owned; ++c)
        {
          const double w = surface.w[c][i], u = surface.u[c][i];
          kinetic += 0.5 * suspension.mass * area[i] * w * w;
          energy.at_start += 0.5 * area[i] * stiffness[c] * (u - far.now[c]) *
                             (u - step.dt * w - far.before[c]);
        }
    }
  energy.at_start += kinetic;
}

template <int dim>
SuspensionStep<dim>
SuspendedNodes<dim>::advance(const SurfaceView<dim> &surface,
                             const double pressure,
                             const unsigned int n_owned,
                             std::array<std::vector<double>, dim> &increment)
{
  const FarEnd<dim> far(suspension, surface.time, step.dt);
  const double dt = step.dt, c_a = (step.beta2 - 0.5) * dt * dt;
  SuspensionStep<dim> done;
  double stored = 0., kinetic_before = kinetic, of_inertia = 0.;
  kinetic = 0.;
  for (unsigned int i = 0; i < surface.n; ++i)
    {
      const double A = area[i], m = suspension.mass * A;
      const Matrix Z = A * dashpots_of(i);
      Vector stretched, slid, weight, force;
      for (unsigned int c = 0; c < dim; ++c)
        {
          const double w = surface.w[c][i];
          stretched[c]   = surface.u[c][i] - far.now[c];
          slid[c]        = w - far.velocity[c];
          weight[c]      = m * step.acceleration[c];
          force[c]       = weight[c] - m * step.alpha * w - surface.force[c][i];
        }
      force[dim - 1] -= pressure * A;
      const Vector pull = A * stiffness.cwiseProduct(stretched);
      const Vector a    = mobilities[i] * (force - pull - Z * slid);
      slid += dt * theta[i].cwiseProduct(a);
      const Vector drag = Z * slid;
      for (unsigned int c = 0; c < dim; ++c)
        {
          double &u = surface.u[c][i], &w = surface.w[c][i];
          const double w_mean = w + 0.5 * dt * a[c], u_before = u;
          w += dt * a[c];
          u += dt * w + c_a * a[c];
          const double moved = u - u_before, central = 0.5 * (moved + increment[c][i]);
          increment[c][i] = moved;
          if (i >= n_owned)
            continue;
          const double f = pull[c] + drag[c], load = c + 1 == dim ? pressure * A : 0.;
          done.force[c] -= f;
          done.work += (weight[c] - load) * central - f * far.moved(c);
          energy.lost +=
            drag[c] * (central - far.moved(c)) + m * step.alpha * w_mean * central;
          stored += 0.5 * pull[c] * (u - far.after[c]);
          kinetic += 0.5 * m * w * w + 0.25 * c_a * m * a[c] * a[c];
          of_inertia += m * a[c] * central;
        }
    }
  energy.lost += of_inertia - (kinetic - kinetic_before);
  energy.stored = stored + kinetic;
  return done;
}

template <int dim>
std::array<double, dim>
SuspendedNodes<dim>::start_acceleration(const unsigned int i,
                                        const double mass,
                                        const double pressure,
                                        const std::array<double, dim> &velocity) const
{
  const FarEnd<dim> far(suspension, 0., step.dt);
  Vector slid, force;
  const double m = mass + suspension.mass * area[i];
  for (unsigned int c = 0; c < dim; ++c)
    {
      slid[c] =
        (velocity[c] - far.velocity[c]) * dashpot_at_start(stiffness_of_dashpot(i, c, m));
      force[c] = m * step.acceleration[c] + area[i] * stiffness[c] * far.now[c];
    }
  force[dim - 1] -= pressure * area[i];
  force -= area[i] * dashpots_of(i) * slid;
  std::array<double, dim> a;
  Vector::Map(a.data()) = force / m;
  return a;
}

template class SuspendedNodes<2>;
template class SuspendedNodes<3>;
} // namespace mesoslip
