#ifndef mesoslip_mesh_cell_shapes_h
#define mesoslip_mesh_cell_shapes_h

#include "mesh/mesh.h"

#include <vector>

namespace mesoslip
{
/** Linear shape functions of a cell at a point, by corner. */
template <int dim>
struct CellShapes
{
  std::vector<double> values;                    ///< sum is 1; negative outside the cell
  std::vector<dealii::Tensor<1, dim>> gradients; ///< 1/m
};

/** Shape functions of the cell with these @p corners at @p point, in or near the cell. */
template <int dim>
CellShapes<dim> shapes_at(const Mesh<dim> &mesh,
                          const std::vector<unsigned int> &corners,
                          const dealii::Point<dim> &point);

/** Integrals of the gradients of the shape functions of a cell (m^(dim-1)). */
template <int dim>
std::vector<dealii::Tensor<1, dim>>
integrated_gradients(const Mesh<dim> &mesh, const std::vector<unsigned int> &corners);

/** Centroid and size of a cell. */
template <int dim>
struct CellMeasure
{
  dealii::Point<dim> centroid; ///< centre of gravity (m)
  double volume = 0.;          ///< area (2D, m^2) or volume (m^3)
};

/** Centroid and size by the quadrature of integrated_gradients(). */
template <int dim>
CellMeasure<dim> cell_measure(const Mesh<dim> &mesh,
                              const std::vector<unsigned int> &corners);
} // namespace mesoslip

#endif
