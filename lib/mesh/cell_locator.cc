#include "mesh/cell_locator.h"

#include "mesh/linear_cell.h"

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace mesoslip
{
namespace
{
/** Largest distance of a point from its cell, in diameters of the cell. */
constexpr double reach = 0.25;

/** Points within this distance of a face, in diameters of the cell, are on the face. */
constexpr double on_face = 1e-9;

template <int dim>
dealii::BoundingBox<dim> box_of(const Mesh<dim> &mesh, const unsigned int cell)
{
  std::vector<dealii::Point<dim>> corners;
  for (const unsigned int v : mesh.cells[cell].vertices)
    corners.push_back(mesh.points[v]);
  return dealii::BoundingBox<dim>(corners);
}

template <int dim>
std::vector<unsigned int> all_cells(const Mesh<dim> &mesh)
{
  std::vector<unsigned int> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0U);
  return cells;
}

template <int dim>
double diameter_of(const dealii::BoundingBox<dim> &box)
{
  return (box.get_boundary_points().second - box.get_boundary_points().first).norm();
}

/** Normal of an edge (2D) or a face with three or four corners; of any length. */
dealii::Tensor<1, 2> normal_of(const std::vector<dealii::Point<2>> &p)
{
  return dealii::cross_product_2d(p[1] - p[0]);
}

dealii::Tensor<1, 3> normal_of(const std::vector<dealii::Point<3>> &p)
{
  return p.size() == 3 ? dealii::cross_product_3d(p[1] - p[0], p[2] - p[0])
                       : dealii::cross_product_3d(p[3] - p[0], p[2] - p[1]);
}

template <int dim>
dealii::Point<dim> mean_of(const std::vector<dealii::Point<dim>> &points)
{
  dealii::Point<dim> sum;
  for (const auto &point : points)
    sum += point;
  return sum / static_cast<double>(points.size());
}
} // namespace

/** Cells with their bounding boxes. */
template <int dim>
struct CellLocator<dim>::Boxes
{
  dealii::RTree<std::pair<dealii::BoundingBox<dim>, unsigned int>> tree;
};

template <int dim>
CellLocator<dim>::CellLocator(const Mesh<dim> &mesh)
  : CellLocator(mesh, all_cells(mesh))
{
}

template <int dim>
CellLocator<dim>::CellLocator(const Mesh<dim> &of_mesh,
                              const std::vector<unsigned int> &cells)
  : mesh(of_mesh)
{
  std::vector<std::pair<dealii::BoundingBox<dim>, unsigned int>> all;
  all.reserve(cells.size());
  for (const unsigned int cell : cells)
    {
      all.emplace_back(box_of(mesh, cell), cell);
      all.back().first.extend(reach * diameter_of(all.back().first));
    }
  boxes = std::make_shared<const Boxes>(Boxes{dealii::pack_rtree(all)});
}

/** Distance of a point inside to the nearest plane of a face, negative outside; in
 * diameters of the cell. */
template <int dim>
double CellLocator<dim>::depth(const unsigned int cell,
                               const dealii::Point<dim> &point) const
{
  const auto &corners = mesh.cells[cell].vertices;
  const LinearCell<dim> reference(corners.size());
  std::vector<dealii::Point<dim>> all;
  for (const unsigned int v : corners)
    all.push_back(mesh.points[v]);
  const dealii::Point<dim> middle = mean_of(all);
  double least                    = std::numeric_limits<double>::max();
  for (unsigned int f = 0; f < reference.n_faces(); ++f)
    {
      std::vector<dealii::Point<dim>> face;
      for (const unsigned int v : reference.corners_of_face(f))
        face.push_back(all[v]);
      const dealii::Tensor<1, dim> normal = normal_of(face);
      const dealii::Point<dim> on_plane   = mean_of(face);
      const double inward                 = (middle - on_plane) * normal > 0. ? 1. : -1.;
      least = std::min(least, inward * ((point - on_plane) * normal) / normal.norm());
    }
  return least / diameter_of(box_of(mesh, cell));
}

template <int dim>
std::optional<unsigned int> CellLocator<dim>::find(const dealii::Point<dim> &point) const
{
  namespace index = boost::geometry::index;
  std::optional<unsigned int> best;
  double most = -reach;
  for (const auto &candidate :
       boxes->tree | index::adaptors::queried(index::intersects(point)))
    {
      // Cells are equally good if the point is inside or on a face: the largest number
      // decides.
      double inside = depth(candidate.second, point);
      if (inside > -on_face)
        inside = 1. + candidate.second;
      if (inside >= most)
        {
          most = inside;
          best = candidate.second;
        }
    }
  return best;
}

template class CellLocator<2>;
template class CellLocator<3>;
} // namespace mesoslip
