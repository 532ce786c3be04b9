#ifndef mesoslip_localization_strain_grid_interpolation_h
#define mesoslip_localization_strain_grid_interpolation_h

#include "grid/cell_block.h"
#include "localization/cell_rows.h"
#include "material/voigt.h"

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
  AxisWeights() = default;

  /** Weights from @p n_source cells to @p n_target cells, both at least 1. */
  AxisWeights(const unsigned int n_source, const unsigned int n_target);

  /** Whether the values are those of the source. */
  bool is_identity() const
  {
    return width == 1 && first.size() == n_source;
  }

  unsigned int n_source = 0;       ///< cells of the source
  unsigned int width    = 0;       ///< source cells that a target cell draws on
  std::vector<unsigned int> first; ///< first source cell of each target cell
  std::vector<double> weight; ///< [target cell][width]; those of a target cell sum to 1
};

/**
 * The strain of a run on a grid in the cells of another grid of the same box, from the
 * displacement of the nodes of some of its layers. Strains at cell centres are of second order,
 * better than anywhere else in a cell; they are interpolated by AxisWeights along all axes, along x
 * first: the rows that come of it serve several rows of a finer grid and are kept. One object for
 * each snapshot at hand.
 */
template <int dim>
class StrainInterpolation
{
public:
  /** Both grids cover the same box; @p known are the cells of the source whose nodes have a
   * displacement, all of them along all axes but the last. */
  StrainInterpolation(const UniformGrid<dim> &source,
                      const UniformGrid<dim> &target,
                      const CellBlock<dim> &known);

  /** Strains are those of @p u from now on: the displacement of the known nodes (m)
   * [n_nodes][dim], which stays the caller's. */
  void set_displacement(const double *u);

  /** Strain of row @p j of the target, numbered along y and then z, valid until the next call.
   * Rows are best asked for in their order. */
  CellRow row(const std::size_t j);

  /** The layers of the source along the last axis that the rows of the layers from @p begin to
   * @p end of the target draw on, the last one excluded. */
  static std::array<unsigned int, 2> layers(const UniformGrid<dim> &source,
                                            const UniformGrid<dim> &target,
                                            const unsigned int begin,
                                            const unsigned int end);

private:
  /** A row of cells by its place along y and z. */
  using RowIndex = std::array<unsigned int, dim - 1>;

  CellRow source_row(const RowIndex &at);

  UniformGrid<dim> source;              ///< the grid of the run
  std::size_t n_target;                 ///< cells of a row of the target
  std::size_t first_layer;              ///< of those known, along the last axis
  std::array<AxisWeights, dim> axes;    ///< from source to target
  const double *displacement = nullptr; ///< of the known nodes (m)
  CellRows scratch;                     ///< a strain row of the source
  CellRows kept;                        ///< rows that have been interpolated along x last
  std::vector<std::size_t> kept_row; ///< which row of the source each of them is, or none
  CellRows result;                   ///< a sum of such rows
};
} // namespace mesoslip

#endif
