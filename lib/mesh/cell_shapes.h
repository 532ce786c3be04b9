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
  std::vector<double> values;                    ///< they sum up to 1; negative outside
  std::vector<dealii::Tensor<1, dim>> gradients; ///< 1/m
};

/** Those of the cell with these @p corners at @p point, in the cell or near it. */
template <int dim>
CellShapes<dim> shapes_at(const Mesh<dim> &mesh,
                          const std::vector<unsigned int> &corners,
                          const dealii::Point<dim> &point);
} // namespace mesoslip

#endif
