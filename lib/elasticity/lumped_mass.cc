#include "elasticity/element_operator.h"

#include "mesh/linear_cell.h"

#include <map>

namespace mesoslip
{
namespace
{
/** Shape functions of one kind of cells at quadrature points. */
template <int dim>
struct ShapeTable
{
  explicit ShapeTable(const std::size_t n_corners)
  {
    const LinearCell<dim> shape(n_corners);
    const auto quadrature = shape.quadrature();
    weights               = quadrature.get_weights();
    for (const auto &point : quadrature.get_points())
      for (unsigned int v = 0; v < n_corners; ++v)
        {
          value.push_back(shape.shape(point, v));
          gradient.push_back(shape.gradient(point, v));
        }
  }

  std::vector<double> weights, value; ///< value: [point][corner]
  std::vector<dealii::Tensor<1, dim>> gradient;
};
} // namespace

template <int dim>
std::vector<double> lumped_mass(const std::vector<dealii::Point<dim>> &points,
                                const std::vector<Cell> &cells,
                                const std::vector<ElasticPhase<dim>> &phases)
{
  std::vector<double> mass(points.size());
  std::map<std::size_t, ShapeTable<dim>> tables; // key: number of corners
  for (const auto &cell : cells)
    {
      const std::size_t n  = cell.vertices.size();
      const auto &table    = tables.try_emplace(n, n).first->second;
      const double density = phases[cell.material_id].density;
      for (std::size_t q = 0; q < table.weights.size(); ++q)
        {
          dealii::Tensor<2, dim> J;
          for (unsigned int v = 0; v < n; ++v)
            J += outer_product(points[cell.vertices[v]], table.gradient[q * n + v]);
          for (unsigned int v = 0; v < n; ++v)
            mass[cell.vertices[v]] +=
              density * determinant(J) * table.weights[q] * table.value[q * n + v];
        }
    }
  return mass;
}

template std::vector<double> lumped_mass(const std::vector<dealii::Point<2>> &,
                                         const std::vector<Cell> &,
                                         const std::vector<ElasticPhase<2>> &);
template std::vector<double> lumped_mass(const std::vector<dealii::Point<3>> &,
                                         const std::vector<Cell> &,
                                         const std::vector<ElasticPhase<3>> &);
} // namespace mesoslip
