#include "sliding/mesh/elastic_mesh.h"

#include "base/exchange.h"
#include "base/object_exchange.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace mesoslip
{
template <int dim>
DofMask held_by_mesh(const MeshBodyDescription &body,
                     const TopSetup &top,
                     const bool contact_held,
                     const PointBody<dim> &elastic)
{
  DofMask held(elastic.n_columns(), 1);
  const auto hold = [&](const unsigned int c, const unsigned int point) {
    if (const auto node = elastic.find(point))
      held.constrain(c, *node);
  };
  for (const HeldComponent &h : body.held)
    hold(h.component, h.point);
  for (unsigned int c = 0; c < dim; ++c)
    if (top.is_fixed(c, dim))
      for (const unsigned int point : body.top.points)
        hold(c, point);
  for (const MeshSide &side : body.sides)
    for (unsigned int c = 0; c < dim; ++c)
      if (side.moves[c])
        for (const unsigned int point : side.points)
          hold(c, point);
  if (contact_held)
    for (const unsigned int point : body.contact.points)
      hold(dim - 1, point);
  return held;
}

template <int dim>
std::size_t n_free_on_mesh(const Mesh<dim> &mesh,
                           const MeshBodyDescription &body,
                           const TopSetup &top,
                           const bool contact_held)
{
  std::set<std::pair<unsigned int, unsigned int>> held; // point and component
  for (const HeldComponent &h : body.held)
    held.emplace(h.point, h.component);
  for (unsigned int c = 0; c < dim; ++c)
    if (top.is_fixed(c, dim))
      for (const unsigned int point : body.top.points)
        held.emplace(point, c);
  for (const MeshSide &side : body.sides)
    for (unsigned int c = 0; c < dim; ++c)
      if (side.moves[c])
        for (const unsigned int point : side.points)
          held.emplace(point, c);
  for (const unsigned int point : body.contact.points)
    if (contact_held)
      held.emplace(point, dim - 1);
  // Periodic copies are not constrained themselves.
  std::size_t n_copies = 0;
  for (unsigned int p = 0; p < mesh.points.size(); ++p)
    n_copies += mesh.master(p) == p ? 0 : 1;
  broadcast_object(MPI_COMM_WORLD, n_copies);
  return dim * (body.n_points - n_copies) - held.size();
}

template <int dim>
SupportNodes nodes_of(const MeshSide &side, const PointBody<dim> &elastic)
{
  SupportNodes found;
  std::vector<unsigned int> here;
  for (unsigned int k = 0; k < side.points.size(); ++k)
    if (const auto node = elastic.find(side.points[k]))
      {
        found.nodes.push_back(*node);
        here.push_back(k);
      }
  found.carried = side.nodes.at(here);
  return found;
}

template <int dim>
double frequency_of_springs(const DistributedBody<dim> &distributed,
                            const MeshBodyDescription &body,
                            const ContactParameters &parameters)
{
  std::map<unsigned int, double> squared; // for locally stored points
  const std::vector<double> &mass = distributed.lumped_mass();
  const auto add                  = [&](const Suspension &suspension,
                       const std::vector<unsigned int> &points,
                       const std::vector<double> &area) {
    const PointIndex index(distributed.part(), points);
    for (std::size_t k = 0; k < points.size() && suspension.has_springs(); ++k)
      for (const unsigned int i : index.find(points[k]))
        if (area[k] > 0.)
          squared[i] += suspension.squared_frequency(mass[i] / area[k]);
  };
  add(parameters.top.suspension, body.top.points, body.top.area);
  const std::vector<SideSupport> loaded = parameters.loaded_sides();
  for (std::size_t k = 0; k < loaded.size(); ++k)
    add(loaded[k].suspension, body.sides[k].points, body.sides[k].nodes.area);
  double largest = 0.;
  for (const auto &[point, of_point] : squared)
    largest = std::max(largest, of_point);
  return std::sqrt(mpi::max(largest, distributed.communicator()));
}

template <int dim>
void order_contact(MeshBodyDescription &body, const PointBody<dim> &elastic)
{
  const MeshBoundary contact         = body.contact;
  const std::vector<double> friction = body.friction;
  const auto shares                  = body.shares;
  std::map<unsigned int, std::size_t> place;
  for (std::size_t k = 0; k < contact.points.size(); ++k)
    place[contact.points[k]] = k;
  const std::vector<unsigned int> &points = elastic.contact_points();
  std::vector<unsigned int> number(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    {
      const std::size_t old  = place.at(points[k]);
      number[old]            = static_cast<unsigned int>(k);
      body.contact.points[k] = contact.points[old];
      body.contact.area[k]   = contact.area[old];
      body.contact.height[k] = contact.height[old];
      for (unsigned int d = 0; d + 1 < dim; ++d)
        body.contact.position[d][k] = contact.position[d][old];
      body.friction[k] = friction[old];
      for (std::size_t p = 0; p < shares.size(); ++p)
        body.shares[p][k] = shares[p][old];
    }
  for (SurfaceFacet &facet : body.contact.facets)
    for (unsigned int v = 0; v < facet.n; ++v)
      facet.node[v] = number[facet.node[v]];
}

#define MESOSLIP_INSTANTIATE(dim)                                                     \
  template DofMask held_by_mesh(const MeshBodyDescription &, const TopSetup &,        \
                                const bool, const PointBody<dim> &);                  \
  template std::size_t n_free_on_mesh(const Mesh<dim> &, const MeshBodyDescription &, \
                                      const TopSetup &, const bool);                  \
  template SupportNodes nodes_of(const MeshSide &, const PointBody<dim> &);           \
  template double frequency_of_springs(const DistributedBody<dim> &,                  \
                                       const MeshBodyDescription &,                   \
                                       const ContactParameters &);                    \
  template void order_contact(MeshBodyDescription &, const PointBody<dim> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
