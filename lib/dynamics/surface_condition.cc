#include "dynamics/surface_condition.h"

namespace mesoslip
{
template <int dim>
FreeSurface<dim>::FreeSurface(const StepParameters &parameters)
  : dt(parameters.dt)
  , c_new(parameters.dt * (parameters.beta2 + 0.5))
  , c_old(-parameters.dt * (parameters.beta2 - 0.5))
{
}

template <int dim>
void FreeSurface<dim>::advance(const SurfaceView<dim> &surface)
{
  const auto move = [&](double *__restrict__ u, double *__restrict__ w,
                        const double *__restrict__ force,
                        const double *__restrict__ inverse_mass) {
    for (std::size_t i = 0; i < surface.n; ++i)
      {
        const double w_old = w[i];
        const double w_new = w_old - dt * inverse_mass[i] * force[i];
        w[i]               = w_new;
        u[i] += c_new * w_new + c_old * w_old;
      }
  };
  for (unsigned int c = 0; c < dim; ++c)
    move(surface.u[c], surface.w[c], surface.force[c], surface.inverse_mass[c]);
}

template class FreeSurface<2>;
template class FreeSurface<3>;
} // namespace mesoslip
