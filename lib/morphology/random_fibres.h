#ifndef mesoslip_morphology_random_fibres_h
#define mesoslip_morphology_random_fibres_h

#include "morphology/rectangles.h"

#include <cstdint>
#include <random>
#include <vector>

namespace mesoslip
{
/** Largest seed in a .prm; members of an ensemble use the following seeds. */
constexpr long largest_seed = 1000000000000000000;

/**
 * Random numbers that are the same on every machine. The standard fixes the mersenne
 * twister but not the distributions, so the mapping to numbers is our own.
 */
class RandomNumbers
{
public:
  /** Equal @p seed, equal numbers on every machine. */
  explicit RandomNumbers(const std::uint64_t seed)
    : engine(seed)
  {
  }

  /** A uniform number in [0, 1), a multiple of 2^-53. */
  double unit()
  {
    return static_cast<double>(engine() >> 11) * 0x1p-53;
  }

  /** A uniform number in [lower, upper). */
  double between(const double lower, const double upper)
  {
    return lower + unit() * (upper - lower);
  }

  /** A uniform whole number among first, ..., last. */
  long whole(const long first, const long last)
  {
    return first + static_cast<long>(unit() * static_cast<double>(last - first + 1));
  }

private:
  std::mt19937_64 engine;
};

/** Definition of the area fraction of placed fibres. */
enum class FractionRule
{
  /** Area of the cells in a fibre: fibres are added until the target is reached. */
  actual,
  /** Sum of the fibres' areas inside the box; overlaps count twice. */
  nominal
};

/** Rules of random placement; lengths in metres. The defaults are the paper's pin. */
struct FibrePlacement
{
  std::uint64_t seed         = 1;      ///< the same seed gives the same morphology
  double width               = 0.1e-3; ///< m
  double min_height          = 1.2e-3; ///< m
  double max_height          = 3.6e-3; ///< m
  double area_fraction       = 0.1;    ///< target, 0 to 1
  FractionRule fraction_rule = FractionRule::actual; ///< definition of the fraction

  /** Whether fibres may share cells. */
  bool allow_overlap = false;

  /** Without overlaps: least free distance between the cells of two fibres, in x or in y
   * (m). */
  double minimum_gap = 0.;

  /** Whether fibres may extend beyond the box and are cut; otherwise they lie inside. */
  bool cut_by_border = false;

  /**
   * Edges lie on cell edges: width and heights are rounded to whole cells (at least
   * one), positions are whole numbers of cells. Otherwise positions and heights are
   * continuous and a cell belongs to a fibre when its centre does.
   */
  bool align_to_grid = true;

  /** Rule actual: shorten the last fibre so that the target is met as closely as
   * possible; otherwise the last whole fibre stays when that is closer to the target. */
  bool trim_last = true;

  std::uint8_t phase = 1; ///< index of the fibres' phase
};

/** Morphology made by place_random_fibres(). */
struct FibreMorphology
{
  PhaseMap<2> map; ///< 0: matrix; fibres as FibrePlacement::phase says

  /** In the order of placement. Cut fibres are listed whole, trimmed fibres trimmed. */
  std::vector<Rectangle> fibres;

  /** Area of fibre cells over area of the box. */
  double actual_fraction = 0.;

  /** Sum of the fibres' areas inside the box over area of the box. */
  double nominal_fraction = 0.;

  /** False if no further fibre fitted before the target was reached. */
  bool target_reached = false;

  /** The fraction by the definition @p rule. */
  double reached_fraction(const FractionRule rule) const
  {
    return rule == FractionRule::actual ? actual_fraction : nominal_fraction;
  }
};

/**
 * Random sequential placement of vertical fibres. Heights are uniform in their range,
 * positions uniform over all allowed places. If a place is taken, another one is drawn;
 * after many failed draws the remaining places inside the box are enumerated on the
 * grid, and heights that fit nowhere are no longer drawn. Ends when the target is
 * reached or nothing fits. Equal seeds give equal morphologies on every machine
 * (mersenne twister and our own mapping to numbers).
 */
FibreMorphology place_random_fibres(const UniformGrid<2> &grid,
                                    const FibrePlacement &placement);
} // namespace mesoslip

#endif
