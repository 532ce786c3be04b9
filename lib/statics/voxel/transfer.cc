#include "statics/voxel/transfer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip::voxel
{
namespace
{
/** Least number of cells along an axis. */
constexpr unsigned int fewest_cells = 2;
/** Cells are not coarsened along an axis while they are longer than the shortest edge by
 * this factor. */
constexpr double longer = 1.5;

/** A fine cell that overlaps a coarse one, and its share of it along an axis. */
struct Share
{
  unsigned int cell;
  float share;
};

/** 64 bits, as products of numbers of cells exceed 32 bits. */
std::vector<std::vector<Share>> shares(const std::size_t n_fine,
                                       const std::size_t n_coarse)
{
  std::vector<std::vector<Share>> result(n_coarse);
  // In integer units of 1 / (n_fine n_coarse) of the box.
  for (std::size_t i = 0; i < n_coarse; ++i)
    for (std::size_t f = i * n_fine / n_coarse;
         f < n_fine && f * n_coarse < (i + 1) * n_fine; ++f)
      {
        const std::size_t begin = std::max(i * n_fine, f * n_coarse),
                          end   = std::min((i + 1) * n_fine, (f + 1) * n_coarse);
        result[i].push_back(
          {static_cast<unsigned int>(f),
           static_cast<float>(end - begin) / static_cast<float>(n_fine)});
      }
  return result;
}

/** Completes cells shared by two ranks and ghost cells of a periodic body: ghosts within
 * rows, ghost rows, then ghost planes. */
void complete_cells(const VoxelGrid &grid, CellStiffness &stiffness)
{
  const std::size_t line  = stiffness.n_coefficients * grid.stride(),
                    plane = line * grid.cell_rows_in_plane();
  sum_shared_cells(grid, stiffness.numbers.data(), plane);
  for (unsigned int k = 0; k <= grid.n_nodes(2); ++k)
    {
      for (unsigned int j = 1; j <= grid.cells[1] && grid.is_periodic(0); ++j)
        for (unsigned int m = 0; m < stiffness.n_coefficients; ++m)
          {
            float *row = stiffness.row(grid, m, j, k);
            row[0]     = row[grid.cells[0]];
          }
      if (grid.is_periodic(1) && !grid.flat)
        std::copy_n(stiffness.row(grid, 0, grid.cells[1], k), line,
                    stiffness.row(grid, 0, 0, k));
    }
  if (grid.is_periodic(2) && !grid.is_divided())
    std::copy_n(stiffness.row(grid, 0, 0, grid.cells[2]), plane,
                stiffness.row(grid, 0, 0, 0));
}
} // namespace

VoxelGrid coarser(const VoxelGrid &grid)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (unsigned int d = 0; d < 3; ++d)
    if (grid.cells[d] > fewest_cells)
      shortest = std::min(shortest, grid.spacing[d]);
  VoxelGrid result = grid;
  for (unsigned int d = 0; d < 3; ++d)
    if (grid.cells[d] > fewest_cells && grid.spacing[d] < longer * shortest)
      {
        result.cells[d]   = (grid.cells[d] + 1) / 2;
        result.spacing[d] = grid.spacing[d] * grid.cells[d] / result.cells[d];
      }
  divide_as(grid, result);
  return result;
}

CellStiffness
coarsened(const VoxelGrid &fine, CellStiffness &stiffness, const VoxelGrid &coarse)
{
  CellStiffness result;
  result.n_coefficients = stiffness.n_coefficients;
  result.numbers.resize(coarse.n_cell_rows() * result.n_coefficients * coarse.stride());
  const auto x             = shares(fine.cells[0], coarse.cells[0]),
             y             = shares(fine.cells[1], coarse.cells[1]),
             z             = shares(fine.cells[2], coarse.cells[2]);
  const unsigned int first = fine.first();
  const auto factor        = static_cast<float>(coarse.factor() / fine.factor());
  // Each rank adds the planes of fine cells that only it counts.
  const unsigned int begin = fine.below() + fine.first_cell_plane() - first,
                     end   = begin + fine.n_cell_planes();
  for (unsigned int k = 0; k < coarse.cells[2]; ++k)
    for (const Share &in_z : z[k])
      if (in_z.cell >= begin && in_z.cell < end)
        for (unsigned int j = 0; j < coarse.cells[1]; ++j)
          for (unsigned int m = 0; m < result.n_coefficients; ++m)
            {
              float *out =
                result.row(coarse, m, j + first, k + first - coarse.below()) + first;
              for (const Share &in_y : y[j])
                {
                  const float weight = factor * in_z.share * in_y.share;
                  const float *in    = stiffness.row(fine, m, in_y.cell + first,
                                                     in_z.cell + first - fine.below()) +
                                    first;
                  for (unsigned int i = 0; i < coarse.cells[0]; ++i)
                    for (const Share &in_x : x[i])
                      out[i] += weight * in_x.share * in[in_x.cell];
                }
            }
  complete_cells(coarse, result);
  return result;
}

HeldComponents coarsened(const HeldComponents &fine, const VoxelGrid &coarse)
{
  HeldComponents result(coarse);
  const VoxelGrid &grid = fine.grid();
  // Fine nodes at or before, and at or after a coarse one; equal if they coincide.
  const auto around = [&](const unsigned int axis, const unsigned int node) {
    const bool z            = axis == 2;
    const std::size_t place = (node - std::size_t{1} + (z ? coarse.below() : 0)) *
                              grid.cells[axis],
                      cell = place / coarse.cells[axis];
    const auto before      = static_cast<unsigned int>(cell + 1 - (z ? grid.below() : 0));
    const unsigned int next = place % coarse.cells[axis] > 0 ? 1 : 0;
    return std::array<unsigned int, 2>{{before, before + next}};
  };
  for (unsigned int k = 1; k <= coarse.n_nodes(2); ++k)
    for (unsigned int j = 1; j <= coarse.n_nodes(1); ++j)
      for (unsigned int i = 1; i <= coarse.n_nodes(0); ++i)
        for (unsigned int c = 0; c < coarse.n_components(); ++c)
          {
            float held = 1.F;
            for (const unsigned int z : around(2, k))
              for (const unsigned int y : around(1, j))
                for (const unsigned int x : around(0, i))
                  held = std::min(held, fine.row(c, y, z)[x]);
            result.row(c, j, k)[i] = held;
          }
  result.set_ghosts();
  return result;
}

Transfer::Transfer(const VoxelGrid &fine, const VoxelGrid &coarse)
  : coarse_grid(coarse)
  , n_fine{{fine.n_nodes(0), fine.n_nodes(1), fine.n_nodes(2)}}
  , n_coarse{{coarse.n_nodes(0), coarse.n_nodes(1), coarse.n_nodes(2)}}
  , fine_stride(fine.stride())
  , coarse_stride(coarse.stride())
  , n_components(fine.n_components())
  , periodic{{fine.is_periodic(0), fine.is_periodic(1), fine.is_periodic(2)}}
  , first(fine.first())
  , axes{{axis(fine, coarse, 0), axis(fine, coarse, 1), axis(fine, coarse, 2)}}
  , line(n_components * std::max(fine_stride, coarse_stride))
{
}

Transfer::Axis
Transfer::axis(const VoxelGrid &fine, const VoxelGrid &coarse, const unsigned int d)
{
  Axis result;
  const std::size_t n = fine.cells[d], m = coarse.cells[d];
  result.halves = 2 * m == n;
  // Indexed by number in the field; ghosts have no entry.
  result.left.resize(fine.n_nodes(d) + 2);
  result.weight.resize(fine.n_nodes(d) + 2);
  const unsigned int fine_below   = d == 2 ? fine.below() : 0,
                     coarse_below = d == 2 ? coarse.below() : 0;
  for (unsigned int i = 1; i <= fine.n_nodes(d); ++i)
    {
      const std::size_t node  = std::size_t{fine_below} + i - fine.first(),
                        place = node * m;
      // The last node of all is the end of the last cell.
      result.left[i] = static_cast<unsigned int>(place / n) + fine.first() - coarse_below;
      result.weight[i] = static_cast<float>(place % n) / static_cast<float>(n);
    }
  return result;
}

/** Adds the restriction of a row along x to @p coarse; its ghosts take contributions to
 * other nodes. */
void Transfer::restrict_row(const float *fine, float *coarse) const
{
  const Axis &x = axes[0];
  if (x.halves)
    {
      // Fine node 2 i (held) or 2 i - 1 is coarse node i.
      const float *same   = fine - first;
      const std::size_t n = n_coarse[0];
      for (std::size_t i = 1; i <= n; ++i)
        coarse[i] = same[2 * i] + 0.5F * same[2 * i + 1];
      coarse[1] += first == 0    ? 0.5F * fine[1]
                   : periodic[0] ? 0.5F * fine[n_fine[0]]
                                 : 0.F;
      for (std::size_t i = 2; i <= n; ++i)
        coarse[i] += 0.5F * same[2 * i - 1];
      return;
    }
  std::fill_n(coarse, coarse_stride, 0.F);
  for (unsigned int i = 1; i <= n_fine[0]; ++i)
    {
      coarse[x.left[i]] += (1.F - x.weight[i]) * fine[i];
      coarse[x.left[i] + 1] += x.weight[i] * fine[i];
    }
  if (periodic[0])
    coarse[1] += coarse[n_coarse[0] + 1];
  coarse[0] = coarse[n_coarse[0] + 1] = 0.F;
}

void Transfer::restrict_to(const VoxelField<float> &r, VoxelField<float> &b)
{
  // Fine rows that contribute to a coarse one, with their weights.
  struct Source
  {
    unsigned int row;
    float weight;
  };
  const auto sources = [this](const unsigned int d) {
    std::vector<std::vector<Source>> result(n_coarse[d] + 2);
    for (unsigned int i = 1; i <= n_fine[d]; ++i)
      for (unsigned int next = 0; next < 2; ++next)
        {
          const float w   = next == 1 ? axes[d].weight[i] : 1.F - axes[d].weight[i];
          unsigned int to = axes[d].left[i] + next;
          if (periodic[d] && to == n_coarse[d] + 1 &&
              !(d == 2 && coarse_grid.is_divided()))
            to = 1;
          if (w != 0.F)
            result[to].push_back({i, w});
        }
    return result;
  };
  const auto in_y = sources(1), in_z = sources(2);
  const std::size_t n = n_components * fine_stride;
  // Contributions to a ghost plane belong to another rank.
  const unsigned int ghosts = coarse_grid.is_divided() ? 1 : 0;
  for (unsigned int k = 1 - ghosts; k <= n_coarse[2] + ghosts; ++k)
    for (unsigned int j = 1; j <= n_coarse[1]; ++j)
      {
        float *sum = line.data();
        std::fill_n(sum, n, 0.F);
        for (const Source &z : in_z[k])
          for (const Source &y : in_y[j])
            {
              const float weight = z.weight * y.weight;
              const float *fine  = r.row(0, y.row, z.row);
              for (std::size_t i = 0; i < n; ++i)
                sum[i] += weight * fine[i];
            }
        for (unsigned int c = 0; c < n_components; ++c)
          restrict_row(sum + c * fine_stride, b.row(c, j, k));
      }
  add_ghost_planes(coarse_grid, b.data(), b.plane_size());
}

/** Interpolates @p coarse along x and adds it to @p fine. */
void Transfer::add_row(const float *coarse, float *fine) const
{
  const Axis &x = axes[0];
  if (x.halves)
    {
      float *same         = fine - first;
      const std::size_t n = n_coarse[0];
      if (first == 0)
        fine[1] += 0.5F * coarse[1];
      for (std::size_t i = 1; i <= n; ++i)
        {
          same[2 * i] += coarse[i];
          same[2 * i + 1] += 0.5F * (coarse[i] + coarse[i + 1]);
        }
      if (first == 1 && !periodic[0])
        same[2 * n + 1] = 0.F;
      return;
    }
  for (unsigned int i = 1; i <= n_fine[0]; ++i)
    fine[i] +=
      coarse[x.left[i]] + x.weight[i] * (coarse[x.left[i] + 1] - coarse[x.left[i]]);
}

void Transfer::add_from(const VoxelField<float> &c, VoxelField<float> &x)
{
  const std::size_t n = n_components * coarse_stride;
  float *sum          = line.data();
  for (unsigned int k = 1; k <= n_fine[2]; ++k)
    for (unsigned int j = 1; j <= n_fine[1]; ++j)
      {
        std::fill_n(sum, n, 0.F);
        for (unsigned int next = 0; next < 4; ++next)
          {
            const float y = next & 1U ? axes[1].weight[j] : 1.F - axes[1].weight[j],
                        z = next & 2U ? axes[2].weight[k] : 1.F - axes[2].weight[k];
            if (y * z == 0.F)
              continue;
            const float *coarse =
              c.row(0, axes[1].left[j] + (next & 1U), axes[2].left[k] + (next >> 1));
            for (std::size_t i = 0; i < n; ++i)
              sum[i] += y * z * coarse[i];
          }
        for (unsigned int component = 0; component < n_components; ++component)
          add_row(sum + component * coarse_stride, x.row(component, j, k));
      }
}
} // namespace mesoslip::voxel
