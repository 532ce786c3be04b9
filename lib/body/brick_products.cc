#include "base/exchange.h"
#include "body/brick_body.h"
#include "body/brick_solver.h"
#include "body/strain_modes.h"
#include "elasticity/brick/brick_matrices.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Stiffness of a brick of each phase (N/m). */
std::vector<BrickMatrix> brick_matrices_of(const voxel::Stiffness &stiffness)
{
  const BrickStiffness of_brick(stiffness.grid.spacing);
  std::vector<BrickMatrix> result;
  for (const ElasticPhase<3> &phase : stiffness.of_phases)
    result.emplace_back(stiffness.grid.factor() * stiffness.length * of_brick(phase));
  return result;
}

/** Stiffness between two corners (3 x 3). */
Eigen::Matrix3d
corner_block(const BrickMatrix &matrix, const unsigned int row, const unsigned int column)
{
  Eigen::Matrix3d block;
  for (unsigned int r = 0; r < 3; ++r)
    for (unsigned int c = 0; c < 3; ++c)
      block(r, c) = matrix(3 * row + r, 3 * column + c);
  return block;
}
} // namespace

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
      for (unsigned int c = 0; c < 3; ++c) // periodic masters of a row are contiguous
        std::copy_n(field.row(c, 0) + node_at({{0, j, first_plane + k}}).i, n[0],
                    to.row(c, j + 1, k + 1) + 1);
  to.set_ghosts();
}

void GridBody<3>::from_voxels(const voxel::VoxelField<double> &field,
                              NodalField<double> &to) const
{
  const Place &cells = box.grid.cells, &n = field.n_nodes();
  std::size_t place = 0;
  for (unsigned int k = 0; k <= cell_planes().count; ++k)
    for (unsigned int j = 0; j <= cells[1]; ++j)
      for (unsigned int i = 0; i <= cells[0]; ++i, ++place)
        for (unsigned int c = 0; c < 3; ++c)
          to.row(c, 0)[node_of[place]] = field.row(c, j % n[1] + 1, k + 1)[i % n[0] + 1];
}

void GridBody<3>::update_copies(NodalField<double> &field) const
{
  to_voxels(field, input);
  from_voxels(input, field);
}

/**
 * Phase of the cell at @p corner of @p node (indices in voxel fields); the number of
 * phases outside of the body.
 */
unsigned int GridBody<3>::phase_beside(const Place &node, const unsigned int corner) const
{
  const voxel::VoxelGrid &grid = K->grid;
  return K->phases[grid.cell_row(node[1] - (corner >> 1 & 1U), node[2] - (corner >> 2)) *
                     grid.stride() +
                   node[0] - (corner & 1U)];
}

std::vector<double> GridBody<3>::mass_of_cells() const
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

std::vector<VoigtMatrix<3>>
GridBody<3>::strain_products(const NodalField<double> &u) const
{
  const Place &n = box.grid.cells;
  std::vector<VoigtMatrix<3>> products(phases().size(), VoigtMatrix<3>::Zero());
  StrainModes<3, 1> modes(box.grid.spacing);
  for (unsigned int k = 0; k < cell_planes().count; ++k)
    for (unsigned int j = 0; j < n[1]; ++j)
      for (unsigned int i = 0; i < n[0]; ++i)
        {
          const unsigned int phase = phase_beside({{i + 1, j + 1, k + 1}}, 0);
          for (unsigned int corner = 0; corner < 8; ++corner)
            for (unsigned int c = 0; c < 3; ++c)
              modes.displacement(corner, c)[0] =
                u(c, node_at({{i + (corner & 1U), j + (corner >> 1 & 1U),
                               first_plane + k + (corner >> 2)}}));
          modes.visit(phases()[phase].mean_dilatation, box.grid.cell_measure(),
                      [&](const double volume, const VoigtVector<3> &strain) {
                        products[phase] += volume * strain * strain.transpose();
                      });
        }
  sum_over_ranks(products[0].data(), products.size() * products[0].size(),
                 communicator());
  return products;
}

void GridBody<3>::multiply(NodalField<double> &Ku, const NodalField<double> &u) const
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
  Place at; // periodic masters, row after row
  for (at[2] = 0; at[2] < nodes[2]; ++at[2])
    for (at[1] = 0; at[1] < nodes[1]; ++at[1])
      for (at[0] = 0; at[0] < nodes[0]; ++at[0])
        {
          std::array<Eigen::Matrix3d, 27> blocks; // blocks of neighbours, x fastest
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
                  blocks[block] += corner_block(matrices[phase], corner, other);
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
