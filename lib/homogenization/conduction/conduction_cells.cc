#include "homogenization/conduction/conduction_cells.h"

#include "base/errors.h"
#include "exchange/mesh_datasets.h"
#include "mesh/boundary.h"
#include "mesh/cell_quality.h"
#include "mesh/periodic_points.h"

#include <set>

namespace mesoslip
{
template <int dim>
ConductionCells<dim> conduction_cells(const UniformGrid<dim> &grid)
{
  ConductionCells<dim> cells;
  cells.mesh      = mesh_of_cells(grid);
  cells.are_equal = true;
  cells.mesh.masters.resize(cells.mesh.points.size());
  for (unsigned int p = 0; p < cells.mesh.points.size(); ++p)
    {
      unsigned int rest = p, stride = 1, master = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int n = grid.cells[d], index = rest % (n + 1);
          rest /= n + 1;
          master += stride * (index % n);
          stride *= n + 1;
          if (index == 0)
            cells.sides[2 * d].push_back(p);
          if (index == n)
            cells.sides[2 * d + 1].push_back(p);
        }
      cells.mesh.masters[p] = master;
    }
  return cells;
}

template <int dim>
ConductionCells<dim> conduction_cells(const Mesh<dim> &mesh)
{
  ConductionCells<dim> cells;
  cells.mesh        = mesh;
  const auto faces  = faces_of_box(mesh, boundary_faces(mesh));
  const double edge = cell_quality(mesh).smallest_edge;
  try
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        join_sides(cells.mesh, faces[2 * axis], faces[2 * axis + 1], axis, edge);
    }
  catch (const UserError &e)
    {
      cells.not_periodic = e.what();
    }
  for (unsigned int side = 0; side < 2 * dim; ++side)
    {
      std::set<unsigned int> points;
      for (const BoundaryFace<dim> &face : faces[side])
        points.insert(face.points.begin(), face.points.begin() + face.n_points);
      cells.sides[side].assign(points.begin(), points.end());
    }
  return cells;
}

template ConductionCells<2> conduction_cells(const UniformGrid<2> &);
template ConductionCells<3> conduction_cells(const UniformGrid<3> &);
template ConductionCells<2> conduction_cells(const Mesh<2> &);
template ConductionCells<3> conduction_cells(const Mesh<3> &);
} // namespace mesoslip
