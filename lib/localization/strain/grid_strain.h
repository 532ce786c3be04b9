#ifndef mesoslip_localization_strain_grid_strain_h
#define mesoslip_localization_strain_grid_strain_h

#include "grid/cell_block.h"
#include "localization/strain/slope_fits.h"
#include "material/voigt.h"

#include <map>
#include <vector>

namespace mesoslip
{
/**
 * The strain of CellStrain in a block of equal cells. The gradients at the corners are the same
 * for all cells, and those of the means depend on how near the sides of the grid are, so that
 * nothing is stored of a cell but its mean strain.
 */
template <int dim>
class GridStrain
{
public:
  /** For the cells @p cells of @p body; at() needs two layers around the cells that it is asked
   * for, as far as the body reaches. */
  GridStrain(const UniformGrid<dim> &body, const CellBlock<dim> &cells);

  /** The cells. */
  const CellBlock<dim> &block() const
  {
    return cells;
  }

  /** Evaluates the displacement of the nodes of the block (m) [n_nodes][dim]. */
  void set_displacement(const std::vector<double> &u);

  /** Mean strain of cell number @p k of the block. */
  const VoigtVector<dim> &mean(const std::size_t k) const
  {
    return means[k];
  }

  /** Strain at @p place in cell number @p k of the block, continued linearly from the
   * middle of the cell. */
  VoigtVector<dim> at(const std::size_t k, const dealii::Point<dim> &place) const;

private:
  /** Another cell that counts in the slope. */
  struct Neighbour
  {
    std::ptrdiff_t step;           ///< to its number in the block
    dealii::Tensor<1, dim> weight; ///< 1/m
  };

  /** Places along the axes in a grid of at most five cells along each, in which cells are as
   * far from the sides, up to two layers. */
  using Kind = std::array<unsigned int, dim>;

  UniformGrid<dim> body;
  CellBlock<dim> cells;
  UniformGrid<dim> part; ///< the cells of the block as a grid
  std::array<dealii::Tensor<1, dim>, 1U << dim> gradient; ///< of the corners (1/m)
  std::map<Kind, std::vector<Neighbour>> neighbours;
  std::vector<VoigtVector<dim>> means; ///< of the cells of the block
};
} // namespace mesoslip

#endif
