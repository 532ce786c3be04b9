#include "contact/pair/paired_contact.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mesoslip
{
template <int dim>
PairedContact<dim>::PairedContact(ContactSurface<dim> &contact,
                                  const NodesOfContact &nodes,
                                  PartnerSurface<dim> &partner,
                                  const SurfaceMeeting &given,
                                  const std::function<void()> &advance_partner,
                                  const StepParameters &step,
                                  const MPI_Comm communicator)
  : contact(contact)
  , nodes(nodes)
  , partner(partner)
  , meeting(given)
  , advance_partner(advance_partner)
  , step(step)
  , of_partner(partner.nodes, n_rows * dim, communicator)
  , forces(nodes, dim + 2, communicator)
  , taken(dim * of_partner.n_nodes())
  , moved_before(dim * partner.nodes.number.size())
  , u(NodalField<double>::of_points(nodes.number.size(), dim))
  , w(u)
  , force(u)
  , inverse_mass(u)
  , mass(u)
  , apart(u)
  , trial(NodalField<double>::of_points(nodes.number.size(), dim + 2))
{
  AssertDimension(meeting.weights.rows.n_rows(), forces.n_nodes());
  last.resize(dim * forces.n_nodes());
  set_weights(meeting.weights);
  partner.meet = [this](const SurfaceView<dim> &below) { meet(below); };
}

template <int dim>
void PairedContact<dim>::set_weights(SurfaceWeights weights)
{
  meeting.weights     = std::move(weights);
  share               = meeting.weights.reach();
  const bool partners = meeting.weights.are_partners();
  for (double &of_node : share)
    of_node *= partners ? 1. : 0.5;
}

/**
 * Compliance that the surface below adds to node @p k: d_i - 1/m_i of the class, from the
 * inverse masses below.
 */
template <int dim>
double PairedContact<dim>::yielding(const double *inverse_below,
                                    const std::size_t k) const
{
  const SparseRows &rows = meeting.weights.rows;
  double sum             = 0.;
  for (std::size_t e = rows.start[k]; e < rows.start[k + 1]; ++e)
    {
      const auto [j, weight] = rows.entries[e];
      sum += std::fabs(weight) * share[j] * inverse_below[j];
    }
  return sum;
}

/** Sign of a component of the second body in the frame of the first one. */
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

/** Called with the nodes of both bodies before the step. */
template <int dim>
void PairedContact<dim>::meet(const SurfaceView<dim> &below)
{
  AssertDimension(above->n, nodes.number.size());
  AssertDimension(below.n, partner.nodes.number.size());
  share_partner(below);
  if (meeting.sliding)
    slide();
  take_relative();
  SurfaceView<dim> relative = *above;
  for (unsigned int c = 0; c < dim; ++c)
    {
      relative.u[c]            = u.row(c, 0);
      relative.w[c]            = w.row(c, 0);
      relative.force[c]        = force.row(c, 0);
      relative.inverse_mass[c] = inverse_mass.row(c, 0);
    }
  if (meeting.couples())
    settle(relative);
  contact.advance(relative);
  share_forces();
  take_shared_forces();
  meeting.weights.template spread<dim>(last, taken);
  for (unsigned int c = 0; c < dim; ++c)
    {
      move(*above, nodes, c, last, 1.);
      double *const moved = moved_before.data() + c * below.n;
      if (meeting.sliding)
        std::copy_n(below.u[c], below.n, moved);
      move(below, partner.nodes, c, taken, -sign(c));
      for (std::size_t i = 0; meeting.sliding && i < below.n; ++i)
        moved[i] = below.u[c][i] - moved[i];
    }
}

template <int dim>
void PairedContact<dim>::share_partner(const SurfaceView<dim> &below)
{
  acceleration.resize(below.n);
  for (unsigned int c = 0; c < dim; ++c)
    {
      for (std::size_t i = 0; i < below.n; ++i)
        acceleration[i] = below.inverse_mass[c][i] * below.force[c][i];
      of_partner.set(n_rows * c + displacement, below.u[c]);
      of_partner.set(n_rows * c + velocity, below.w[c]);
      of_partner.set(n_rows * c + braking, acceleration.data());
      of_partner.set(n_rows * c + one_over_mass, below.inverse_mass[c]);
      of_partner.set(n_rows * c + increment, moved_before.data() + c * below.n);
    }
  of_partner.share();
}

/**
 * Updates the surface below the nodes: its rise in this step, and its motion in the
 * previous step.
 */
template <int dim>
void PairedContact<dim>::slide()
{
  const std::array<double, 2> moved = contact.flat_increment(above->time);
  for (unsigned int d = 0; d < 2; ++d)
    way[d] += moved[d];
  const SurfaceWeights before = std::move(meeting.weights);
  set_weights(meeting.sliding->at(way));
  const auto change = [&](const Row r, const unsigned int c, const unsigned int k) {
    const double *const values = of_partner.row(n_rows * c + r);
    return sign(c) * (meeting.weights.of(values, k) - before.of(values, k));
  };
  std::array<const double *, dim> change_of_moved;
  for (unsigned int c = 0; c < dim; ++c)
    {
      nodes.for_each([&](const std::size_t i, const unsigned int k) {
        u.row(c, 0)[i] = -change(increment, c, k);
        if (c + 1 == dim)
          w.row(c, 0)[i] = change(displacement, c, k);
      });
      change_of_moved[c] = u.row(c, 0);
    }
  contact.ride(w.row(dim - 1, 0), change_of_moved);
}

/**
 * Sets the motion of the first body relative to the second one, and the forces that drive
 * it without contact.
 */
template <int dim>
void PairedContact<dim>::take_relative()
{
  const SurfaceWeights &weights = meeting.weights;
  for (unsigned int c = 0; c < dim; ++c)
    {
      const double s = sign(c);
      const auto row = [&](const Row r) { return of_partner.row(n_rows * c + r); };
      nodes.for_each([&](const std::size_t i, const unsigned int k) {
        const double own     = above->inverse_mass[c][i],
                     inverse = own + yielding(row(one_over_mass), k);
        const double off     = own * above->force[c][i] - s * weights.of(row(braking), k);
        u.row(c, 0)[i]       = above->u[c][i] - s * weights.of(row(displacement), k);
        w.row(c, 0)[i]       = above->w[c][i] - s * weights.of(row(velocity), k);
        inverse_mass.row(c, 0)[i] = inverse;
        apart.row(c, 0)[i]        = off;
        mass.row(c, 0)[i]         = inverse > 0. ? 1. / inverse : 0.;
        force.row(c, 0)[i]        = inverse > 0. ? off / inverse : 0.;
      });
    }
}

/** Copies the values of forces.share() to the forces of the last step. */
template <int dim>
void PairedContact<dim>::take_shared_forces()
{
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t k = 0; k < forces.n_nodes(); ++k)
      last[dim * k + c] = forces.row(c)[k];
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

/** Advances component @p c of the nodes by one step under @p f times @p sign. */
template <int dim>
void PairedContact<dim>::move(const SurfaceView<dim> &surface,
                              const NodesOfContact &of_surface,
                              const unsigned int c,
                              const Forces &f,
                              const double sign) const
{
  of_surface.for_each([&](const std::size_t i, const unsigned int k) {
    const double a =
      surface.inverse_mass[c][i] * (sign * f[dim * k + c] - surface.force[c][i]);
    double &w_now = surface.w[c][i];
    w_now += step.dt * a;
    surface.u[c][i] += step.dt * w_now + (step.beta2 - 0.5) * step.dt * step.dt * a;
  });
}

template class PairedContact<2>;
template class PairedContact<3>;
} // namespace mesoslip
