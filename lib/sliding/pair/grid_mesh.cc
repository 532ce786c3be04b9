#include "sliding/pair/grid_mesh.h"

#include "base/text.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"
#include "sliding/body_memory.h"
#include "sliding/given_grid.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
BodyMemory GridMesh::read(const ContactParameters &parameters,
                          const unsigned int /*n_here*/,
                          const unsigned int /*n_ranks*/)
{
  body = make_body(parameters, 1);
  if (parameters.is_counter)
    body.grid.origin[1] = -body.grid.extent(1); // position as in files
  file            = parameters.body.rve_file;
  mesh.boundaries = {"Left", "Right"};
  mesh.boundaries.emplace_back(parameters.is_counter ? "Bottom" : "Contact");
  mesh.boundaries.emplace_back(parameters.is_counter ? "Contact" : "Top");
  make_mesh();
  name_sides();
  description = {"Body: " + size_text(body.grid)};
  phases      = make_phases<2>(parameters.mesh.phases);
  fractions   = body.fractions(body.grid.n_cells());
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      mesh.phases.push_back(phases[p].name);
      description.push_back(brief_text(6, "Phase ", p, ", ", phases[p].name, ": ",
                                       100. * fractions[p], " %; ",
                                       parameters.mesh.phases[p].text<2>()));
    }
  warnings = body.warnings;
  join_periodic_sides(*this, parameters.mesh);
  return memory_on_mesh(parameters, mesh);
}

void GridMesh::make_mesh()
{
  const UniformGrid<2> &grid = body.grid;
  for (unsigned int k = 0; k < grid.n_nodes(); ++k)
    {
      const auto place = grid.node(k);
      mesh.points.emplace_back(place[0], place[1]);
    }
  for (unsigned int k = 0; k < grid.n_cells(); ++k)
    {
      const auto corners = grid.corners(k);
      Cell &cell         = mesh.cells.emplace_back(corners.size());
      std::copy(corners.begin(), corners.end(), cell.vertices.begin());
      cell.material_id = static_cast<unsigned int>(body.phase_of(k));
    }
}

/** Groups the edges of the sides. */
void GridMesh::name_sides()
{
  const UniformGrid<2> &grid = body.grid;
  for (const BoundaryFace<2> &face : boundary_faces(mesh))
    for (unsigned int side = 0; side < 4; ++side)
      {
        const unsigned int axis = side / 2;
        const double level      = grid.origin[axis] + side % 2 * grid.extent(axis),
                     near       = 1e-3 * grid.spacing[axis];
        const auto is_there     = [&](const unsigned int point) {
          return std::fabs(mesh.points[point][axis] - level) < near;
        };
        if (!is_there(face.points[0]) || !is_there(face.points[1]))
          continue;
        Face &named       = mesh.faces.emplace_back(2);
        named.vertices    = {face.points[0], face.points[1]};
        named.boundary_id = side;
      }
}

void GridMesh::write_cells(Hdf5File &to) const
{
  write_grid(to, body.grid);
  if (!body.phase_id.empty())
    write_dataset(to, body_phases_dataset, {body.grid.cells[1], body.grid.cells[0]},
                  body.phase_id);
}

Shape GridMesh::vectors_shape() const
{
  return nodes_shape(body.grid);
}

void GridMesh::show(const std::string &path,
                    const std::vector<XdmfField> &fields,
                    const std::vector<double> &times) const
{
  show_grid(path, body.grid, !body.phase_id.empty(), fields, times);
}
} // namespace mesoslip
