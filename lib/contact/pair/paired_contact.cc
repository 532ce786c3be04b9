#include "contact/pair/paired_contact.h"

#include <deal.II/base/exceptions.h>

namespace mesoslip
{
namespace
{
/** Of components of the second body, which is upside down. */
template <int dim>
double sign(const unsigned int c)
{
  return c + 1 == dim ? -1. : 1.;
}
} // namespace

template <int dim>
PairedContact<dim>::PairedContact(ContactSurface<dim> &contact,
                                  PartnerSurface<dim> &partner,
                                  const std::function<void()> &advance_partner,
                                  const StepParameters &step,
                                  const bool periodic)
  : contact(contact)
  , advance_partner(advance_partner)
  , step(step)
  , periodic(periodic)
{
  partner.meet = [this](const SurfaceView<dim> &below) { meet(below); };
}

template <int dim>
void PairedContact<dim>::advance(const SurfaceView<dim> &surface)
{
  above = &surface;
  advance_partner();
}

/** With the nodes of both bodies before the step. */
template <int dim>
void PairedContact<dim>::meet(const SurfaceView<dim> &below)
{
  AssertDimension(below.n, above->n);
  take_relative(below);
  SurfaceView<dim> relative = *above;
  for (unsigned int c = 0; c < dim; ++c)
    {
      relative.u[c]            = u.row(c, 0);
      relative.w[c]            = w.row(c, 0);
      relative.force[c]        = force.row(c, 0);
      relative.inverse_mass[c] = inverse_mass.row(c, 0);
    }
  contact.advance(relative);
  const std::array<const double *, 3> along = {
    {contact.tangential_force(), dim == 3 ? contact.lateral_force() : nullptr, nullptr}};
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t i = 0; i < above->n; ++i)
      {
        const double *const of_contact = c + 1 == dim ? contact.normal_force() : along[c];
        const double f = of_contact[periodic && i + 1 == above->n ? 0 : i];
        move(*above, c, i, f);
        move(below, c, i, -sign<dim>(c) * f);
      }
}

/** The motion of the first body seen from the second one, and the force that makes it in the step without contact. */
template <int dim>
void PairedContact<dim>::take_relative(const SurfaceView<dim> &below)
{
  if (u.n_columns() != above->n)
    u = w = force = inverse_mass = NodalField<double>::of_points(above->n, dim);
  for (unsigned int c = 0; c < dim; ++c)
    {
      const double s = sign<dim>(c);
      for (std::size_t i = 0; i < above->n; ++i)
        {
          const double own = above->inverse_mass[c][i], other = below.inverse_mass[c][i],
                       inverse = own + other,
                       apart   = own * above->force[c][i] - s * other * below.force[c][i];
          u.row(c, 0)[i]       = above->u[c][i] - s * below.u[c][i];
          w.row(c, 0)[i]       = above->w[c][i] - s * below.w[c][i];
          inverse_mass.row(c, 0)[i] = inverse;
          force.row(c, 0)[i]        = inverse > 0. ? apart / inverse : 0.;
        }
    }
}

/** One step of component @p c of node @p i under this contact force. */
template <int dim>
void PairedContact<dim>::move(const SurfaceView<dim> &surface,
                              const unsigned int c,
                              const std::size_t i,
                              const double f) const
{
  const double a = surface.inverse_mass[c][i] * (f - surface.force[c][i]), dt = step.dt;
  double &w_now = surface.w[c][i];
  w_now += dt * a;
  surface.u[c][i] += dt * w_now + (step.beta2 - 0.5) * dt * dt * a;
}

template class PairedContact<2>;
template class PairedContact<3>;
} // namespace mesoslip
