#ifndef mesoslip_statics_multigrid_interpolation_h
#define mesoslip_statics_multigrid_interpolation_h

#include "elasticity/uniform_material.h"
#include "grid/padded_rows.h"
#include "statics/multigrid/axis.h"
#include "statics/multigrid/kernels/patch.h"

#include <array>
#include <functional>
#include <vector>

namespace mesoslip
{
namespace multigrid
{
/**
 * A scalar conductor on a grid, the model from which weights of interpolation are taken:
 * the six conductances between the corners 0 (lower left), 1, 2 (upper left), 3 of each
 * cell, in the order 01, 02, 03, 12, 13, 23.
 */
class Conductor
{
public:
  /** Pairs of the corners 0 to 3 of a cell. */
  enum Pair
  {
    p01,
    p02,
    p03,
    p12,
    p13,
    p23,
    n_pairs
  };

  /** On the finest grid: edges of cells, by the stiffness of their class. */
  static Conductor finest(const UniformMaterial &material);

  /** Stored conductances of a coarse grid; ghosts filled. */
  explicit Conductor(PaddedRows<float> &&rows);

  /**
   * Conductances of cell row @p j in columns -1 to n_cells in @p row, which has n_pairs
   * arrays and one row; zero outside a grid that is not periodic.
   */
  void get_row(const int j, PaddedRows<float> &row) const
  {
    fill(j, row);
  }

private:
  Conductor() = default;

  std::function<void(int, PaddedRows<float> &)> fill;
};

/**
 * Interpolation between two grids of the hierarchy. Each coarse node carries a rigid
 * motion; a fine node takes the weighted mean of the motions of the corners of its
 * coarse cell, evaluated at its own place, so rigid motions pass exactly for whatever
 * weights. The weights follow the strongest connections, as in the black box multigrid
 * of Dendy (J. Comput. Phys. 48, 1982), applied to a scalar conductor: a fine node inside
 * a stiff fibre moves with the coarse nodes inside that fibre.
 */
class Interpolation
{
public:
  Interpolation() = default;

  /** Weights from @p fine to the grid that halves @p halve_x, @p halve_y make of it. */
  Interpolation(const Axis &fine_x,
                const Axis &fine_y,
                const bool halve_x,
                const bool halve_y,
                const Conductor &conductor);

  /** Weights and places of the fine nodes of the coarse cells from I0 on in row @p J,
   *  zero in lanes beyond the grid. Number: float, double. */
  template <typename Number>
  void
  fill_patch(const unsigned int I0, const unsigned int J, Patch<Number> &patch) const;

  /** The conductor P^T A P on the coarse grid. */
  Conductor coarse_conductor(const Conductor &fine) const;

  AxisCoarsening x; ///< how columns are coarsened
  AxisCoarsening y; ///< how rows are coarsened
  Axis coarse_x;    ///< columns of the coarse grid
  Axis coarse_y;    ///< rows of the coarse grid

  /** Weight of the left node for the middle of the edge right of coarse node (I, J). */
  PaddedRows<float> left;
  /** Weight of the lower node for the middle of the edge above coarse node (I, J). */
  PaddedRows<float> lower;
  /** Weights of the corners 0 to 3 for the centre of coarse cell (I, J). */
  PaddedRows<float> corners;

  /** Distance of the middle of cell I from its left and its right node. */
  std::vector<std::array<double, 2>> x_distance;
  /** Distance of the middle of cell row J from its lower and its upper node. */
  std::vector<std::array<double, 2>> y_distance;

private:
  void set_left_weights(const int J,
                        const PaddedRows<float> &below,
                        const PaddedRows<float> &above);
  void set_lower_weights(const int J,
                         const PaddedRows<float> &below,
                         const PaddedRows<float> &above);
  void set_corner_weights(const int J,
                          const PaddedRows<float> &below,
                          const PaddedRows<float> &above);
  template <typename Number>
  void fill_lane(const unsigned int l,
                 const unsigned int I,
                 const unsigned int J,
                 Patch<Number> &patch) const;
};
} // namespace multigrid
} // namespace mesoslip

#endif
