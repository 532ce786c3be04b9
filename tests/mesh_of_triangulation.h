#ifndef mesoslip_tests_mesh_of_triangulation_h
#define mesoslip_tests_mesh_of_triangulation_h

#include "mesh/triangulation_cells.h"

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

namespace mesoslip
{
/** Gives @p mesh the points and cells of the coarse @p triangulation. */
template <typename MeshType, int dim>
void take_cells(MeshType &mesh, const dealii::Triangulation<dim> &triangulation)
{
  auto [points, cells, faces] =
    dealii::GridTools::get_coarse_mesh_description(triangulation);
  mesh.points = std::move(points);
  mesh.cells  = from_dealii<dim>(std::move(cells));
}
} // namespace mesoslip

#endif
