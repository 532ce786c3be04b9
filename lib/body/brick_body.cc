#include "body/brick_body.h"

#include "base/exchange.h"
#include "statics/voxel/planes.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
using BrickPlace = std::array<unsigned int, 3>;

/** Number of points along each axis. */
BrickPlace n_points(const BrickBox &box)
{
  const BrickPlace &n = box.grid.cells;
  return {{n[0] + 1, n[1] + 1, n[2] + 1}};
}

/** Planes of points of a rank: its own and, except on the last rank, the next one. */
unsigned int n_planes(const BrickBox &box, const voxel::VoxelGrid &grid)
{
  return std::min(grid.n_nodes(2) + 1, box.grid.cells[2] + 1 - grid.below());
}

unsigned int n_nodes(const BrickBox &box, const voxel::VoxelGrid &grid)
{
  const BrickPlace n = n_points(box);
  return n[0] * n[1] * n_planes(box, grid);
}

/** Stiffness of the cells in the planes of this rank, read piece by piece. */
std::unique_ptr<const voxel::Stiffness>
read_stiffness(const BrickBox &box,
               const CellReader &materials,
               const std::vector<ElasticPhase<3>> &phases,
               const MPI_Comm communicator)
{
  const PlaneRange range = own_planes(box.grid.cells[2], communicator);
  CellBlock<3> block     = whole_block(box.grid);
  block.first[2]         = range.first;
  block.cells[2]         = range.count;
  CellIndices cells(block.n_cells(), phases.size() - 1);
  on_all_ranks(communicator, [&]() {
    std::size_t next = 0;
    for_each_piece(block, [&](const CellBlock<3> &piece) {
      for (const std::uint16_t material : materials(piece))
        cells.set(next++, material);
    });
  });
  voxel::VoxelGrid kind;
  kind.sides  = voxel::Sides::mixed;
  kind.joined = {{box.periodic[0], box.periodic[1], false}};
  return std::make_unique<voxel::Stiffness>(
    CellPlanes(box.grid, cells.view(), communicator), phases, kind);
}

bool is_enough_for(const BrickBox &box, const MPI_Comm communicator)
{
  return voxel::is_divided_among(box.grid.cells[2] + std::size_t{1},
                                 mpi::n_mpi_processes(communicator));
}
} // namespace

GridBody<3>::GridBody(const BrickBox &box,
                      const CellReader &materials,
                      const std::vector<ElasticPhase<3>> &phases,
                      const MPI_Comm communicator,
                      const bool whole)
  : GridBody(box,
             materials,
             phases,
             communicator,
             whole || !is_enough_for(box, communicator),
             read_stiffness(box,
                            materials,
                            phases,
                            whole || !is_enough_for(box, communicator) ? MPI_COMM_SELF
                                                                       : communicator))
{
}

GridBody<3>::GridBody(const BrickBox &box,
                      const CellReader &materials,
                      const std::vector<ElasticPhase<3>> &phases,
                      const MPI_Comm communicator,
                      const bool whole,
                      std::unique_ptr<const voxel::Stiffness> stiffness)
  : PointBody<3>(
      n_nodes(box, stiffness->grid), 1, phases, {box.periodic[0], box.periodic[1]})
  , box(box)
  , materials(materials)
  , ranks(communicator)
  , is_whole(whole)
  , K(std::move(stiffness))
  , first_plane(K->grid.below())
  , input(K->grid)
  , output(K->grid)
  , rounded(K->grid)
{
  for (unsigned int d = 0; d < 3; ++d)
    extents[d] = box.grid.extent(d);
  total_volume    = extents[0] * extents[1] * extents[2];
  number_of_cells = box.grid.n_cells();
  for (std::size_t p = 0; p < phases.size(); ++p)
    mass += K->n_cells[p] * phases[p].density * box.grid.cell_measure();
  distributed = K->grid.is_divided();
  if (distributed)
    sharing = communicator;
  number_points();
  set_sides();
}

bool GridBody<3>::is_master(const Place &at) const
{
  return !(box.periodic[0] && at[0] == box.grid.cells[0]) &&
         !(box.periodic[1] && at[1] == box.grid.cells[1]);
}

GridBody<3>::Place GridBody<3>::place_of(const unsigned int point) const
{
  const Place n = n_points(box);
  return {{point % n[0], point / n[0] % n[1], point / n[0] / n[1]}};
}

unsigned int GridBody<3>::point_at(const Place &at) const
{
  const Place n = n_points(box);
  return (at[2] * n[1] + at[1]) * n[0] + at[0];
}

NodeIndex GridBody<3>::node_at(const Place &at) const
{
  return {node_of[point_at({{at[0], at[1], at[2] - first_plane}})], 0};
}

// Distributed fields begin with the locally owned nodes.
void GridBody<3>::number_points()
{
  const Place n            = n_points(box);
  const unsigned int own   = K->grid.n_nodes(2);
  const unsigned int begin = point_at({{0, 0, first_plane}});
  node_of.resize(n_columns());
  points.reserve(n_columns());
  const auto add = [&](const unsigned int first, const unsigned int last,
                       const auto &wanted) {
    for (unsigned int point = begin + first * n[0] * n[1];
         point < begin + last * n[0] * n[1]; ++point)
      if (wanted(place_of(point)))
        {
          node_of[point - begin] = static_cast<unsigned int>(points.size());
          points.push_back(point);
        }
  };
  const auto any    = [](const Place &) { return true; };
  const auto master = [this](const Place &at) { return is_master(at); };
  const auto copy   = [this](const Place &at) { return !is_master(at); };
  if (is_whole)
    add(0, own, any);
  else
    add(0, own, master);
  n_counted = points.size();
  if (!is_whole)
    add(0, own, copy);
  n_owned = points.size();
  add(own, n_planes(box, K->grid), any);
  for (unsigned int axis = 0; axis < 2 && is_whole; ++axis)
    for (const unsigned int point : points)
      if (Place at = place_of(point); box.periodic[axis] && at[axis] == n[axis] - 1)
        {
          const NodeIndex node = node_at(at);
          at[axis]             = 0;
          copies.push_back({{node, node_at(at)}});
        }
}

// Each face adds a quarter of its area to each of its corners.
void GridBody<3>::set_sides()
{
  const Place &n = box.grid.cells;
  for (unsigned int id = 0; id < 6; ++id)
    {
      const unsigned int axis = id / 2, a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
      const auto is_periodic = [this](const unsigned int d) {
        return d < 2 && box.periodic[d];
      };
      const double quarter  = box.grid.spacing[a] * box.grid.spacing[b] / 4.;
      SurfaceNodes<3> &side = sides[id];
      Place at;
      at[axis] = id % 2 == 0 || is_periodic(axis) ? 0 : n[axis];
      for (at[b] = 0; at[b] <= n[b]; ++at[b])
        for (at[a] = 0; at[a] <= n[a]; ++at[a])
          {
            if (!is_master(at))
              continue;
            double area = quarter;
            for (const unsigned int d : {a, b})
              area *= is_periodic(d) || (at[d] > 0 && at[d] < n[d]) ? 2. : 1.;
            const unsigned int point = point_at(at);
            if (const auto node = find(point))
              {
                side.nodes.push_back(*node);
                side.place_of_nodes.push_back(side.normal_area.size());
              }
            side.normal_area.emplace_back();
            side.normal_area.back()[axis] = id % 2 == 0 ? -area : area;
            if (id == bottom)
              of_contact.push_back(point);
          }
    }
}

PlaneRange GridBody<3>::cell_planes() const
{
  return {first_plane, n_planes(box, K->grid) - 1};
}

std::optional<NodeIndex> GridBody<3>::find(const unsigned int number) const
{
  const unsigned int begin = point_at({{0, 0, first_plane}});
  if (number < begin || number - begin >= node_of.size())
    return std::nullopt;
  return NodeIndex{node_of[number - begin], 0};
}

std::uint64_t GridBody<3>::number(const NodeIndex &node) const
{
  return points[node.i];
}

std::array<double, 3> GridBody<3>::point(const NodeIndex &node) const
{
  const Place at = place_of(points[node.i]);
  std::array<double, 3> result;
  for (unsigned int d = 0; d < 3; ++d)
    result[d] = at[d] * box.grid.spacing[d];
  return result;
}
} // namespace mesoslip
