// Boxes with so many cells along an axis that their number times that of the next coarser grid
// does not fit into 32 bits: from 92,682 on. On any number of ranks. No such box is solved here: the
// preconditioner, in single precision, does not converge on 50,001 x 2 cells.
#include "assembled_matrix.h"
#include "statics/voxel/transfer.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

using namespace voxel_testing;
using voxel::VoxelGrid;

namespace
{
constexpr unsigned int n_long = 100001;

/** A flat grid of that many squares along x or z; planes of nodes across z are divided. */
VoxelGrid long_grid(const unsigned int axis, const Sides sides)
{
  VoxelGrid grid;
  grid.cells       = {{4, 1, 4}};
  grid.cells[axis] = n_long;
  grid.spacing     = {{1., 1., 1.}};
  grid.sides       = sides;
  grid.flat        = true;
  divide(grid, MPI_COMM_WORLD);
  return grid;
}

/** Calls function(number in the box along the axis, value) for the cells of this rank. */
template <typename Function>
void for_each_cell(const VoxelGrid &grid,
                   voxel::CellStiffness &stiffness,
                   const unsigned int axis,
                   const Function &function)
{
  const unsigned int first = grid.first();
  for (unsigned int k = 0; k <= grid.n_nodes(2); ++k)
    for (unsigned int i = first; i < grid.cells[0] + first; ++i)
      {
        // Below the first plane of the box: far beyond the last one.
        const unsigned int plane = k + grid.below() - first;
        if (plane < grid.cells[2])
          function(axis == 0 ? i - first : plane, stiffness.row(grid, 0, 0, k)[i]);
      }
}

/** Sum of the numbers of all cells up to a place, in edges, that of its own cell in part. */
double sum_up_to(const double place)
{
  const double whole = std::floor(place);
  return 0.5 * whole * (whole - 1.) + whole * (place - whole);
}
} // namespace

TEST(LongVoxels, CoarseCellsAreMeansByVolume)
{
  for (const Sides sides : {Sides::held, Sides::free, Sides::periodic})
    for (const unsigned int axis : {0U, 2U})
      {
        SCOPED_TRACE(axis);
        const VoxelGrid fine = long_grid(axis, sides), coarse = coarser(fine);
        const unsigned int n_coarse = coarse.cells[axis];
        ASSERT_EQ(n_coarse, (n_long + 1) / 2);
        voxel::CellStiffness cells = {1, {}};
        cells.numbers.resize(fine.n_cell_rows() * fine.stride());
        for_each_cell(fine, cells, axis, [](const unsigned int number, float &value) {
          value = static_cast<float>(number);
        });
        voxel::CellStiffness found = coarsened(fine, cells, coarse);
        const double length        = static_cast<double>(n_long) / n_coarse,
                     factor        = coarse.factor() / fine.factor();
        for_each_cell(
          coarse, found, axis, [&](const unsigned int number, const float &value) {
            const double mean =
              (sum_up_to(length * (number + 1.)) - sum_up_to(length * number)) / length;
            ASSERT_NEAR(value / factor, mean, 1e-6 * n_long) << number;
          });
      }
}

TEST(LongVoxels, LinearFieldsAreInterpolatedExactly)
{
  for (const unsigned int axis : {0U, 2U})
    {
      const VoxelGrid fine = long_grid(axis, Sides::free), coarse = coarser(fine);
      const auto for_each = [axis](voxel::VoxelField<float> &field,
                                   const auto &function) {
        const VoxelGrid &grid = field.grid();
        for (unsigned int k = 1; k <= grid.n_nodes(2); ++k)
          for (unsigned int i = 1; i <= grid.n_nodes(0); ++i)
            {
              const unsigned int number = (axis == 0 ? i : k + grid.below()) - 1;
              function(static_cast<double>(number) / grid.cells[axis],
                       field.row(0, 1, k)[i]);
            }
      };
      voxel::VoxelField<float> x(fine), c(coarse);
      for_each(
        c, [](const double place, float &value) { value = static_cast<float>(place); });
      c.set_ghosts();
      voxel::Transfer(fine, coarse).add_from(c, x);
      for_each(x, [](const double place, const float &value) {
        ASSERT_NEAR(value, place, 1e-6);
      });
    }
}
