#include "sliding/mesh/box_body.h"

#include "base/files.h"
#include "base/object_exchange.h"
#include "base/text.h"
#include "body/brick_body.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"
#include "exchange/mesh_datasets.h"
#include "exchange/rve/orientation_datasets.h"
#include "exchange/rve_file.h"
#include "material/plausibility.h"
#include "program/output_folder.h"
#include "sliding/body_grid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

namespace mesoslip
{
namespace
{
std::string grid_line(const UniformGrid<3> &grid)
{
  const auto &n = grid.cells;
  const auto &h = grid.spacing;
  return brief_text(4, "Grid: ", n[0], " x ", n[1], " x ", n[2], " cells of ", h[0],
                    " x ", h[1], " x ", h[2], " m, ", grid.extent(0), " x ",
                    grid.extent(1), " x ", grid.extent(2), " m");
}

/** Reader of the cell materials of a body on @p grid: materials of @p rve, or a single
 * material. */
CellReader reader_of_box(const BodyParameters &parameters,
                         const UniformGrid<3> &grid,
                         const std::shared_ptr<const RveFile<3>> &rve)
{
  if (!parameters.heterogeneous)
    return [](const CellBlock<3> &block) {
      return std::vector<std::uint16_t>(block.n_cells());
    };
  return [section = parameters.section, rve, grid](const CellBlock<3> &block) {
    return constituents_in(section, *rve, grid, block);
  };
}

/** Sets the materials of the mesh's cells, ascending in the box. Reads the box in layers.
 * @return the number of cells of each phase in the whole box */
std::vector<std::size_t> find_materials(BoxBody &box)
{
  std::vector<std::size_t> count(box.phases.size());
  auto &cells        = box.mesh.cells;
  std::size_t number = 0;
  unsigned int next  = 0;
  for_each_piece(whole_block(box.box.grid), [&](const CellBlock<3> &block) {
    for (const std::uint16_t material : box.materials_in(block))
      {
        ++count[box.phase_of(material)];
        if (next < cells.size() && box.whole_cell(next) == number)
          cells[next++].material_id = material;
        ++number;
      }
  });
  return count;
}

void describe_phases(BoxBody &box,
                     const std::vector<PhaseParameters> &phases,
                     const std::vector<std::size_t> &count)
{
  const auto n = static_cast<double>(box.n_cells());
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

/** Numbers of the cells that hold @p points and their neighbours, ascending. */
std::vector<unsigned int> cells_around(const UniformGrid<3> &grid,
                                       const std::vector<ProbePoint> &points)
{
  std::set<unsigned int> cells;
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

/** Numbers of the cells at the sides, ascending. */
std::vector<unsigned int> cells_at_sides(const std::array<unsigned int, 3> &n)
{
  std::vector<unsigned int> cells;
  const auto is_end = [&](const unsigned int i, const unsigned int axis) {
    return i == 0 || i + 1 == n[axis];
  };
  for (unsigned int k = 0; k < n[2]; ++k)
    for (unsigned int j = 0; j < n[1]; ++j)
      {
        const bool all           = is_end(k, 2) || is_end(j, 1);
        const unsigned int first = (k * n[1] + j) * n[0], last = n[0] - 1;
        for (unsigned int i = 0; i <= last; i += all || last == 0 ? 1 : last)
          cells.push_back(first + i);
      }
  return cells;
}

/** Makes the mesh of these @p cells, ascending. */
void keep_cells(BoxBody &body, std::vector<unsigned int> cells)
{
  const UniformGrid<3> &grid = body.box.grid;
  auto &points               = body.point_in_box;
  for (const unsigned int cell : cells)
    for (const unsigned int corner : grid.corners(cell))
      points.push_back(corner);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  points.shrink_to_fit();
  for (const unsigned int p : points)
    body.mesh.points.push_back(body.point(p));
  for (const unsigned int cell : cells)
    {
      const auto corners = grid.corners(cell);
      auto &vertices     = body.mesh.cells.emplace_back(8).vertices;
      for (unsigned int v = 0; v < 8; ++v)
        vertices[v] = static_cast<unsigned int>(
          std::lower_bound(points.begin(), points.end(), corners[v]) - points.begin());
    }
  body.cell_in_box = std::move(cells);
}
} // namespace

std::vector<BoundaryFace<3>>
BoxBody::group(const std::vector<BoundaryFace<3>> & /*faces*/,
               const std::string & /*key*/,
               const unsigned int group) const
{
  const std::array<unsigned int, 3> &n = box.grid.cells;
  const unsigned int axis = group / 2, end = group % 2;
  // deal.II: the first coordinate of a face is the lower of its axes, except for faces
  // across y.
  const unsigned int first = (axis + 1) % 3, second = (axis + 2) % 3,
                     lower = axis == 1 ? first : std::min(first, second),
                     upper = first + second - lower;
  std::vector<BoundaryFace<3>> faces;
  for (unsigned int k = 0; k < mesh.cells.size(); ++k)
    {
      const unsigned int number               = whole_cell(k);
      const std::array<unsigned int, 3> place = {
        {number % n[0], number / n[0] % n[1], number / n[0] / n[1]}};
      if (place[axis] != (end == 0 ? 0 : n[axis] - 1))
        continue;
      BoundaryFace<3> &face = faces.emplace_back();
      face.n_points         = 4;
      face.cell             = k;
      for (unsigned int v = 0; v < 4; ++v)
        face.points[v] =
          mesh.cells[k]
            .vertices[(end << axis) | ((v & 1U) << lower) | ((v >> 1U) << upper)];
    }
  return faces;
}

std::vector<MeshPlace> BoxBody::places_of(const std::vector<ProbePoint> &points) const
{
  std::vector<unsigned int> cells = cells_around(box.grid, points);

  std::vector<unsigned int> found;
  for (const unsigned int cell : cells)
    if (const auto at = std::lower_bound(cell_in_box.begin(), cell_in_box.end(), cell);
        at != cell_in_box.end() && *at == cell)
      found.push_back(static_cast<unsigned int>(at - cell_in_box.begin()));
  return locate_probes(mesh, points, found);
}

BodyMemory BoxBody::read(const ContactParameters &parameters,
                         const unsigned int n_here,
                         const unsigned int n_ranks)
{
  const std::string &path = parameters.body.rve_file;

  std::shared_ptr<const RveFile<3>> rve;
  if (!path.empty())
    {
      require_readable_file(parameters.body.section + "/RVE file: ", path,
                            "run rve_homogenization first");
      rve = std::make_shared<const RveFile<3>>(path);
    }
  UniformGrid<3> grid = make_grid<3>(parameters.body, rve.get());
  if (parameters.is_counter)
    grid.origin[2] = -grid.extent(2); // position as in files
  const BodyMemory memory = memory_of_box(parameters, grid);
  const double bytes      = memory.on_machine(n_here, n_ranks);
  require_memory({bytes, cells_that_fit({grid.cells.begin(), grid.cells.end()}, bytes) +
                           "; reduce Body/Cells, or take more machines"});
  file         = path;
  box          = {grid,
                  {{!parameters.mesh.periodic[0].empty(), !parameters.mesh.periodic[1].empty()}}};
  description  = {grid_line(grid)};
  materials_in = reader_of_box(parameters.body, grid, rve);
  if (parameters.body.heterogeneous)
    oriented = rve->materials.oriented;
  const auto at_sides = cells_at_sides(grid.cells),
             near     = cells_around(grid, parameters.observation.probes);
  std::vector<unsigned int> cells;
  std::set_union(at_sides.begin(), at_sides.end(), near.begin(), near.end(),
                 std::back_inserter(cells));
  keep_cells(*this, cells);
  mesh.boundaries = {"Left", "Right", "Front", "Back"};
  mesh.boundaries.emplace_back(parameters.is_counter ? "Bottom" : "Contact");
  mesh.boundaries.emplace_back(parameters.is_counter ? "Contact" : "Top");
  phases = make_phases<3>(parameters.mesh.phases);
  for (const Phase<3> &material : materials())
    mesh.phases.push_back(material.name);
  describe_phases(*this, parameters.mesh.phases, find_materials(*this));
  if (!oriented.empty())
    description.push_back("Orientations: " + std::to_string(oriented.size()) +
                          " different pairs of phase and orientation");
  join_periodic_sides(*this, parameters.mesh); // points are opposite
  return memory;
}

void BoxBody::share(const BodyParameters &parameters)
{
  broadcast_object(MPI_COMM_WORLD, box);
  on_all_ranks(MPI_COMM_WORLD, [&]() {
    if (materials_in)
      return;
    std::shared_ptr<const RveFile<3>> rve;
    if (parameters.heterogeneous)
      rve = std::make_shared<const RveFile<3>>(RveFile<3>::open_too(parameters.rve_file));
    materials_in = reader_of_box(parameters, box.grid, rve);
  });
}

double BoxBody::smallest_edge() const
{
  return *std::min_element(box.grid.spacing.begin(), box.grid.spacing.end());
}

dealii::Point<3> BoxBody::point(const unsigned int number) const
{
  const auto place = box.grid.node(number);
  return {place[0], place[1], place[2]};
}

std::unique_ptr<DistributedBody<3>>
BoxBody::distribute(const std::vector<unsigned int> & /*contact*/,
                    const std::vector<MeshPlace> &probes,
                    const std::vector<ElasticPhase<3>> &phases,
                    const InstructionSet isa,
                    const MPI_Comm communicator) const
{
  return distribute_box(box, materials_in, probes, phases, isa, communicator);
}

std::unique_ptr<PointBody<3>>
BoxBody::make_elastic(const MeshBodyParameters & /*parameters*/,
                      const std::string & /*contact*/,
                      const std::string & /*top*/,
                      const std::vector<ElasticPhase<3>> &phases,
                      const MPI_Comm communicator,
                      const bool whole) const
{
  return std::make_unique<GridBody<3>>(box, materials_in, phases, communicator, whole);
}

Deformation BoxBody::deformation(const PointBody<3> &elastic,
                                 const NodalField<double> &u) const
{
  const auto &body = dynamic_cast<const GridBody<3> &>(elastic);
  voxel::VoxelField<double> field(body.stiffness().grid);
  body.to_voxels(u, field);
  const PlaneRange planes = body.cell_planes();
  return largest_deformation(
    box.grid, planes,
    [&](const unsigned int c, const unsigned int j, const unsigned int k) {
      return field.row(c, j % field.n_nodes()[1] + 1, k - planes.first + 1) + 1;
    },
    body.communicator());
}

void BoxBody::write_cells(Hdf5File &to) const
{
  write_grid(to, box.grid);
  write_materials(to, body_phases_dataset, box.grid, oriented, materials_in);
}

Shape BoxBody::vectors_shape() const
{
  const auto &n = box.grid.cells;
  return {std::size_t{n[2]} + 1, std::size_t{n[1]} + 1, std::size_t{n[0]} + 1, 3};
}

void BoxBody::show(const std::string &path,
                   const std::vector<XdmfField> &fields,
                   const std::vector<double> &times) const
{
  show_file(path, box.grid, fields, times,
            {{"phase", body_phases_dataset, XdmfField::Values::phases, {}}});
}
} // namespace mesoslip
