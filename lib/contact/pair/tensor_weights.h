#ifndef mesoslip_contact_pair_tensor_weights_h
#define mesoslip_contact_pair_tensor_weights_h

#include "contact/pair/mortar_weights.h"

#include <array>
#include <optional>
#include <vector>

namespace mesoslip
{
/** A contact whose facets are the rectangles between lines along both axes. */
struct FacetGrid
{
  std::array<ContactFacets, 2>
    along; ///< edges between the lines of an axis, as the contact of a plane body

  /** Number in the contact of the node on line i of x and j of y, at i n_y + j, with n_y nodes along y. */
  std::vector<unsigned int> node;
};

/** The grid that a contact is, if it is one. */
std::optional<FacetGrid> grid_of(const ContactFacets &contact);

/** The weights of two grids of rectangles: products of those along the axes. */
class TensorWeights : public MovingWeights
{
public:
  /** Of the grid @p above over that @p below, which repeats itself after a @p period along x and y (m; 0: not). */
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
