#include "mesh/cell_shapes.h"

#include "mesh/linear_cell.h"

namespace mesoslip
{
// Newton's method from the cell centre; simplices converge in one step.
template <int dim>
CellShapes<dim> shapes_at(const Mesh<dim> &mesh,
                          const std::vector<unsigned int> &corners,
                          const dealii::Point<dim> &point)
{
  constexpr unsigned int most_steps = 50;
  constexpr double round_off        = 1e-14;
  const LinearCell<dim> cell(corners.size());
  dealii::Point<dim> xi = cell.barycenter();
  dealii::Tensor<2, dim> inverse; // d xi_i / d x_j
  for (unsigned int k = 0; k < most_steps; ++k)
    {
      dealii::Tensor<1, dim> left = point - mesh.points[corners[0]];
      dealii::Tensor<2, dim> jacobian; // dx_i / dxi_j
      for (unsigned int v = 0; v < corners.size(); ++v)
        {
          const dealii::Tensor<1, dim> x =
            mesh.points[corners[v]] - mesh.points[corners[0]];
          left -= cell.shape(xi, v) * x;
          jacobian += outer_product(x, cell.gradient(xi, v));
        }
      inverse                           = invert(jacobian);
      const dealii::Tensor<1, dim> step = inverse * left;
      xi += step;
      if (!(step.norm() > round_off))
        break;
    }
  CellShapes<dim> shapes;
  for (unsigned int v = 0; v < corners.size(); ++v)
    {
      shapes.values.push_back(cell.shape(xi, v));
      shapes.gradients.push_back(transpose(inverse) * cell.gradient(xi, v));
    }
  return shapes;
}

template CellShapes<2>
shapes_at(const Mesh<2> &, const std::vector<unsigned int> &, const dealii::Point<2> &);
template CellShapes<3>
shapes_at(const Mesh<3> &, const std::vector<unsigned int> &, const dealii::Point<3> &);

namespace
{
/**
 * Calls @p action with the inverse of the transposed Jacobian, the weight (m^dim) and the
 * point in the reference cell of each quadrature point.
 */
template <int dim, typename Action>
void for_each_quadrature_point(const Mesh<dim> &mesh,
                               const std::vector<unsigned int> &corners,
                               const Action &action)
{
  const LinearCell<dim> cell(corners.size());
  const auto quadrature = cell.quadrature();
  for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      dealii::Tensor<2, dim> jacobian; // dx_i / dxi_j
      // Relative to the first corner, to keep accuracy far from the origin.
      for (unsigned int v = 0; v < corners.size(); ++v)
        jacobian += outer_product(mesh.points[corners[v]] - mesh.points[corners[0]],
                                  cell.gradient(quadrature.point(q), v));
      action(transpose(invert(jacobian)), quadrature.weight(q) * determinant(jacobian),
             quadrature.point(q));
    }
}
} // namespace

template <int dim>
std::vector<dealii::Tensor<1, dim>>
integrated_gradients(const Mesh<dim> &mesh, const std::vector<unsigned int> &corners)
{
  const LinearCell<dim> cell(corners.size());
  std::vector<dealii::Tensor<1, dim>> result(corners.size());
  for_each_quadrature_point(
    mesh, corners,
    [&](const dealii::Tensor<2, dim> &inverse, const double weight, const auto &xi) {
      for (unsigned int v = 0; v < corners.size(); ++v)
        result[v] += weight * (inverse * cell.gradient(xi, v));
    });
  return result;
}

template <int dim>
CellMeasure<dim> cell_measure(const Mesh<dim> &mesh,
                              const std::vector<unsigned int> &corners)
{
  const LinearCell<dim> cell(corners.size());
  CellMeasure<dim> result;
  dealii::Tensor<1, dim> moment;
  for_each_quadrature_point(
    mesh, corners,
    [&](const dealii::Tensor<2, dim> &, const double weight, const auto &xi) {
      result.volume += weight;
      for (unsigned int v = 0; v < corners.size(); ++v)
        moment += weight * cell.shape(xi, v) *
                  (mesh.points[corners[v]] - mesh.points[corners[0]]);
    });
  result.centroid = mesh.points[corners[0]] + moment / result.volume;
  return result;
}

template std::vector<dealii::Tensor<1, 2>>
integrated_gradients(const Mesh<2> &, const std::vector<unsigned int> &);
template std::vector<dealii::Tensor<1, 3>>
integrated_gradients(const Mesh<3> &, const std::vector<unsigned int> &);
template CellMeasure<2> cell_measure(const Mesh<2> &, const std::vector<unsigned int> &);
template CellMeasure<3> cell_measure(const Mesh<3> &, const std::vector<unsigned int> &);
} // namespace mesoslip
