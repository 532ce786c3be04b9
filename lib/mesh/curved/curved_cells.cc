#include "mesh/curved/curved_cells.h"

#include "mesh/linear_cell.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace mesoslip
{
namespace
{
/** A cell with nodes at corners and edge middles, on quadrilaterals and hexahedra also at
 * the middles of faces and cell. */
template <int dim>
class QuadraticCell
{
public:
  explicit QuadraticCell(const std::size_t n_corners)
  {
    using namespace dealii;
    const bool is_simplex = n_corners == dim + 1;
    if (is_simplex)
      element = std::make_unique<FE_SimplexP<dim>>(2);
    else
      element = std::make_unique<FE_Q<dim>>(2);
    quadrature = is_simplex ? Quadrature<dim>(QGaussSimplex<dim>(3))
                            : Quadrature<dim>(QGauss<dim>(3));
    const LinearCell<dim> linear(n_corners);
    for (const Point<dim> &node : element->get_unit_support_points())
      {
        around.emplace_back();
        for (unsigned int v = 0; v < n_corners; ++v)
          if (linear.shape(node, v) > 1e-6)
            around.back().push_back(v);
      }
  }

  /** Volume and smallest Jacobian of the cell with these @p nodes (m). */
  CurvedCell measure(const std::vector<dealii::Point<dim>> &nodes) const
  {
    const auto jacobian = [&](const dealii::Point<dim> &xi) {
      dealii::Tensor<2, dim> derivative;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        derivative += outer_product(nodes[i] - nodes[0], element->shape_grad(i, xi));
      return determinant(derivative);
    };
    CurvedCell result;
    result.least_jacobian = std::numeric_limits<double>::max();
    const auto meet       = [&result](const double value) {
      if (!(value >= result.least_jacobian))
        result.least_jacobian = value;
      return value;
    };
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      result.volume += quadrature.weight(q) * meet(jacobian(quadrature.point(q)));
    for (const dealii::Point<dim> &node : element->get_unit_support_points())
      meet(jacobian(node));
    return result;
  }

  std::vector<std::vector<unsigned int>>
    around; ///< per node the corners whose mean it is

private:
  std::unique_ptr<dealii::FiniteElement<dim>> element;
  dealii::Quadrature<dim> quadrature;
};

/** Both kinds of cells of a mesh. */
template <int dim>
struct QuadraticCells
{
  const QuadraticCell<dim> &of(const Cell &cell) const
  {
    return cell.vertices.size() == dim + 1 ? simplex : cube;
  }

  QuadraticCell<dim> simplex = QuadraticCell<dim>(dim + 1),
                     cube    = QuadraticCell<dim>(1U << dim);
};

/** The bulge of the edge, face or cell with these @p corners, in any order; nullptr if it
 * is straight. */
template <int dim>
const Bulge<dim> *find_bulge(const Mesh<dim> &mesh, std::vector<unsigned int> corners)
{
  std::sort(corners.begin(), corners.end());
  const auto found = std::lower_bound(
    mesh.bulges.begin(), mesh.bulges.end(), corners,
    [](const Bulge<dim> &bulge, const auto &wanted) { return bulge.corners < wanted; });
  return found != mesh.bulges.end() && found->corners == corners ? &*found : nullptr;
}

/** Corners around a node of a quadratic cell: the entries @p around of @p vertices. */
std::vector<unsigned int> at(const std::vector<unsigned int> &vertices,
                             const std::vector<unsigned int> &around)
{
  std::vector<unsigned int> corners;
  for (const unsigned int v : around)
    corners.push_back(vertices[v]);
  return corners;
}
} // namespace

template <int dim>
std::vector<CurvedNode<dim>> curved_nodes(const Mesh<dim> &mesh)
{
  std::vector<CurvedNode<dim>> result;
  if (mesh.bulges.empty())
    return result;
  const QuadraticCells<dim> cells;
  for (unsigned int k = 0; k < mesh.cells.size(); ++k)
    {
      const auto &around = cells.of(mesh.cells[k]).around;
      for (unsigned int n = mesh.cells[k].vertices.size(); n < around.size(); ++n)
        if (const auto *bulge = find_bulge(mesh, at(mesh.cells[k].vertices, around[n])))
          {
            result.push_back({k, n, {}});
            for (unsigned int d = 0; d < dim; ++d)
              result.back().offset[d] = bulge->offset[d];
          }
    }
  return result;
}

template <int dim>
std::vector<CurvedCell> curved_cells(const Mesh<dim> &mesh)
{
  const std::vector<CurvedNode<dim>> curved = curved_nodes(mesh);
  std::vector<CurvedCell> result;
  const QuadraticCells<dim> cells;
  std::vector<dealii::Point<dim>> nodes;
  for (std::size_t k = 0; k < curved.size();)
    {
      const unsigned int number      = curved[k].cell;
      const QuadraticCell<dim> &cell = cells.of(mesh.cells[number]);
      nodes.clear();
      for (const auto &around : cell.around)
        {
          nodes.emplace_back();
          for (const unsigned int v : at(mesh.cells[number].vertices, around))
            nodes.back() += mesh.points[v] / static_cast<double>(around.size());
        }
      for (; k < curved.size() && curved[k].cell == number; ++k)
        for (unsigned int d = 0; d < dim; ++d)
          nodes[curved[k].node][d] += curved[k].offset[d];
      result.push_back(cell.measure(nodes));
      result.back().cell = number;
    }
  return result;
}

template <int dim>
double bulge_of_face(const Mesh<dim> &mesh,
                     const std::vector<unsigned int> &corners,
                     const unsigned int axis)
{
  double largest  = 0.;
  const auto meet = [&](const std::vector<unsigned int> &some) {
    if (const Bulge<dim> *bulge = find_bulge(mesh, some))
      largest = std::max(largest, std::abs(bulge->offset[axis]));
  };
  if (mesh.bulges.empty())
    return largest;
  meet(corners);
  for (const unsigned int a : corners)
    for (const unsigned int b : corners)
      if (a < b)
        meet({a, b});
  return largest;
}

template double
bulge_of_face(const Mesh<2> &, const std::vector<unsigned int> &, const unsigned int);
template double
bulge_of_face(const Mesh<3> &, const std::vector<unsigned int> &, const unsigned int);
template std::vector<CurvedNode<2>> curved_nodes(const Mesh<2> &);
template std::vector<CurvedNode<3>> curved_nodes(const Mesh<3> &);
template std::vector<CurvedCell> curved_cells(const Mesh<2> &);
template std::vector<CurvedCell> curved_cells(const Mesh<3> &);
} // namespace mesoslip
