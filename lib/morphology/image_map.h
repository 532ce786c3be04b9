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
/** How an image is to be read. */
struct ImageReading
{
  /** `values[p]` is the image value of phase p; empty: those that occur, ascending. */
  std::vector<long> values;
  unsigned int n_phases = 0;     ///< of `Phases/Names`
  bool oblong_pixels    = false; ///< pixels need not be squares in the body

  /** Instead of values, ascending: phase p begins at `thresholds[p - 1]`. */
  std::vector<double> thresholds = {};
};

/** Finds the phases of values of an image or of voxels. */
class PhaseOfValue
{
public:
  /** `values[p]` is that of phase p; without any the @p thresholds sort, see ImageReading. */
  PhaseOfValue(const std::vector<double> &thresholds, const std::vector<double> &values)
    : thresholds(thresholds)
    , values(values)
  {
  }

  /** The phase, or end() and more for a value without one. */
  unsigned int operator()(const double value) const
  {
    if (values.empty())
      return std::isfinite(value)
               ? std::upper_bound(thresholds.begin(), thresholds.end(), value) -
                   thresholds.begin()
               : none;
    return std::find(values.begin(), values.end(), value) - values.begin();
  }

  /** From this number on it is no phase. */
  unsigned int end() const
  {
    return values.empty() ? none : values.size();
  }

private:
  static constexpr unsigned int none = 256;
  const std::vector<double> thresholds, values;
};

/** What one phase is in an image. */
struct ImagePhase
{
  /** For messages: "200", "below 90"; of colours "#ff0000 (16711680)". */
  std::string value;
  std::size_t n_pixels = 0;  ///< number of its pixels
  double fraction      = 0.; ///< share of all pixels
};

/** A morphology that was drawn as an image. */
struct ImageMap
{
  PhaseMap<2> map;                ///< phase of each cell
  std::vector<ImagePhase> phases; ///< by phase
  /** Numbers of pixels along x and y. */
  std::array<unsigned int, 2> pixels = {};
};

/**
 * The morphology drawn in an image; the top row of the picture is the top of the box.
 *
 * Along each direction the pixels are the cells, or one number is a whole multiple of the
 * other, in both directions alike: a pixel becomes a block of cells, or a cell takes the
 * phase that most of its pixels have. Where several phases have as many, it takes the one
 * that lies furthest below its share of the pixels, counted cell by cell along the rows
 * from the bottom up to this cell (then the first of them): so ties change no fraction by
 * more than a cell.
 *
 * Throws UserError, beginning with @p source, when sizes do not fit, when pixels are
 * oblong by more than 1 % and should not be, and when it is not clear which value is
 * which phase: a value belongs to no phase, there are thresholds for colours or, without
 * `values` and `thresholds`, there are not as many values as phases.
 */
ImageMap map_from_image(const UniformGrid<2> &grid,
                        const Image &image,
                        const ImageReading &reading,
                        const std::string &source);

} // namespace mesoslip

#endif
