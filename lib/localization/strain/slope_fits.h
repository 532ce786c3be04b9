#ifndef mesoslip_localization_strain_slope_fits_h
#define mesoslip_localization_strain_slope_fits_h

#include "mesh/mesh.h"

#include <vector>

namespace mesoslip
{
/** Weight of a neighbour's mean in the slope of a cell. */
template <int dim>
struct SlopeWeight
{
  unsigned int cell;             ///< the neighbour
  dealii::Tensor<1, dim> weight; ///< 1/m
};

/**
 * The slope in a cell of a field with known cell means: a linear least-squares fit, with
 * weights 1 / distance^2, to the differences to the means of the face neighbours. If
 * these do not span the space, as in a corner of simplices, the face neighbours of the
 * face neighbours are included.
 */
template <int dim>
class SlopeFits
{
public:
  /** @p of_mesh must outlive this object. */
  explicit SlopeFits(const Mesh<dim> &of_mesh);

  /** Weights of the slope in @p cell. */
  std::vector<SlopeWeight<dim>> of(const unsigned int cell) const;

private:
  /** Face neighbours in ascending order. */
  std::vector<unsigned int> face_neighbours(const unsigned int cell) const;

  std::vector<std::vector<unsigned int>> cells_of_point;
  const Mesh<dim> &mesh;
};
} // namespace mesoslip

#endif
