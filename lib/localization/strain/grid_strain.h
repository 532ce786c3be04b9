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
 * The strain of CellStrain in a block of equal cells. The gradients are the same for all
 * cells, and the slope weights depend only on the distance to the sides of the grid, so
 * only the mean strain is stored per cell.
 */
template <int dim>
class GridStrain
{
public:
  /** For the @p cells of @p body; at() needs two layers around each requested cell, as
   * far as the body reaches. */
  GridStrain(const UniformGrid<dim> &body, const CellBlock<dim> &cells);

  /** The cells. */
  const CellBlock<dim> &block() const
  {
    return cells;
  }

  /** Evaluates the strains for the displacement of the nodes of the block (m)
   * [n_nodes][dim]. */
  void set_displacement(const std::vector<double> &u);

  /** Mean strain of cell number @p k of the block. */
  const VoigtVector<dim> &mean(const std::size_t k) const
  {
    return means[k];
  }

  /** Strain at @p place in cell number @p k of the block, continued linearly from the
   * centre of the cell. */
  VoigtVector<dim> at(const std::size_t k, const dealii::Point<dim> &place) const;

private:
  /** A neighbour cell and its weight in the slope. */
  struct Neighbour
  {
    std::ptrdiff_t step;           ///< offset of its number in the block
    dealii::Tensor<1, dim> weight; ///< 1/m
  };

  /** Distances from the sides, up to two layers, as indices in a grid of at most five
   * cells along each axis. */
  using Kind = std::array<unsigned int, dim>;

  UniformGrid<dim> body;
  CellBlock<dim> cells;
  UniformGrid<dim> part; ///< the cells of the block as a grid
  std::array<dealii::Tensor<1, dim>, 1U << dim> gradient; ///< per corner (1/m)
  std::map<Kind, std::vector<Neighbour>> neighbours;
  std::vector<VoigtVector<dim>> means; ///< per cell of the block
};
} // namespace mesoslip

#endif
