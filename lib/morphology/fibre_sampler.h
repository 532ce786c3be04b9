#ifndef mesoslip_morphology_fibre_sampler_h
#define mesoslip_morphology_fibre_sampler_h

#include "morphology/random_fibres.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace mesoslip
{
/**
 * Random numbers that are the same on every machine. The standard fixes the mersenne
 * twister but not the distributions, so the mapping to numbers is our own.
 */
class RandomNumbers
{
public:
  /** The same @p seed gives the same numbers on every machine. */
  explicit RandomNumbers(const std::uint64_t seed)
    : engine(seed)
  {
  }

  /** Uniform in [0, 1), a multiple of 2^-53. */
  double unit()
  {
    return static_cast<double>(engine() >> 11) * 0x1p-53;
  }

  /** Uniform in [lower, upper). */
  double between(const double lower, const double upper)
  {
    return lower + unit() * (upper - lower);
  }

  /** Uniform among first, ..., last. */
  long whole(const long first, const long last)
  {
    return first + static_cast<long>(unit() * static_cast<double>(last - first + 1));
  }

private:
  std::mt19937_64 engine;
};
/** Draws single fibres, whatever lies around them. The arguments must outlive it. */
struct FibreSampler
{
  /** Prepares drawing by the rules of @p placement on @p box; seeds the numbers. */
  FibreSampler(const UniformGrid<2> &box, const FibrePlacement &placement)
    : random(placement.seed)
    , grid(box)
    , rules(placement)
    , width(whole_cells(placement.width, box.spacing[0]))
    , min_height(whole_cells(placement.min_height, box.spacing[1]))
    , max_height(std::max(min_height, whole_cells(placement.max_height, box.spacing[1])))
  {
    if (!rules.cut_by_border)
      max_height = std::min(max_height, static_cast<long>(grid.cells[1]));
  }

  /** Whether any fibre satisfies the rules; otherwise draw() must not be called. */
  bool possible() const
  {
    return rules.cut_by_border ||
           (width <= static_cast<long>(grid.cells[0]) && min_height <= max_height &&
            rules.width <= grid.extent(0) * (1. + 1e-9) &&
            rules.min_height <= grid.extent(1) * (1. + 1e-9));
  }

  /** The fibre that covers @p height rows, its lower left cell being (@p x, @p y). */
  Rectangle aligned(const long x, const long y, const long height) const
  {
    const auto [h_x, h_y] = grid.spacing;
    return {grid.origin[0] + static_cast<double>(x) * h_x,
            grid.origin[1] + static_cast<double>(y) * h_y,
            static_cast<double>(width) * h_x, static_cast<double>(height) * h_y,
            rules.phase};
  }

  /** A fibre of random height at a random place. */
  Rectangle draw()
  {
    const bool cut = rules.cut_by_border;
    if (rules.align_to_grid)
      {
        const long n_x = grid.cells[0], n_y = grid.cells[1];
        const long height = random.whole(min_height, max_height);
        const long x =
          cut ? random.whole(1 - width, n_x - 1) : random.whole(0, n_x - width);
        const long y =
          cut ? random.whole(1 - height, n_y - 1) : random.whole(0, n_y - height);
        return aligned(x, y, height);
      }
    const double limit =
      cut ? rules.max_height : std::min(rules.max_height, grid.extent(1));
    const double height = random.between(rules.min_height, limit);
    const double x      = cut ? random.between(-rules.width, grid.extent(0))
                              : random.between(0., grid.extent(0) - rules.width);
    const double y      = cut ? random.between(-height, grid.extent(1))
                              : random.between(0., grid.extent(1) - height);
    return {grid.origin[0] + x, grid.origin[1] + y, rules.width, height, rules.phase};
  }

  RandomNumbers random;        ///< what draw() takes its numbers from
  const UniformGrid<2> &grid;  ///< the box
  const FibrePlacement &rules; ///< the rules of the placement
  long width;                  ///< columns of a fibre, at least one
  long min_height;             ///< rows of the lowest fibre, at least one
  long max_height;             ///< rows of the tallest fibre

private:
  static long whole_cells(const double length, const double h)
  {
    return std::max(1L, std::lround(length / h));
  }
};
} // namespace mesoslip

#endif
