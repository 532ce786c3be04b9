#ifndef mesoslip_morphology_grid_parameters_h
#define mesoslip_morphology_grid_parameters_h

#include "grid/uniform_grid.h"

#include <array>

namespace mesoslip
{
class Keys;

/**
 * Section `Grid`: `Cells`, `Size` [m] and, instead of the size, `Spacing` [m].
 * The origin is the lower left corner. Defaults: the paper's pin at 0.1 mm.
 */
struct GridParameters
{
  std::array<unsigned int, 2> cells = {{560, 160}};     ///< numbers along x and y
  std::array<double, 2> size        = {{0.056, 0.016}}; ///< m, along x and y

  /** Binds the keys of the section, with the pin as default. */
  void bind(Keys &keys);

  /** Throws UserError for a `Size` that is not `Cells` times `Spacing`. */
  static void check_keys(const Keys &keys);

  /** Throws UserError unless there are cells of positive finite size, below 2^31 of them.
   */
  void check() const;

  /** The grid; check() has passed. */
  UniformGrid<2> grid() const;
};
} // namespace mesoslip

#endif
