#include "sliding/mesh/sliding_mesh.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/** Restricts the setup of whole surfaces to the nodes of this rank. */
SlidingSetup restricted(SlidingSetup setup,
                        const MeshBoundary &contact,
                        const MeshBoundary &top,
                        const SharedSurfaces &shared,
                        const MPI_Comm communicator)
{
  const SharedNodes &contact_nodes = shared.contact, &top_nodes = shared.top;
  std::vector<double> &friction = setup.contact.friction_coefficient;
  AssertDimension(friction.size(), contact.points.size());
  friction             = contact_nodes.of(friction, 0.);
  setup.contact.height = contact.height;
  setup.contact.height.resize(contact.points.size(), 0.);
  setup.contact.height =
    contact_nodes.of(setup.contact.height, std::numeric_limits<double>::infinity());
  if (setup.contact.wants_area())
    {
      setup.contact.area = contact_nodes.of(contact.area, 0.);
      for (unsigned int d = 0; d < 2; ++d)
        if (!contact.position[d].empty())
          setup.contact.position[d] = contact_nodes.of(contact.position[d], 0.);
    }
  setup.contact.n_owned = contact_nodes.n_owned();
  setup.contact_places  = contact_nodes.owned_places();
  for (unsigned int &node : setup.monitored_nodes)
    {
      const auto here = contact_nodes.find(node);
      node = here && *here < contact_nodes.n_owned() ? *here : SharedNodes::none;
    }
  setup.top.n_owned = top_nodes.n_owned();
  std::vector<unsigned int> of_top;
  for (unsigned int i = 0; i < top_nodes.size(); ++i)
    of_top.push_back(top_nodes.number(i));
  setup.top.nodes.area = top.area;
  setup.top.nodes      = setup.top.nodes.at(of_top);
  setup.loaded.clear();
  for (const SharedSide &side : shared.sides)
    setup.loaded.push_back(side.here);
  setup.ranks = setup.platen_ranks = communicator;
  return setup;
}

/** Calls what(i, point) for the nodes with a point on this rank. */
template <typename Function>
void for_each_point(const SharedNodes &nodes, const Function &what)
{
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (const unsigned int point = nodes.point(i); point != SharedNodes::none)
      what(i, point);
}
} // namespace

NodesOfContact nodes_of_contact(const SharedNodes &nodes)
{
  NodesOfContact result;
  result.n_owned = nodes.n_owned();
  for (unsigned int i = 0; i < nodes.size(); ++i)
    result.number.push_back(nodes.point(i) == SharedNodes::none ? NodesOfContact::none
                                                                : nodes.number(i));
  return result;
}

template <int dim>
SlidingMesh<dim>::SlidingMesh(const DistributedBody<dim> &body,
                              const MeshBoundary &contact,
                              const MeshBoundary &top,
                              const std::vector<HeldComponent> &held,
                              const SlidingSetup &setup,
                              Timer *timer,
                              CounterMotion<dim> *counter,
                              PartnerSurface<dim> *partner)
  : SlidingMesh(body,
                contact,
                top,
                SharedSurfaces(contact.points, top.points, setup.loaded, body.part()),
                held,
                setup,
                timer,
                counter,
                partner)
{
}

template <int dim>
SlidingMesh<dim>::SlidingMesh(const DistributedBody<dim> &body,
                              const MeshBoundary &contact,
                              const MeshBoundary &top,
                              const SharedSurfaces &shared,
                              const std::vector<HeldComponent> &held,
                              const SlidingSetup &setup,
                              Timer *timer,
                              CounterMotion<dim> *counter,
                              PartnerSurface<dim> *partner)
  : SlidingBody<dim>(restricted(setup, contact, top, shared, body.communicator()),
                     shared.top.size(),
                     timer)
  , contact_nodes(shared.contact)
  , u(NodalField<double>::of_points(body.part().points.size(), dim))
  , w(u)
  , part(body.part())
  , surfaces(shared)
  , own_stepper(body.make_stepper(held, setup.step, u, w))
  , stepper(*own_stepper)
{
  const auto timed = [this](SurfaceCondition<dim> &surface, const char *name) {
    return this->profile.template timed<TimedSurface<dim>>(surface, name);
  };
  std::vector<MeshSurface<dim> *> hosts = {
    &stepper.add_surface(
      shared.contact, partner != nullptr ? static_cast<SurfaceCondition<dim> &>(*partner)
                                         : this->contact_condition(
                                             counter, nodes_of_contact(shared.contact),
                                             body.communicator())),
    top.points.empty()
      ? nullptr
      : &stepper.add_surface(shared.top, *timed(this->top, "Top and its histories"))};
  const std::size_t n_platens = this->platens.size();
  for (std::size_t k = 0; k < n_platens; ++k)
    hosts.push_back(&stepper.add_side(shared.sides[k].own,
                                      *timed(this->platens[k], "Platens at the sides")));
  for (std::size_t k = 0; k < this->sides.size(); ++k)
    hosts.push_back(&stepper.add_side(shared.sides[n_platens + k].own,
                                      *timed(this->sides[k], "Sides under a load")));
  for (std::size_t k = 0; k < this->sides.size(); ++k)
    for (const SideGuest &guest : shared.sides[n_platens + k].guests)
      hosts[guest.host]->add_guest(guest.i, this->sides[k], guest.k);
  this->watch_energy();
}

template <int dim>
void SlidingMesh<dim>::set_initial_velocity(const std::array<double, 3> &velocity,
                                            const std::vector<HeldComponent> &held,
                                            const MeshBoundary &top)
{
  constexpr unsigned int normal = dim - 1;
  const std::size_t n           = part.points.size();
  std::vector<std::array<bool, dim>> rests(n);
  std::vector<unsigned int> resting = points_of(held);
  resting.insert(resting.end(), top.points.begin(), top.points.end());
  const PointIndex index(part, resting);
  const auto hold = [&](const unsigned int point, const unsigned int component) {
    for (const unsigned int i : index.find(point))
      rests[i][component] = true;
  };
  for (const HeldComponent &h : held)
    hold(h.point, h.component);
  for (const unsigned int point : top.points)
    for (unsigned int c = 0; c < dim; ++c)
      if (c < normal ? this->setup.top.holds(c) : this->setup.top.is_held())
        hold(point, c);
  std::vector<std::array<double, dim>> a = start_acceleration(velocity, rests);
  const double back                      = -this->setup.step.beta2 * this->setup.step.dt;
  NormalStart &start                     = this->contact_start;
  start.velocity                         = velocity[normal];
  start.acceleration.assign(contact_nodes.size(), 0.);
  start.inverse_inertia.assign(contact_nodes.size(), 0.);
  std::vector<double> mass(n);
  stepper.mass_row(0, mass.data());
  for_each_point(contact_nodes, [&](const unsigned int i, const unsigned int point) {
    start.acceleration[i]    = a[point][normal];
    start.inverse_inertia[i] = rests[point][normal] ? 0. : 1. / mass[point];
    if (this->contact.rests(i, a[point][normal]))
      a[point][normal] = 0.;
  });
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t i = 0; i < n; ++i)
      w.row(c, 0)[i] = rests[i][c] ? 0. : velocity[c] + back * a[i][c];
  this->start_together();
}

template <int dim>
void SlidingMesh<dim>::start_contact()
{
  const NormalStart &start = this->contact_start;
  const double back        = -this->setup.step.beta2 * this->setup.step.dt;
  for_each_point(contact_nodes, [&](const unsigned int i, const unsigned int point) {
    if (start.inverse_inertia[i] > 0.)
      w.row(dim - 1, 0)[point] = start.velocity + back * start.acceleration[i];
  });
}

template <int dim>
std::vector<std::array<double, dim>> SlidingMesh<dim>::start_acceleration(
  const std::array<double, 3> &velocity,
  const std::vector<std::array<bool, dim>> &rests) const
{
  const std::size_t n = part.points.size();
  std::array<double, dim> by_weight;
  std::copy_n(this->setup.step.acceleration.begin(), dim, by_weight.begin());
  std::vector<std::array<double, dim>> a(n, by_weight);
  const SharedNodes &top   = surfaces.top;
  const double of_supports = this->setup.step.common_alpha();
  std::vector<double> mass(n), drag(n), of_top(top.size(), 0.);
  stepper.mass_row(0, mass.data());
  for (std::size_t i = 0; i < n; ++i)
    drag[i] = stepper.alpha_of({static_cast<unsigned int>(i), 0}, mass[i]) * mass[i];
  std::vector<std::array<bool, dim>> held_on_top(top.size());
  for_each_point(top, [&](const unsigned int i, const unsigned int point) {
    of_top[i]      = mass[point];
    held_on_top[i] = rests[point];
  });
  const auto pushed = this->top.start_acceleration(of_top, held_on_top, velocity);
  for_each_point(top, [&](const unsigned int i, const unsigned int point) {
    a[point] = pushed[i];
    mass[point] += this->top.suspended_mass(i);
    drag[point] += of_supports * this->top.suspended_mass(i);
  });
  const auto load = [&](const SideSurface<dim> &side, const unsigned int k,
                        const unsigned int point) {
    if (point == SharedNodes::none)
      return;
    std::array<double, dim> starts_with;
    for (unsigned int c = 0; c < dim; ++c)
      starts_with[c] = rests[point][c] ? 0. : velocity[c];
    side.accelerate(k, mass[point], starts_with, a[point]);
    mass[point] += side.mass(k);
    drag[point] += of_supports * side.mass(k);
  };
  const std::size_t n_platens = this->platens.size();
  for (std::size_t s = 0; s < this->sides.size(); ++s)
    {
      const SharedSide &side = surfaces.sides[n_platens + s];
      for (unsigned int k = 0; k < side.own.size(); ++k)
        load(this->sides[s], k, side.own.point(k));
      for (const SideGuest &guest : side.guests)
        load(this->sides[s], guest.k, surfaces.host(guest.host).point(guest.i));
    }
  for (std::size_t i = 0; i < n; ++i)
    for (unsigned int c = 0; c < dim; ++c)
      a[i][c] -= drag[i] / mass[i] * velocity[c];
  // Nodes of platens move together, after all loads on them are known.
  const auto together = [&](const RigidPlaten<dim> &platen, const SharedNodes &nodes) {
    std::vector<typename RigidPlaten<dim>::NodeAtStart> at_start(nodes.size());
    for_each_point(nodes, [&](const unsigned int i, const unsigned int point) {
      at_start[i] = {mass[point], a[point]};
    });
    const auto found = platen.start_acceleration(at_start, velocity);
    for_each_point(
      nodes, [&](const unsigned int, const unsigned int point) { a[point] = found; });
  };
  if (const RigidPlaten<dim> *platen = this->top.moved_by(); platen != nullptr)
    together(*platen, top);
  for (std::size_t k = 0; k < n_platens; ++k)
    together(this->platens[k], surfaces.sides[k].own);
  return a;
}

template class SlidingMesh<2>;
template class SlidingMesh<3>;
} // namespace mesoslip
