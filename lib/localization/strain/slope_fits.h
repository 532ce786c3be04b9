#ifndef mesoslip_localization_strain_slope_fits_h
#define mesoslip_localization_strain_slope_fits_h

#include "mesh/mesh.h"

#include <vector>

namespace mesoslip
{
/** What the difference of the mean in another cell adds to the slope in a cell. */
template <int dim>
struct SlopeWeight
{
  unsigned int cell;             ///< the other one
  dealii::Tensor<1, dim> weight; ///< 1/m
};

/**
 * The slope in a cell of a field whose means over the cells are known: the linear
 * least-squares fit, with weights 1 / distance^2, to the differences of the means of the cells
 * that share a face with it; where these do not span the space, as in a corner of simplices,
 * also of those that share a face with them.
 */
template <int dim>
class SlopeFits
{
public:
  /** The mesh must outlive it. */
  explicit SlopeFits(const Mesh<dim> &of_mesh);

  /** What the slope in @p cell is made of. */
  std::vector<SlopeWeight<dim>> of(const unsigned int cell) const;

private:
  /** In ascending order. */
  std::vector<unsigned int> face_neighbours(const unsigned int cell) const;

  std::vector<std::vector<unsigned int>> cells_of_point;
  const Mesh<dim> &mesh;
};
} // namespace mesoslip

#endif
