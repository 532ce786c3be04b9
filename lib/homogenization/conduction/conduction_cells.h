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
/** Mesh of a volume element for conduction, on one rank: linear cells with a material
 * each. */
template <int dim>
struct ConductionCells
{
  /** A box. Mesh::masters are the periodic masters, Cell::material_id is the
   * material. */
  Mesh<dim> mesh;

  std::vector<Tensor2<dim>> conductivity; ///< per material (W/(m K) or S/m)

  /** Points on the sides, numbered as deal.II does: 2 d at the lower, 2 d + 1 at the
   * upper end of axis d. */
  std::array<std::vector<unsigned int>, 2UL * dim> sides;

  std::string not_periodic; ///< why opposite sides do not match; empty: they match

  bool are_equal = false; ///< whether all cells have one shape and size
};

/** The cells of a grid, material 0; without conductivities. */
template <int dim>
ConductionCells<dim> conduction_cells(const UniformGrid<dim> &grid);

/** The cells of a mesh whose body is a box; material_id is taken from @p mesh.
 * @throws UserError if the body is not a box */
template <int dim>
ConductionCells<dim> conduction_cells(const Mesh<dim> &mesh);
} // namespace mesoslip

#endif
