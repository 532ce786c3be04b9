#include "mesh/cell_shapes.h"

#include "mesh/linear_cell.h"

namespace mesoslip
{
// Newton's method from the middle, which triangles and tetrahedra need one step of.
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
} // namespace mesoslip
