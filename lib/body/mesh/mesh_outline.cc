#include "body/mesh/mesh_outline.h"

#include "base/errors.h"
#include "base/text.h"
#include "mesh/boundary.h"
#include "mesh/cell_quality.h"
#include "mesh/periodic_points.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

namespace mesoslip
{
namespace
{
/** Faces in a plane of the bounding box. */
template <int dim>
std::vector<BoundaryFace<dim>> faces_in_plane(const Mesh<dim> &mesh,
                                              const std::vector<BoundaryFace<dim>> &faces,
                                              const dealii::BoundingBox<dim> &box,
                                              const unsigned int side)
{
  const unsigned int axis = side / 2;
  const double level      = side % 2 == 0 ? box.lower_bound(axis) : box.upper_bound(axis);
  std::vector<BoundaryFace<dim>> result;
  std::copy_if(faces.begin(), faces.end(), std::back_inserter(result),
               [&](const BoundaryFace<dim> &face) {
                 return std::all_of(face.points.begin(),
                                    face.points.begin() + face.n_points,
                                    [&](const unsigned int p) {
                                      return std::fabs(mesh.points[p][axis] - level) <=
                                             mesh.tolerance * shortest_edge(mesh, face);
                                    });
               });
  return result;
}

/** Sums areas of periodic copies at their periodic master. */
template <int dim>
BoundaryPoints<dim> of_masters(const Mesh<dim> &mesh, const BoundaryPoints<dim> &all)
{
  if (mesh.masters.empty())
    return all;
  std::map<unsigned int, dealii::Tensor<1, dim>> area;
  for (std::size_t k = 0; k < all.points.size(); ++k)
    area[mesh.master(all.points[k])] += all.normal_area[k];
  BoundaryPoints<dim> result;
  for (const auto &[point, of_point] : area)
    {
      result.points.push_back(point);
      result.normal_area.push_back(of_point);
    }
  return result;
}

template <int dim>
std::vector<BoundaryFace<dim>> faces_called(const Mesh<dim> &mesh,
                                            const std::vector<BoundaryFace<dim>> &faces,
                                            const std::string &name)
{
  const auto found = std::find(mesh.boundaries.begin(), mesh.boundaries.end(), name);
  std::vector<BoundaryFace<dim>> result;
  if (found != mesh.boundaries.end())
    result = faces_of_group(mesh, faces, found - mesh.boundaries.begin());
  if (result.empty())
    throw UserError("Mesh: there is no boundary '" + name +
                    "' with faces on the surface of the body; its boundaries are " +
                    to_text(mesh.boundaries));
  return result;
}

/** In 2D sorts the points in ascending order along side @p id. */
template <int dim>
typename MeshOutline<dim>::Side
in_order(const Mesh<dim> &mesh, const BoundaryPoints<dim> &side, const unsigned int id)
{
  std::vector<std::size_t> order(side.points.size());
  std::iota(order.begin(), order.end(), 0);
  if (dim == 2)
    std::sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
      return mesh.points[side.points[a]][1 - id / 2] <
             mesh.points[side.points[b]][1 - id / 2];
    });
  typename MeshOutline<dim>::Side result;
  for (const std::size_t k : order)
    {
      result.points.push_back(side.points[k]);
      std::array<double, dim> area;
      for (unsigned int d = 0; d < dim; ++d)
        area[d] = side.normal_area[k][d];
      result.normal_area.push_back(area);
    }
  return result;
}

template <int dim>
void find_sides(const Mesh<dim> &mesh,
                const MeshBodyInput<dim> &input,
                MeshOutline<dim> &outline)
{
  const auto faces = boundary_faces(mesh);
  const dealii::BoundingBox<dim> box(mesh.points);
  for (unsigned int d = 0; d < dim; ++d)
    {
      outline.lower[d]   = box.lower_bound(d);
      outline.extents[d] = box.side_length(d);
    }
  for (unsigned int id = 0; id < 2 * dim; ++id)
    {
      const std::string &name = id == ElasticBody<dim>::bottom ? input.contact_boundary
                                : id == ElasticBody<dim>::top  ? input.top_boundary
                                                               : std::string();
      outline.sides.push_back(in_order(
        mesh,
        of_masters(mesh, boundary_points(mesh, name.empty()
                                                 ? faces_in_plane(mesh, faces, box, id)
                                                 : faces_called(mesh, faces, name))),
        id));
    }
}

template <int dim>
void tie_sides(const Mesh<dim> &mesh,
               const Periodicity &periodicity,
               MeshOutline<dim> &outline)
{
  for (unsigned int p = 0; p < mesh.masters.size(); ++p)
    if (mesh.masters[p] != p)
      outline.copies.insert(outline.copies.end(), {p, mesh.masters[p]});
  if (!mesh.masters.empty())
    return;
  const std::array<bool, 2> periodic = {{periodicity.x, periodicity.y}};
  const auto faces                   = boundary_faces(mesh);
  const dealii::BoundingBox<dim> box(mesh.points);
  for (unsigned int axis = 0; axis < 2; ++axis)
    if (periodic[axis])
      for (const auto &[copy, master] :
           opposite_points(mesh, faces_in_plane(mesh, faces, box, 2 * axis),
                           faces_in_plane(mesh, faces, box, 2 * axis + 1), axis,
                           cell_quality(mesh).smallest_edge)
             .pairs)
        outline.copies.insert(outline.copies.end(), {copy, master});
}
} // namespace

template <int dim>
MeshOutline<dim> outline_of(const Mesh<dim> &mesh, const MeshBodyInput<dim> &input)
{
  cell_quality(mesh);
  MeshOutline<dim> outline;
  for (const auto &cell : mesh.cells)
    {
      const double volume = cell_volume<dim>(mesh.points, cell.vertices);
      outline.volume += volume;
      outline.mass += volume * input.phases[cell.material_id].density;
    }
  outline.n_cells = mesh.cells.size();
  find_sides(mesh, input, outline);
  tie_sides(mesh, input.periodicity, outline);
  return outline;
}

template MeshOutline<2> outline_of(const Mesh<2> &, const MeshBodyInput<2> &);
template MeshOutline<3> outline_of(const Mesh<3> &, const MeshBodyInput<3> &);
} // namespace mesoslip
