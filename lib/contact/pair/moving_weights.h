#ifndef mesoslip_contact_pair_moving_weights_h
#define mesoslip_contact_pair_moving_weights_h

#include "contact/pair/surface_facet.h"
#include "contact/pair/surface_weights.h"

#include <array>
#include <memory>
#include <vector>

namespace mesoslip
{
/** Nodes and facets of a contact. */
struct ContactFacets
{
  unsigned int n_nodes = 0;         ///< nodes of the whole contact
  std::vector<SurfaceFacet> facets; ///< facets between the nodes
};

/** Weights of two surfaces while the lower one moves. */
class MovingWeights
{
public:
  virtual ~MovingWeights() = default;

  /**
   * Weights after a displacement @p way (m) of the lower surface along x and y. @throws
   * NumericalFailure if the lower surface does not cover the upper one
   */
  virtual SurfaceWeights at(const std::array<double, 2> &way) const = 0;
};

/**
 * Weights of surface @p above over surface @p below, which has a @p period along x and y
 * (m; 0: not periodic). TensorWeights for two grids of rectangles, otherwise
 * MortarWeights; both give the same weights.
 */
std::shared_ptr<const MovingWeights>
make_moving_weights(const ContactFacets &above,
                    const ContactFacets &below,
                    const std::array<double, 2> &period);
} // namespace mesoslip

#endif
