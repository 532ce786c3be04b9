#ifndef mesoslip_sliding_sweep_border_search_h
#define mesoslip_sliding_sweep_border_search_h

#include "sliding/sweep/sweep_parameters.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace mesoslip
{
/** Growth rate (1/s) of the fastest complex mode of a point: minus infinity if no mode was
 * found up to the highest frequency and the fastest decay, empty if a mode may be missing.
 */
using FastestGrowth = std::optional<double>;

/** A point of a map at which the fastest complex mode neither grows nor decays. */
struct BorderPoint
{
  std::vector<double> values; ///< along each axis of the map
  std::size_t axis = 0;       ///< the axis along which its neighbours in the map lie
};

/**
 * Finds the border of growth between neighbouring points of a grid of which one has a
 * growing mode and the other has none. The growth of the fastest mode has kinks along an
 * axis, as one mode takes over from another; modes that decay faster than those that are
 * looked for have none. Interpolation between the points of the map is therefore far off.
 * Growing modes change smoothly: a trial lies just beside the zero of the straight line
 * through the last two growing points, so that two trials enclose it. Every fourth trial
 * is halfway between the ends of the bracket. A border at 0, as of friction without
 * damping, cannot be known relative to its value: there the tolerance is that of a value
 * of tolerance times the distance of the points.
 */
class BorderSearch
{
public:
  /** @p growth has a value for each point of @p parameters. */
  BorderSearch(const SweepParameters &parameters,
               const std::vector<FastestGrowth> &growth);

  /** Values of the points whose growth is needed next; none: the border is known. */
  std::vector<std::vector<double>> wanted() const;

  /** Takes the growth of the points of wanted(), in their order; where it is empty, the
   * search is given up. */
  void take(const std::vector<FastestGrowth> &growth);

  /** The border: zeros of the last straight lines. */
  std::vector<BorderPoint> border() const;

private:
  /** One side of a bracket. */
  struct End
  {
    double value  = 0.; ///< value of the key that changes
    double growth = 0.; ///< 1/s
  };

  /** Two neighbouring points with the border between them. */
  struct Edge
  {
    std::vector<double> values; ///< shared by both points, but along the axis
    std::size_t axis = 0;
    bool logarithmic = false;
    End stable, growing;
    double distance                   = 0.; ///< distance of the points of the map
    std::optional<End> growing_before = std::nullopt; ///< the end before the last one
    unsigned int n_trials             = 0;

    double zero() const;
    bool is_known(const double tolerance) const;
    double trial(const double tolerance) const;
  };

  const double tolerance;
  std::vector<Edge> edges;
};
} // namespace mesoslip

#endif
