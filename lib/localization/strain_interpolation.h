#ifndef mesoslip_localization_strain_interpolation_h
#define mesoslip_localization_strain_interpolation_h

#include "grid/uniform_grid.h"
#include "localization/row_arrays.h"
#include "localization/row_kernels.h"

#include <array>
#include <vector>

namespace mesoslip
{
/**
 * How the values of @p n_target cells along one axis follow from those of @p n_source
 * cells of the same length altogether: value i is the sum of weight[i width + k] times
 * the source value first[i] + k.
 *
 * n_source = r n_target, r whole: the mean of r cells (r = 1: identity). Otherwise linear
 * between the two nearest cell centres, and beyond the outermost ones extrapolated;
 * exact for linear functions everywhere.
 */
struct AxisWeights
{
  /** Weights from @p n_source cells to @p n_target cells, both at least 1. */
  AxisWeights(const unsigned int n_source, const unsigned int n_target);

  /** Whether the values are those of the source. */
  bool is_identity() const
  {
    return width == 1 && first.size() == n_source;
  }

  unsigned int n_source;           ///< cells of the source
  unsigned int width;              ///< source cells that a target cell draws on
  std::vector<unsigned int> first; ///< first source cell of each target cell
  std::vector<double> weight; ///< [target cell][width]; those of a target cell sum to 1
};

/**
 * Mean strain over a body (xx, yy, engineering xy) from its nodal displacements
 * [ny + 1][nx + 1][2]; by Gauss' theorem only those on the sides matter.
 */
std::array<double, 3> mean_strain(const UniformGrid<2> &grid, const double *displacement);

/**
 * The strain of a run with bilinear cells in the cells of another grid of the same box.
 * Strains at cell centres are of second order, better than anywhere else in a cell; they
 * are interpolated by AxisWeights along both axes. One object for each thread.
 */
class StrainInterpolation
{
public:
  /** Both grids cover the same box. */
  StrainInterpolation(const UniformGrid<2> &source, const UniformGrid<2> &target);

  /**
   * Strain of target row @p j, valid until the next call. @p displacement is one
   * snapshot of the source, [ny + 1][nx + 1][2].
   */
  ConstRow row(const double *displacement, const unsigned int j);

  /** Numbers in a snapshot of the source. */
  std::size_t snapshot_size() const
  {
    return 2 * source.n_nodes();
  }

  /** Whose cells get the strains. */
  const UniformGrid<2> &target_grid() const
  {
    return target;
  }

private:
  Row source_row(const double *displacement, const unsigned int j);
  void combine_columns(const double *values, double *result) const;

  UniformGrid<2> source, target;
  AxisWeights x, y;
  /** Rows of three arrays: a strain row of the source, their sum over y. */
  RowArrays source_rows;
  RowArrays result;
};
} // namespace mesoslip

#endif
