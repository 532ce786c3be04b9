#include "contact/pair/paired_contact.h"

#include <deal.II/base/exceptions.h>

#include <array>

namespace mesoslip
{
namespace
{
/** Rows of what the second body tells of a component. */
enum Row : unsigned int
{
  displacement,
  velocity,
  force_without_contact,
  one_over_mass,
  n_rows
};

/** Calls what (i, number in the whole contact) for the nodes that are some. */
template <typename Function>
void for_each_node(const NodesOfContact &nodes, const Function &what)
{
  for (std::size_t i = 0; i < nodes.number.size(); ++i)
    if (nodes.number[i] != NodesOfContact::none)
      what(i, nodes.number[i]);
}
} // namespace

template <int dim>
PairedContact<dim>::PairedContact(ContactSurface<dim> &contact,
                                  const NodesOfContact &nodes,
                                  PartnerSurface<dim> &partner,
                                  const std::function<void()> &advance_partner,
                                  const StepParameters &step,
                                  const MPI_Comm communicator)
  : contact(contact)
  , nodes(nodes)
  , partner(partner)
  , advance_partner(advance_partner)
  , step(step)
  , of_partner(partner.nodes, n_rows * dim, communicator)
  , forces(nodes, dim, communicator)
  , u(NodalField<double>::of_points(nodes.number.size(), dim))
  , w(u)
  , force(u)
  , inverse_mass(u)
{
  partner.meet = [this](const SurfaceView<dim> &below) { meet(below); };
}

/** Of components of the second body in the frame of the first one. */
template <int dim>
double PairedContact<dim>::sign(const unsigned int c) const
{
  return c + 1 == dim ? partner.normal : 1.;
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
  AssertDimension(above->n, nodes.number.size());
  AssertDimension(below.n, partner.nodes.number.size());
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
  share_forces();
  for (unsigned int c = 0; c < dim; ++c)
    {
      move(*above, nodes, c, 1.);
      move(below, partner.nodes, c, -sign(c));
    }
}

/** The motion of the first body seen from the second one, and the force that makes it in the step without contact. */
template <int dim>
void PairedContact<dim>::take_relative(const SurfaceView<dim> &below)
{
  for (unsigned int c = 0; c < dim; ++c)
    {
      of_partner.set(n_rows * c + displacement, below.u[c]);
      of_partner.set(n_rows * c + velocity, below.w[c]);
      of_partner.set(n_rows * c + force_without_contact, below.force[c]);
      of_partner.set(n_rows * c + one_over_mass, below.inverse_mass[c]);
    }
  of_partner.share();
  for (unsigned int c = 0; c < dim; ++c)
    {
      const double s = sign(c);
      const auto row = [&](const Row r) { return of_partner.row(n_rows * c + r); };
      const double *u_partner = row(displacement), *w_partner = row(velocity),
                   *force_partner = row(force_without_contact),
                   *of_mass       = row(one_over_mass);
      for_each_node(nodes, [&](const std::size_t i, const unsigned int k) {
        const double own = above->inverse_mass[c][i], inverse = own + of_mass[k],
                     apart = own * above->force[c][i] - s * of_mass[k] * force_partner[k];
        u.row(c, 0)[i]     = above->u[c][i] - s * u_partner[k];
        w.row(c, 0)[i]     = above->w[c][i] - s * w_partner[k];
        inverse_mass.row(c, 0)[i] = inverse;
        force.row(c, 0)[i]        = inverse > 0. ? apart / inverse : 0.;
      });
    }
}

template <int dim>
void PairedContact<dim>::share_forces()
{
  const std::array<const double *, 3> along = {
    {contact.tangential_force(), dim == 3 ? contact.lateral_force() : nullptr, nullptr}};
  for (unsigned int c = 0; c < dim; ++c)
    forces.set(c, c + 1 == dim ? contact.normal_force() : along[c]);
  forces.share();
}

/** One step of component @p c of the nodes under the contact forces times @p sign. */
template <int dim>
void PairedContact<dim>::move(const SurfaceView<dim> &surface,
                              const NodesOfContact &of_surface,
                              const unsigned int c,
                              const double sign) const
{
  const double *const f = forces.row(c);
  for_each_node(of_surface, [&](const std::size_t i, const unsigned int k) {
    const double a = surface.inverse_mass[c][i] * (sign * f[k] - surface.force[c][i]);
    double &w_now  = surface.w[c][i];
    w_now += step.dt * a;
    surface.u[c][i] += step.dt * w_now + (step.beta2 - 0.5) * step.dt * step.dt * a;
  });
}

template <int dim>
void PairedContact<dim>::start_as_one(NormalStart &own, NormalStart &other)
{
  const double s              = partner.normal;
  const MPI_Comm communicator = of_partner.ranks();
  SurfaceValues of_other(partner.nodes, 2, communicator),
    together(nodes, 2, communicator);
  of_other.set(0, other.inverse_inertia.data());
  of_other.set(1, other.acceleration.data());
  of_other.share();
  std::vector<double> rest(nodes.number.size()), common(rest);
  for_each_node(nodes, [&](const std::size_t i, const unsigned int k) {
    const double up = own.acceleration[i], down = s * of_other.row(1)[k],
                 inverse = own.inverse_inertia[i], below = of_other.row(0)[k];
    if (own.velocity == s * other.velocity && inverse > 0. && below > 0. &&
        contact.rests(static_cast<unsigned int>(i), up - down))
      {
        rest[i]   = 1.;
        common[i] = (below * up + inverse * down) / (inverse + below);
      }
  });
  together.set(0, rest.data());
  together.set(1, common.data());
  together.share();
  const auto take = [&](NormalStart &start, const NodesOfContact &of, const double sign) {
    for_each_node(of, [&](const std::size_t i, const unsigned int k) {
      if (together.row(0)[k] > 0.)
        start.acceleration[i] = sign * together.row(1)[k];
    });
  };
  take(own, nodes, 1.);
  take(other, partner.nodes, s);
}

template class PairedContact<2>;
template class PairedContact<3>;
} // namespace mesoslip
