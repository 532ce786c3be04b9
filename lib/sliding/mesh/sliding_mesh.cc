#include "sliding/mesh/sliding_mesh.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace mesoslip
{
namespace
{
/** Of the whole surfaces what concerns the nodes of this rank. */
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
} // namespace

template <int dim>
MeshBoundary mesh_boundary(const Mesh<dim> &mesh,
                           const std::vector<BoundaryFace<dim>> &faces)
{
  const BoundaryPoints<dim> found = boundary_points(mesh, faces);
  std::map<unsigned int, double> area; // of originals
  for (std::size_t k = 0; k < found.points.size(); ++k)
    area[mesh.original(found.points[k])] += found.normal_area[k][dim - 1];
  MeshBoundary boundary;
  for (const auto &[point, of_point] : area)
    boundary.points.push_back(point);
  const auto coordinates = [&](const unsigned int point) {
    std::array<double, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = mesh.points[point][d];
    return result;
  };
  std::sort(boundary.points.begin(), boundary.points.end(),
            [&](const unsigned int a, const unsigned int b) {
              return coordinates(a) < coordinates(b);
            });
  double lowest = std::numeric_limits<double>::infinity();
  for (const unsigned int point : boundary.points)
    {
      boundary.area.push_back(area.at(point));
      boundary.height.push_back(mesh.points[point][dim - 1]);
      for (unsigned int d = 0; d + 1 < dim; ++d)
        boundary.position[d].push_back(mesh.points[point][d]);
      lowest = std::min(lowest, boundary.height.back());
    }
  for (double &h : boundary.height)
    h -= lowest;
  return boundary;
}

template <int dim>
std::vector<double> mean_of_phases(const Mesh<dim> &mesh,
                                   const std::vector<BoundaryFace<dim>> &faces,
                                   const MeshBoundary &boundary,
                                   const std::vector<double> &property,
                                   const std::vector<double> &weight)
{
  // Faces that stand on the flat count where there is nothing else.
  constexpr double standing = 1e-9;
  std::unordered_map<unsigned int, std::array<double, 2>> sums;
  for (const BoundaryFace<dim> &face : faces)
    {
      const unsigned int phase          = mesh.cells[face.cell].material_id;
      const BoundaryPoints<dim> of_face = boundary_points<dim>(mesh, {face});
      for (std::size_t k = 0; k < of_face.points.size(); ++k)
        {
          const dealii::Tensor<1, dim> &area = of_face.normal_area[k];
          const double share =
            weight[phase] * (std::fabs(area[dim - 1]) + standing * area.norm());
          auto &sum = sums[mesh.original(of_face.points[k])];
          sum[0] += share * property[phase];
          sum[1] += share;
        }
    }
  std::vector<double> means;
  for (const unsigned int point : boundary.points)
    means.push_back(sums.at(point)[0] / sums.at(point)[1]);
  return means;
}

template <int dim>
std::vector<double> extreme_of_phases(const Mesh<dim> &mesh,
                                      const std::vector<BoundaryFace<dim>> &faces,
                                      const MeshBoundary &boundary,
                                      const std::vector<double> &property,
                                      const bool largest)
{
  std::unordered_map<unsigned int, double> found;
  for (const BoundaryFace<dim> &face : faces)
    {
      const double here = property[mesh.cells[face.cell].material_id];
      for (const unsigned int point : boundary_points<dim>(mesh, {face}).points)
        {
          double &extreme = found.emplace(mesh.original(point), here).first->second;
          extreme         = largest ? std::max(extreme, here) : std::min(extreme, here);
        }
    }
  std::vector<double> extremes;
  for (const unsigned int point : boundary.points)
    extremes.push_back(found.at(point));
  return extremes;
}

template <int dim>
SlidingMesh<dim>::SlidingMesh(const DistributedBody<dim> &body,
                              const MeshBoundary &contact,
                              const MeshBoundary &top,
                              const std::vector<HeldComponent> &held,
                              const SlidingSetup &setup,
                              Timer *timer)
  : SlidingMesh(body,
                contact,
                top,
                SharedSurfaces(contact.points, top.points, setup.loaded, body.part()),
                held,
                setup,
                timer)
{
}

template <int dim>
SlidingMesh<dim>::SlidingMesh(const DistributedBody<dim> &body,
                              const MeshBoundary &contact,
                              const MeshBoundary &top,
                              const SharedSurfaces &shared,
                              const std::vector<HeldComponent> &held,
                              const SlidingSetup &setup,
                              Timer *timer)
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
    &stepper.add_surface(shared.contact,
                         *timed(this->contact, "Contact and its histories")),
    &stepper.add_surface(shared.top, *timed(this->top, "Top and its histories"))};
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
  for (unsigned int i = 0; i < contact_nodes.size(); ++i)
    if (const unsigned int point = contact_nodes.point(i);
        point != SharedNodes::none && this->contact.rests(i, a[point][normal]))
      a[point][normal] = 0.;
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t i = 0; i < n; ++i)
      w.row(c, 0)[i] = rests[i][c] ? 0. : velocity[c] + back * a[i][c];
}

namespace
{
/** Calls what (i, point) for the nodes that have a point on this rank. */
template <typename Function>
void for_each_point(const SharedNodes &nodes, const Function &what)
{
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (const unsigned int point = nodes.point(i); point != SharedNodes::none)
      what(i, point);
}
} // namespace

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
  // What platens move, once all that acts on their nodes is known.
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

#define MESOSLIP_INSTANTIATE(dim)                                                    \
  template MeshBoundary mesh_boundary(const Mesh<dim> &,                             \
                                      const std::vector<BoundaryFace<dim>> &);       \
  template std::vector<double> mean_of_phases(                                       \
    const Mesh<dim> &, const std::vector<BoundaryFace<dim>> &, const MeshBoundary &, \
    const std::vector<double> &, const std::vector<double> &);                       \
  template std::vector<double> extreme_of_phases(                                    \
    const Mesh<dim> &, const std::vector<BoundaryFace<dim>> &, const MeshBoundary &, \
    const std::vector<double> &, const bool);                                        \
  template class SlidingMesh<dim>;
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
