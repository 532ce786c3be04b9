#include "body/brick_body.h"

#include "base/exchange.h"
#include "body/brick_solver.h"
#include "elasticity/brick/brick_matrices.h"
#include "elasticity/brick/coefficients.h"
#include "statics/voxel/planes.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
using Place = std::array<unsigned int, 3>;

/** Numbers of points along the axes. */
Place n_points(const BrickBox &box)
{
  const Place &n = box.grid.cells;
  return {{n[0] + 1, n[1] + 1, n[2] + 1}};
}

/** Planes of points of a rank: its own and, beside other ranks, the next one. */
unsigned int n_planes(const BrickBox &box, const voxel::VoxelGrid &grid)
{
  return std::min(grid.n_nodes(2) + 1, box.grid.cells[2] + 1 - grid.below());
}

unsigned int n_nodes(const BrickBox &box, const voxel::VoxelGrid &grid)
{
  const Place n = n_points(box);
  return n[0] * n[1] * n_planes(box, grid);
}

std::vector<VoigtMatrix<3>> stiffness_of(const std::vector<ElasticPhase<3>> &phases)
{
  std::vector<VoigtMatrix<3>> result;
  for (const ElasticPhase<3> &phase : phases)
    result.push_back(phase.stiffness);
  return result;
}

/** Of the cells of this rank's planes, which are read piece by piece. */
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
    CellPlanes(box.grid, cells.view(), communicator), stiffness_of(phases), kind);
}

bool is_enough_for(const BrickBox &box, const MPI_Comm communicator)
{
  return voxel::is_divided_among(box.grid.cells[2] + std::size_t{1},
                                 mpi::n_mpi_processes(communicator));
}

/** Stiffness of a brick of each phase (N/m). */
std::vector<BrickMatrix> brick_matrices_of(const voxel::Stiffness &stiffness)
{
  const auto units = brick_matrices(stiffness.grid.spacing, n_general);
  std::vector<BrickMatrix> result;
  for (const VoigtMatrix<3> &of_phase : stiffness.of_phases)
    {
      const auto coefficients = coefficients_of(of_phase, n_general);
      BrickMatrix &sum        = result.emplace_back(BrickMatrix::Zero());
      for (unsigned int m = 0; m < n_general; ++m)
        sum += coefficients[m] * stiffness.grid.factor() * stiffness.length * units[m];
    }
  return result;
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

bool GridBody<3>::is_original(const Place &at) const
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

// Divided fields begin with the nodes that a rank counts.
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
  const auto any       = [](const Place &) { return true; };
  const auto original  = [this](const Place &at) { return is_original(at); };
  const auto duplicate = [this](const Place &at) { return !is_original(at); };
  if (is_whole)
    add(0, own, any);
  else
    add(0, own, original);
  n_counted = points.size();
  if (!is_whole)
    add(0, own, duplicate);
  n_owned = points.size();
  add(own, n_planes(box, K->grid), any);
  for (unsigned int axis = 0; axis < 2 && is_whole; ++axis)
    for (const unsigned int point : points)
      if (Place at = place_of(point); box.periodic[axis] && at[axis] == n[axis] - 1)
        {
          const NodeIndex node = node_at(at);
          at[axis]             = 0;
          duplicates.push_back({{node, node_at(at)}});
        }
}

// Faces of cells give each of their corners a quarter.
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
            if (!is_original(at))
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

std::optional<GridBody<3>::Place> GridBody<3>::voxel_node(const NodeIndex &node) const
{
  Place at = place_of(points[node.i]);
  if (at[2] >= first_plane + K->grid.n_nodes(2))
    return std::nullopt;
  at[2] -= first_plane;
  for (unsigned int d = 0; d < 3; ++d)
    at[d] = (d < 2 ? at[d] % K->grid.n_nodes(d) : at[d]) + 1;
  return at;
}

void GridBody<3>::to_voxels(const NodalField<double> &field,
                            voxel::VoxelField<double> &to) const
{
  const auto &n = to.n_nodes();
  for (unsigned int k = 0; k < n[2]; ++k)
    for (unsigned int j = 0; j < n[1]; ++j)
      for (unsigned int c = 0; c < 3; ++c) // originals of a row lie together
        std::copy_n(field.row(c, 0) + node_at({{0, j, first_plane + k}}).i, n[0],
                    to.row(c, j + 1, k + 1) + 1);
  to.set_ghosts();
}

void GridBody<3>::from_voxels(const voxel::VoxelField<double> &field,
                              NodalField<double> &to) const
{
  const Place all = n_points(box), &n = field.n_nodes();
  std::size_t place = 0;
  for (unsigned int k = 0; k < n_planes(box, K->grid); ++k)
    for (unsigned int j = 0; j < all[1]; ++j)
      for (unsigned int i = 0; i < all[0]; ++i, ++place)
        for (unsigned int c = 0; c < 3; ++c)
          to.row(c, 0)[node_of[place]] = field.row(c, j % n[1] + 1, k + 1)[i % n[0] + 1];
}

void GridBody<3>::copy_duplicates(NodalField<double> &field) const
{
  to_voxels(field, input);
  from_voxels(input, field);
}

/** Of the cell of which @p node, by its numbers in fields of voxels, is a corner; the number of phases
 * outside of the body. */
unsigned int GridBody<3>::phase_beside(const Place &node, const unsigned int corner) const
{
  const voxel::VoxelGrid &grid = K->grid;
  return K->phases[grid.cell_row(node[1] - (corner >> 1 & 1U), node[2] - (corner >> 2)) *
                     grid.stride() +
                   node[0] - (corner & 1U)];
}

std::vector<double> GridBody<3>::lumped_mass() const
{
  const double of_corner = box.grid.cell_measure() / 8.;
  const Place n          = output.n_nodes();
  Place at;
  for (at[2] = 1; at[2] <= n[2]; ++at[2])
    for (at[1] = 1; at[1] <= n[1]; ++at[1])
      for (at[0] = 1; at[0] <= n[0]; ++at[0])
        {
          double sum = 0.;
          for (unsigned int corner = 0; corner < 8; ++corner)
            if (const unsigned int phase = phase_beside(at, corner);
                phase < phases().size())
              sum += phases()[phase].density * of_corner;
          output.row(0, at[1], at[2])[at[0]] = sum;
        }
  output.set_ghosts();
  NodalField<double> masses = zero_field();
  from_voxels(output, masses);
  return {masses.row(0, 0), masses.row(0, 0) + n_columns()};
}

std::size_t GridBody<3>::n_cell_groups() const
{
  return std::size_t{cell_planes().count} * box.grid.cells[1];
}

void GridBody<3>::evaluate(const NodalField<double> &u,
                           const std::size_t group,
                           Cells &cells) const
{
  const unsigned int nx = box.grid.cells[0], ny = box.grid.cells[1];
  const auto j = static_cast<unsigned int>(group % ny),
             k = static_cast<unsigned int>(group / ny);
  cells.phase.resize(nx);
  cells.strain.assign(nx, VoigtVector<3>::Zero());
  cells.volume.assign(nx, 1.);
  for (unsigned int i = 0; i < nx; ++i)
    {
      cells.phase[i] = phase_beside({{i + 1, j + 1, k + 1}}, 0);
      for (unsigned int corner = 0; corner < 8; ++corner)
        {
          const unsigned int node = node_at({{i + (corner & 1U), j + (corner >> 1 & 1U),
                                              first_plane + k + (corner >> 2)}})
                                      .i;
          for (unsigned int d = 0; d < 3; ++d)
            {
              const double gradient =
                ((corner >> d & 1U) != 0 ? 0.25 : -0.25) / box.grid.spacing[d];
              for (unsigned int c = 0; c < 3; ++c)
                cells.strain[i](voigt_index<3>(c, d)) += gradient * u.row(c, 0)[node];
            }
        }
    }
}

void GridBody<3>::vmult(NodalField<double> &Ku, const NodalField<double> &u) const
{
  to_voxels(u, input);
  K->forces({}, input, rounded, output.data());
  const double unit = -unit_stiffness();
  for (std::size_t i = 0; i < output.size(); ++i)
    output.data()[i] *= unit;
  output.set_ghosts();
  from_voxels(output, Ku);
}

std::vector<MatrixEntry> GridBody<3>::stiffness_entries() const
{
  const auto matrices = brick_matrices_of(*K);
  const Place &n = K->grid.cells, nodes = output.n_nodes();
  std::vector<MatrixEntry> entries;
  Place at; // of originals, row after row
  for (at[2] = 0; at[2] < nodes[2]; ++at[2])
    for (at[1] = 0; at[1] < nodes[1]; ++at[1])
      for (at[0] = 0; at[0] < nodes[0]; ++at[0])
        {
          std::array<Eigen::Matrix3d, 27> blocks; // of the nodes around, x fastest
          blocks.fill(Eigen::Matrix3d::Zero());
          for (unsigned int corner = 0; corner < 8; ++corner)
            if (const unsigned int phase =
                  phase_beside({{at[0] + 1, at[1] + 1, at[2] + 1}}, corner);
                phase < phases().size())
              for (unsigned int other = 0; other < 8; ++other)
                {
                  unsigned int block = 0;
                  for (unsigned int d = 3; d-- > 0;)
                    block = 3 * block + 1 + (other >> d & 1U) - (corner >> d & 1U);
                  blocks[block] += matrices[phase].block<3, 3>(3 * corner, 3 * other);
                }
          for (unsigned int block = 0; block < 27; ++block)
            {
              const std::array<unsigned int, 3> step = {
                {block % 3, block / 3 % 3, block / 9}};
              Place to;
              bool inside = true;
              for (unsigned int d = 0; d < 3; ++d)
                {
                  to[d]  = at[d] + step[d]; // one too many
                  inside = inside &&
                           (K->grid.is_periodic(d) || (to[d] > 0 && to[d] <= n[d] + 1));
                  to[d] = (to[d] + nodes[d] - 1) % nodes[d];
                }
              for (unsigned int r = 0; r < 3 && inside; ++r)
                for (unsigned int c = 0; c < 3; ++c)
                  entries.push_back({3 * std::uint64_t{point_at(at)} + r,
                                     3 * std::uint64_t{point_at(to)} + c,
                                     blocks[block](r, c)});
            }
        }
  return entries;
}

std::unique_ptr<StaticSolver> GridBody<3>::make_solver() const
{
  return std::make_unique<BrickSolver>(*this);
}

std::unique_ptr<ElasticBody<3>> GridBody<3>::make_periodic() const
{
  return std::make_unique<GridBody<3>>(BrickBox{box.grid, {{true, true}}}, materials,
                                       phases(), ranks, is_whole);
}
} // namespace mesoslip
