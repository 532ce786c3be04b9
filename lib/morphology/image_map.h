#ifndef mesoslip_morphology_image_map_h
#define mesoslip_morphology_image_map_h

#include "grid/uniform_grid.h"
#include "io/image.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** Settings for reading an image. */
struct ImageReading
{
  /** `values[p]` is the image value of phase p; empty: the occurring values,
   * ascending. */
  std::vector<long> values;
  unsigned int n_phases = 0;     ///< size of `Phases/Names`
  bool oblong_pixels    = false; ///< pixels need not be square in the body

  /** Alternative to values, ascending: phase p begins at `thresholds[p - 1]`. */
  std::vector<double> thresholds = {};
};

/** Maps values of an image or of voxels to phases. */
class PhaseOfValue
{
public:
  /** `values[p]` is the value of phase p; if empty, @p thresholds define the phases, see
   * ImageReading. */
  PhaseOfValue(const std::vector<double> &thresholds, const std::vector<double> &values)
    : thresholds(thresholds)
    , values(values)
  {
  }

  /** The phase, or end() or more for a value without a phase. */
  unsigned int operator()(const double value) const
  {
    if (values.empty())
      return std::isfinite(value)
               ? std::upper_bound(thresholds.begin(), thresholds.end(), value) -
                   thresholds.begin()
               : none;
    return std::find(values.begin(), values.end(), value) - values.begin();
  }

  /** Results from this number on are not phases. */
  unsigned int end() const
  {
    return values.empty() ? none : values.size();
  }

private:
  static constexpr unsigned int none = 256;
  const std::vector<double> thresholds, values;
};

/** A phase of an image. */
struct ImagePhase
{
  /** Value in messages: "200", "below 90"; for colours "#ff0000 (16711680)". */
  std::string value;
  std::size_t n_pixels = 0;  ///< number of its pixels
  double fraction      = 0.; ///< share of all pixels
};

/** A morphology drawn as an image. */
struct ImageMap
{
  PhaseMap<2> map;                ///< phase of each cell
  std::vector<ImagePhase> phases; ///< by phase number
  /** Numbers of pixels along x and y. */
  std::array<unsigned int, 2> pixels = {};
};

/**
 * The morphology drawn in an image; the top row of the picture is the top of the box.
 *
 * The number of pixels is a whole multiple of the number of cells or the reverse, in
 * both directions: a pixel becomes a block of cells, or a cell takes the phase of most
 * of its pixels. A tie goes to the phase that is furthest below its share of the pixels,
 * counted cell by cell along the rows from the bottom up to this cell (then to the lower
 * phase number), so ties change no fraction by more than a cell.
 *
 * Throws UserError, beginning with @p source, if sizes do not fit, if pixels are oblong
 * by more than 1 % and must not be, and if the phases are ambiguous: a value belongs to
 * no phase, there are thresholds for colours or, without `values` and `thresholds`, the
 * number of values differs from the number of phases.
 */
ImageMap map_from_image(const UniformGrid<2> &grid,
                        const Image &image,
                        const ImageReading &reading,
                        const std::string &source);

} // namespace mesoslip

#endif
