#ifndef mesoslip_contact_pair_tensor_weights_h
#define mesoslip_contact_pair_tensor_weights_h

#include "contact/pair/mortar_weights.h"

#include <array>
#include <optional>
#include <vector>

namespace mesoslip
{
/** A contact whose facets are the rectangles of a tensor-product grid. */
struct FacetGrid
{
  std::array<ContactFacets, 2>
    along; ///< edges along each axis, as in the contact of a plane body

  /**
   * Number in the contact of the node on line i of x and line j of y, at i n_y + j, with
   * n_y nodes along y.
   */
  std::vector<unsigned int> node;
};

/** Grid of a contact; empty if it is not a tensor-product grid. */
std::optional<FacetGrid> grid_of(const ContactFacets &contact);

/** Weights of two grids of rectangles: products of the weights along the axes. */
class TensorWeights : public MovingWeights
{
public:
  /**
   * Weights of grid @p above over grid @p below, which has a @p period along x and y (m;
   * 0: not periodic).
   */
  TensorWeights(const FacetGrid &above,
                const FacetGrid &below,
                const std::array<double, 2> &period);

  SurfaceWeights at(const std::array<double, 2> &way) const override;

private:
  const std::array<MortarWeights, 2> along;
  const std::vector<unsigned int> below;
  const unsigned int above_in_y, below_in_y; ///< numbers of nodes along y
  std::vector<unsigned int> place;           ///< i n_y + j of each node above
};
} // namespace mesoslip

#endif
