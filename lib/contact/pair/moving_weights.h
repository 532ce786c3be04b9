#ifndef mesoslip_contact_pair_moving_weights_h
#define mesoslip_contact_pair_moving_weights_h

#include "contact/pair/surface_facet.h"
#include "contact/pair/surface_weights.h"

#include <array>
#include <memory>
#include <vector>

namespace mesoslip
{
/** A contact as its nodes and facets. */
struct ContactFacets
{
  unsigned int n_nodes = 0;         ///< of the whole contact
  std::vector<SurfaceFacet> facets; ///< between them
};

/** The weights of two surfaces, one of which moves below the other one. */
class MovingWeights
{
public:
  virtual ~MovingWeights() = default;

  /** With the surface below moved by @p way (m) along x and y. @throws NumericalFailure where it ends below the upper one */
  virtual SurfaceWeights at(const std::array<double, 2> &way) const = 0;
};

/** Those of surface @p above over surface @p below, which repeats itself after a @p period along x and y (m; 0: not): TensorWeights of
 * two grids of rectangles, else MortarWeights, which are the same. */
std::shared_ptr<const MovingWeights>
make_moving_weights(const ContactFacets &above,
                    const ContactFacets &below,
                    const std::array<double, 2> &period);
} // namespace mesoslip

#endif
