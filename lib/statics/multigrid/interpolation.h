#ifndef mesoslip_statics_multigrid_interpolation_h
#define mesoslip_statics_multigrid_interpolation_h

#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"
#include "statics/multigrid/axis.h"
#include "statics/multigrid/kernels/kernels.h"

#include <array>
#include <functional>
#include <vector>

namespace mesoslip::multigrid
{
/** Pairs of the corners 0 (lower left), 1, 2 (upper left), 3 of a cell. */
enum CornerPair : unsigned int
{
  p01,
  p02,
  p03,
  p12,
  p13,
  p23,
  n_pairs
};

/**
 * A scalar conductor on a grid, the model from which weights of interpolation are taken:
 * sets the n_pairs arrays of one row to the conductances between the corners of the cells
 * of cell row @p j, in columns -1 to n_cells; zero outside a grid that is not periodic.
 */
using Conductor = std::function<void(const int j, NodalField<float> &row)>;

/** Conductor of the finest grid: edges of cells, by the stiffness of their phase. */
Conductor finest_conductor(const UniformMaterial &material);

/**
 * Interpolation between two grids of the hierarchy. Each coarse node has a rigid motion;
 * a fine node takes the weighted mean of the motions of the corners of its coarse cell,
 * evaluated at the fine node, so rigid motions are reproduced for any weights. The
 * weights follow the strongest connections, as in the black box multigrid of Dendy (J.
 * Comput. Phys. 48, 1982), applied to a scalar conductor: a fine node inside a stiff
 * fibre moves with the coarse nodes inside that fibre.
 */
class Interpolation
{
public:
  Interpolation() = default;

  /** Weights from @p fine to the grid coarsened by @p halve_x, @p halve_y. */
  Interpolation(const Axis &fine_x,
                const Axis &fine_y,
                const bool halve_x,
                const bool halve_y,
                const Conductor &conductor);

  /** Weights and positions of the fine nodes of the coarse cells from I0 on in row @p J,
   * zero in lanes beyond the grid. Number: float, double. */
  template <typename Number>
  void
  fill_patch(const unsigned int I0, const unsigned int J, Patch<Number> &patch) const;

  /** The conductor P^T A P on the coarse grid. */
  Conductor coarse_conductor(const Conductor &fine) const;

  AxisCoarsening x; ///< coarsening of columns
  AxisCoarsening y; ///< coarsening of rows
  Axis coarse_x;    ///< columns of the coarse grid
  Axis coarse_y;    ///< rows of the coarse grid

  /** Weight of the left node for the middle of the edge right of coarse node (I, J). */
  NodalField<float> left;
  /** Weight of the lower node for the middle of the edge above coarse node (I, J). */
  NodalField<float> lower;
  /** Weights of the corners 0 to 3 for the centre of coarse cell (I, J). */
  NodalField<float> corners;

  /** Distance of the middle of cell I from its left and its right node. */
  std::vector<std::array<double, 2>> x_distance;
  /** Distance of the middle of cell row J from its lower and its upper node. */
  std::vector<std::array<double, 2>> y_distance;

private:
  void set_left_weights(const int J,
                        const NodalField<float> &below,
                        const NodalField<float> &above);
  void set_lower_weights(const int J,
                         const NodalField<float> &below,
                         const NodalField<float> &above);
  void set_corner_weights(const int J,
                          const NodalField<float> &below,
                          const NodalField<float> &above);
  template <typename Number>
  void fill_lane(const unsigned int l,
                 const unsigned int I,
                 const unsigned int J,
                 Patch<Number> &patch) const;
};
} // namespace mesoslip::multigrid

#endif
