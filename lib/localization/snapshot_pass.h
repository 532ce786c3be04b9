#ifndef mesoslip_localization_snapshot_pass_h
#define mesoslip_localization_snapshot_pass_h

#include "exchange/dynamics_file.h"
#include "localization/stress_statistics.h"

#include <array>
#include <functional>
#include <vector>

namespace mesoslip
{
class Timer;

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
 * Mean strain over a body (xx, yy, engineering xy) from its nodal displacements @p u
 * [ny + 1][nx + 1][2]; by Gauss' theorem only those on the sides matter.
 */
std::array<double, 3> mean_strain(const UniformGrid<2> &grid, const double *u);

/**
 * The strain of a run with bilinear cells in the cells of another grid of the same box.
 * Strains at cell centres are of second order, better than anywhere else in a cell; they
 * are interpolated by AxisWeights along both axes, along x first: the rows that come of
 * it serve several rows of a finer grid and are kept. One object for each snapshot at
 * hand.
 */
class StrainInterpolation
{
public:
  /** Both grids cover the same box. */
  StrainInterpolation(const UniformGrid<2> &source, const UniformGrid<2> &target);

  /** Strains are those of @p u from now on: one snapshot of the source,
   *  [ny + 1][nx + 1][2], which stays the caller's. */
  void set_displacement(const double *u);

  /** Strain of target row @p j, valid until the next call. Rows are best asked for in
   *  their order. */
  StrainRow row(const unsigned int j);

private:
  StrainRow source_row(const unsigned int j);
  void combine_columns(const double *values, double *combined) const;

  UniformGrid<2> source, target;
  AxisWeights x, y;
  const double *displacement = nullptr;
  /** Rows of three arrays: a strain row of the source, those of its rows that have been
   *  interpolated along x last, a sum of them. */
  NodalField<double> scratch, kept, result;
  /** Number of the row of the source at each place of kept, or none. */
  std::vector<unsigned int> kept_row;
};

/** Column and row of a cell. */
using CellIndex = std::array<unsigned int, 2>;

/** What is wanted from the snapshots of a run; null and empty things cost nothing. */
struct SnapshotWork
{
  StressStatistics *local   = nullptr; ///< fed with the strain at the place
  StressStatistics *uniform = nullptr; ///< fed with the strain averaged over the body
  bool mean_history         = false;   ///< history of the strain averaged over the body
  std::vector<CellIndex> cells;        ///< cells whose strain histories are wanted

  /** Whether anything is wanted. */
  bool any() const
  {
    return local != nullptr || uniform != nullptr || mean_history || !cells.empty();
  }
};

/** What pass_snapshots() returns: one entry a snapshot. */
struct SnapshotHistories
{
  std::vector<double> time;               ///< s
  std::vector<double> mean;               ///< strain averaged over the body [k][3]
  std::vector<std::vector<double>> cells; ///< strain [k][3] of each cell wanted
};

/**
 * Goes once through the snapshots @p range of a run. They are read some at a time, by a
 * thread of its own while those before are treated; each row of @p target cells is
 * treated for all of them before the next row, so that what belongs to it stays in the
 * cache. @p done is called with the number of snapshots done so far, and may throw to stop;
 * @p timer, if any, tells waiting for snapshots from averaging.
 * @throws UserError.
 */
SnapshotHistories pass_snapshots(const DynamicsFile &run,
                                 const IndexRange &range,
                                 const UniformGrid<2> &target,
                                 const SnapshotWork &work,
                                 const std::function<void(const std::size_t)> &done,
                                 Timer *timer);
} // namespace mesoslip

#endif
