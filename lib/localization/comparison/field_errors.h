#ifndef mesoslip_localization_comparison_field_errors_h
#define mesoslip_localization_comparison_field_errors_h

#include "grid/uniform_grid.h"
#include "localization/stress_statistics.h"
#include "material/phase.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/** Some cells of a grid under a name. */
struct CellRegion
{
  std::string name;               ///< as in field_errors.csv
  std::vector<std::size_t> cells; ///< indices, row by row from the bottom
};

/**
 * all; surface (centres nearer than @p surface_depth (m) to the contact, the lower side)
 * and bulk (the others); interior: without the cells whose centres are nearer than
 * @p edge_distance (m) to any side; surface_inner: without those that near to the left or
 * right one; for each phase NAME its cells, "NAME", and those in the
 * interior, "NAME_interior" ("phase_NAME..." if the phase is called like another region).
 */
std::vector<CellRegion> comparison_regions(const UniformGrid<2> &grid,
                                           const std::vector<std::uint8_t> &phase,
                                           const std::vector<Phase<2>> &phases,
                                           const double surface_depth,
                                           const double edge_distance);

/** One quantity in one region. */
struct FieldError
{
  /** mean_von_mises, mean_sigma_xx, ..., deviation_sigma_xy. */
  std::string quantity;
  std::string region;      ///< name of the CellRegion
  std::size_t n_cells = 0; ///< in the region
  /** Pa; root mean squares over the cells. */
  double rms        = 0.;
  double direct_rms = 0.; ///< of the direct run
  /** ||localized - direct|| / ||direct||; NaN when there is nothing to compare with. */
  double relative = 0.;
};

/** Every quantity that both have, in every region. */
std::vector<FieldError> field_errors(const StressFields &localized,
                                     const StressFields &direct,
                                     const std::vector<CellRegion> &regions);

/** localized - direct, of what both have. */
StressFields difference(const StressFields &localized, const StressFields &direct);
} // namespace mesoslip

#endif
