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
 * Interpolation of cell values along one axis, from @p n_source to @p n_target cells
 * that cover the same length: target value i is the sum of weight[i width + k] times the
 * source value first[i] + k.
 *
 * If n_source = r n_target with an integer r, the weights form the mean of r cells (r =
 * 1: identity). Otherwise interpolation is linear between the two nearest cell centres,
 * and extrapolates beyond the outermost ones; it is exact for linear functions.
 */
struct AxisWeights
{
  AxisWeights() = default;

  /** Weights from @p n_source cells to @p n_target cells, both at least 1. */
  AxisWeights(const unsigned int n_source, const unsigned int n_target);

  /** Whether target values equal source values. */
  bool is_identity() const
  {
    return width == 1 && first.size() == n_source;
  }

  unsigned int n_source = 0;       ///< cells of the source
  unsigned int width    = 0;       ///< source cells per target cell
  std::vector<unsigned int> first; ///< first source cell of each target cell
  std::vector<double> weight;      ///< [target cell][width]; sum per target cell is 1
};

/**
 * The strain of a run on a grid, in the cells of another grid of the same box, from the
 * displacement of the nodes of some of its layers. Strains at cell centres are of second
 * order, more accurate than elsewhere in a cell. They are interpolated by AxisWeights
 * along all axes, x first; the interpolated rows are kept, as they serve several rows of
 * a finer grid. One object per snapshot in memory.
 */
template <int dim>
class StrainInterpolation
{
public:
  /** Both grids cover the same box. @p known are the cells of the source with known nodal
   * displacements: all cells along all axes except the last. */
  StrainInterpolation(const UniformGrid<dim> &source,
                      const UniformGrid<dim> &target,
                      const CellBlock<dim> &known);

  /** Sets the displacement of the known nodes (m) [n_nodes][dim] for the following
   * strains; @p u is referenced, not copied. */
  void set_displacement(const double *u);

  /** Strain of row @p j of the target, numbered along y and then z, valid until the next
   * call. Ascending order is fastest. */
  CellRow row(const std::size_t j);

  /** Range of source layers along the last axis, [begin, end), needed for the target
   * layers from @p begin to @p end. */
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
  std::size_t first_layer;              ///< first known layer, along the last axis
  std::array<AxisWeights, dim> axes;    ///< interpolation from source to target
  const double *displacement = nullptr; ///< displacement of the known nodes (m)
  CellRows scratch;                     ///< a strain row of the source
  CellRows kept;                        ///< rows last interpolated along x
  std::vector<std::size_t> kept_row;    ///< source row of each kept row, or none
  CellRows result;                      ///< weighted sum of kept rows
};
} // namespace mesoslip

#endif
