#include "sliding/mesh/box_body.h"

#include "base/files.h"
#include "base/text.h"
#include "exchange/mesh_datasets.h"
#include "exchange/rve_file.h"
#include "material/plausibility.h"
#include "program/output_folder.h"
#include "sliding/body_grid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace mesoslip
{
namespace
{
/** Rank 0 holds the mesh of all cells and its own part of it. */
constexpr double bytes_of_cell = 600.;

std::string grid_line(const UniformGrid<3> &grid)
{
  const auto &n = grid.cells;
  const auto &h = grid.spacing;
  return brief_text(4, "Grid: ", n[0], " x ", n[1], " x ", n[2], " cells of ", h[0],
                    " x ", h[1], " x ", h[2], " m, ", grid.extent(0), " x ",
                    grid.extent(1), " x ", grid.extent(2), " m");
}

void describe_phases(MeshMorphology<3> &box, const std::vector<PhaseParameters> &phases)
{
  std::vector<std::size_t> count(phases.size(), 0);
  for (const auto &cell : box.mesh.cells)
    ++count[cell.material_id];
  const auto n = static_cast<double>(box.mesh.cells.size());
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      box.fractions.push_back(static_cast<double>(count[p]) / n);
      box.description.push_back(brief_text(6, "Phase ", p, ", ", phases[p].name, ": ",
                                           count[p], " cells, ", 100. * box.fractions[p],
                                           " %; ", phases[p].text<3>()));
      if (count[p] == 0)
        box.warnings.push_back("phase '" + phases[p].name +
                               "' fills no cell of the body");
    }
}

/** The groups as a mesh has them. */
void add_sides(MeshMorphology<3> &box)
{
  box.mesh.boundaries = {"Left", "Right", "Front", "Back", "Contact", "Top"};
  for (unsigned int side = 0; side < 6; ++side)
    for (const BoundaryFace<3> &face : faces_of_side(*box.box, side))
      {
        auto &added = box.mesh.faces.emplace_back(4);
        std::copy(face.points.begin(), face.points.end(), added.vertices.begin());
        added.boundary_id = side;
      }
}
} // namespace

std::vector<BoundaryFace<3>> faces_of_side(const BrickBox &box, const unsigned int side)
{
  const auto &n           = box.grid.cells;
  const unsigned int axis = side / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
  std::vector<BoundaryFace<3>> faces;
  for (unsigned int j = 0; j < n[std::max(a, b)]; ++j)
    for (unsigned int i = 0; i < n[std::min(a, b)]; ++i)
      {
        std::array<unsigned int, 3> cell;
        cell[axis]           = side % 2 == 0 ? 0 : n[axis] - 1;
        cell[std::min(a, b)] = i;
        cell[std::max(a, b)] = j;
        BoundaryFace<3> face;
        face.n_points = 4;
        face.cell     = (cell[2] * n[1] + cell[1]) * n[0] + cell[0];
        // In deal.II the first coordinate of a face is the lower of its axes but in y.
        const unsigned int first  = axis == 1 ? 2 : std::min(a, b),
                           second = axis == 1 ? 0 : std::max(a, b);
        for (unsigned int v = 0; v < 4; ++v)
          {
            std::array<unsigned int, 3> node = cell;
            node[axis] += side % 2;
            node[first] += v & 1U;
            node[second] += v >> 1U;
            face.points[v] = (node[2] * (n[1] + 1) + node[1]) * (n[0] + 1) + node[0];
          }
        faces.push_back(face);
      }
  return faces;
}

std::vector<unsigned int> cells_near(const BrickBox &box,
                                     const std::vector<ProbePoint> &points)
{
  std::set<unsigned int> cells;
  const UniformGrid<3> &grid = box.grid;
  for (const ProbePoint &point : points)
    {
      std::array<long, 3> middle = {};
      for (unsigned int d = 0; d < 3; ++d)
        middle[d] = std::lround(
          std::floor(std::clamp((point.position[d] - grid.origin[d]) / grid.spacing[d],
                                -2., grid.cells[d] + 2.)));
      for (unsigned int k = 0; k < 27; ++k)
        {
          const std::array<long, 3> at = {
            {middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1}};
          bool inside = true;
          for (unsigned int d = 0; d < 3; ++d)
            inside = inside && at[d] >= 0 && at[d] < static_cast<long>(grid.cells[d]);
          if (inside)
            cells.insert(static_cast<unsigned int>(
              (at[2] * grid.cells[1] + at[1]) * grid.cells[0] + at[0]));
        }
    }
  return {cells.begin(), cells.end()};
}

MeshMorphology<3> make_box(const ContactParameters &parameters)
{
  const std::string &path = parameters.body.rve_file;
  std::optional<RveFile<3>> rve;
  if (!path.empty())
    {
      require_readable_file("Body/RVE file: ", path, "run rve_homogenization first");
      rve.emplace(path);
    }
  MeshMorphology<3> box;
  const UniformGrid<3> grid = make_grid<3>(parameters.body, rve ? &*rve : nullptr);
  double n_cells            = bytes_of_cell;
  for (const unsigned int n : grid.cells)
    n_cells *= n;
  require_memory({n_cells, "reduce Body/Cells"});
  box.file = path;
  box.box  = {
     grid, {{!parameters.mesh.periodic[0].empty(), !parameters.mesh.periodic[1].empty()}}};
  box.mesh        = mesh_of_cells(grid);
  box.description = {grid_line(grid)};
  if (parameters.body.heterogeneous)
    {
      const std::vector<std::uint8_t> id = refine(*rve, grid);
      for (std::size_t k = 0; k < id.size(); ++k)
        box.mesh.cells[k].material_id = id[k];
    }
  for (const PhaseParameters &phase : parameters.mesh.phases)
    box.mesh.phases.push_back(phase.name);
  box.phases = make_phases<3>(parameters.mesh.phases);
  describe_phases(box, parameters.mesh.phases);
  add_sides(box);
  return box;
}
} // namespace mesoslip
