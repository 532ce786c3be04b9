#ifndef mesoslip_homogenization_conduction_conduction_cells_h
#define mesoslip_homogenization_conduction_conduction_cells_h

#include "grid/uniform_grid.h"
#include "homogenization/conduction/conduction_response.h"
#include "mesh/mesh.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
/** A volume element as conduction needs it, on one rank: linear cells of which each has a material. */
template <int dim>
struct ConductionCells
{
  /** A box; Mesh::originals are those of its opposite points, Cell::material_id the material. */
  Mesh<dim> mesh;

  std::vector<Tensor2<dim>> conductivity; ///< of each material, W/(m K) or S/m

  /** Points on the sides, numbered as deal.II does: 2 d at the lower, 2 d + 1 at the upper end of axis d. */
  std::array<std::vector<unsigned int>, 2UL * dim> sides;

  std::string not_periodic; ///< why points are not opposite; empty: they are

  bool are_equal = false; ///< whether all cells have one shape and size
};

/** The cells of a grid, material 0; without conductivities. */
template <int dim>
ConductionCells<dim> conduction_cells(const UniformGrid<dim> &grid);

/** Those of a mesh, whose body is a box; material_id is that of @p mesh. @throws UserError if it is none */
template <int dim>
ConductionCells<dim> conduction_cells(const Mesh<dim> &mesh);
} // namespace mesoslip

#endif
