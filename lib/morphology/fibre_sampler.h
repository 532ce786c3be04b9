#ifndef mesoslip_morphology_fibre_sampler_h
#define mesoslip_morphology_fibre_sampler_h

#include "morphology/random_fibres.h"
#include "morphology/random_numbers.h"

namespace mesoslip
{
/** Draws single fibres, whatever lies around them. The arguments must outlive it. */
class FibreSampler
{
public:
  /** Prepares drawing by the rules of @p placement on @p box; seeds the numbers. */
  FibreSampler(const UniformGrid<2> &box, const FibrePlacement &placement);

  /** Whether any fibre satisfies the rules; otherwise draw() must not be called. */
  bool possible() const;

  /** A fibre of random height at a random place. */
  Rectangle draw();

  /** The fibre that covers @p height rows, its lower left cell being (@p x, @p y). */
  Rectangle aligned(const long x, const long y, const long height) const;

  /**
   * @name Sizes in whole cells, at least one
   * @{
   */
  /** Columns. */
  long width() const
  {
    return fibre_width;
  }

  /** Rows of the lowest fibre. */
  long min_height() const
  {
    return lowest;
  }

  /** Rows of the tallest fibre. */
  long max_height() const
  {
    return tallest;
  }
  /** @} */

  RandomNumbers random; ///< what draw() takes its numbers from

private:
  Rectangle draw_aligned();

  const UniformGrid<2> &grid;
  const FibrePlacement &rules;
  long fibre_width, lowest, tallest;
};
} // namespace mesoslip

#endif
