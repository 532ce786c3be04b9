#include "sliding/mesh/mesh_sides.h"

#include "sliding/contact_parameters.h"
#include "sliding/mesh/body_mesh.h"
#include "sliding/supports/side_platen.h"

#include <algorithm>
#include <map>
#include <set>

namespace mesoslip
{
namespace
{
/** Periodic masters of the points of a group; empty if there is no such group. */
template <int dim>
std::vector<unsigned int> points_of_group(const BodyMesh<dim> &morphology,
                                          const std::vector<BoundaryFace<dim>> &faces,
                                          const std::string &name)
{
  const std::vector<std::string> &names = morphology.mesh.boundaries;
  if (std::find(names.begin(), names.end(), name) == names.end())
    return {};
  return mesh_boundary(morphology.mesh, group_faces(morphology, faces, name, name))
    .points;
}

/** Loaded sides with all their points. */
template <int dim>
std::vector<MeshSide> loaded_sides_of(const BodyMesh<dim> &morphology,
                                      const std::vector<BoundaryFace<dim>> &faces,
                                      const ContactParameters &given)
{
  std::vector<MeshSide> sides;
  for (const SideSupport &support : given.loaded_sides())
    sides.push_back(mesh_side(morphology,
                              group_faces(morphology, faces,
                                          given.mesh.section + "Supports/" + support.name,
                                          support.name),
                              support.suspension.absorbing));
  return sides;
}
} // namespace

template <int dim>
std::vector<std::vector<double>>
impedance_of_points(const BodyMesh<dim> &morphology,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const MeshBoundary &top)
{
  const MeshSide side = mesh_side(morphology, faces, true);
  std::map<unsigned int, std::size_t> place;
  for (std::size_t k = 0; k < side.points.size(); ++k)
    place[side.points[k]] = k;
  std::vector<std::vector<double>> result;
  for (const std::vector<double> &component : side.nodes.impedance)
    {
      std::vector<double> values;
      for (std::size_t i = 0; i < top.points.size(); ++i)
        {
          const std::size_t k = place.at(top.points[i]);
          values.push_back(
            top.area[i] > 0. ? component[k] * side.nodes.area[k] / top.area[i] : 0.);
        }
      result.push_back(values);
    }
  return result;
}

template <int dim>
void describe_sides(MeshBodyDescription &body,
                    const BodyMesh<dim> &morphology,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const ContactParameters &given)
{
  body.sides = loaded_sides_of(morphology, faces, given);
  std::set<unsigned int> taken;
  // The far end, below a counter body, moves its nodes before other sides do.
  const std::string far = given.is_counter ? "Bottom" : given.mesh.top_boundary;
  const std::vector<SideSupport> loaded = given.loaded_sides();
  std::vector<std::string> of_others    = {given.mesh.contact_boundary};
  if (loaded.empty() || !loaded[0].is_platen || loaded[0].name != far)
    of_others.push_back(far);
  for (const std::string &name : of_others)
    for (const unsigned int point : points_of_group(morphology, faces, name))
      taken.insert(point);
  const std::vector<HeldComponent> held = body.held;
  for (std::size_t k = 0; k < loaded.size() && loaded[k].is_platen; ++k)
    {
      MeshSide &side = body.sides[k];
      side.moves = moves_of_platen(loaded[k], normal_of(loaded[k], side.nodes, dim), dim);
      std::set<unsigned int> others = taken;
      for (const HeldComponent &h : held)
        if (side.moves[h.component])
          others.insert(h.point);
      side.keep_for_platen(others, loaded[k]);
      for (const unsigned int point : side.points)
        for (unsigned int c = 0; c < dim; ++c)
          if (!side.moves[c])
            body.held.push_back({point, c});
      taken.insert(side.points.begin(), side.points.end());
    }
}

#define MESOSLIP_INSTANTIATE(dim)                                            \
  template std::vector<std::vector<double>> impedance_of_points(             \
    const BodyMesh<dim> &, const std::vector<BoundaryFace<dim>> &,           \
    const MeshBoundary &);                                                   \
  template void describe_sides(MeshBodyDescription &, const BodyMesh<dim> &, \
                               const std::vector<BoundaryFace<dim>> &,       \
                               const ContactParameters &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
