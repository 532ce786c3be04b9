#include "mesh/cell_gradients.h"

#include "mesh/linear_cell.h"

namespace mesoslip
{
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
      // From the first corner, so that no digits are lost far from the origin.
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
