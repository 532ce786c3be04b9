#ifndef mesoslip_localization_localization_input_h
#define mesoslip_localization_localization_input_h

#include "exchange/run_file.h"
#include "exchange/rve_file.h"
#include "exchange/time_window.h"
#include "localization/comparison/run_comparison.h"
#include "localization/localization_parameters.h"
#include "localization/snapshot_pass.h"

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** The files of a localization, opened and found to belong together. */
struct LocalizationInput
{
  /**
   * @throws UserError when the grids do not cover the same box (to 1e-9), when the
   * homogeneous run is one of a heterogeneous body, when the direct run's grid is no
   * refinement of the RVE's, its phases lie elsewhere or its loads are others. What is
   * only suspicious is added to warnings.
   */
  explicit LocalizationInput(const LocalizationParameters &parameters);

  RveFile rve;                        ///< morphology, stiffnesses, concentration tensors
  RunFile homogeneous;                ///< run whose strains are localized
  std::optional<RunFile> direct;      ///< heterogeneous run to compare with
  std::vector<std::uint8_t> phase_id; ///< [ny][nx]
  /** sigma_zz / (sigma_xx + sigma_yy) by phase. */
  std::vector<double> out_of_plane_ratio;
  TimeWindow window; ///< times used (s)
  /** In what the two runs differ, homogeneous first. */
  std::vector<ConditionDifference> differences;
  std::vector<std::string> notes;    ///< sentences for the log, no warnings
  std::vector<std::string> warnings; ///< sentences for the log

  /** The part of the window in which both runs have snapshots. @throws UserError */
  TimeWindow snapshot_window() const;
};

/** A probe and where its series come from. */
struct PlannedProbe
{
  std::string name;                    ///< as in the results
  std::array<double, 2> position = {}; ///< m, from the lower left corner
  CellIndex cell                 = {}; ///< of the RVE, which holds the position
  /** Whether the homogeneous run recorded it; otherwise the snapshots are used. */
  bool recorded = false;
  /** Name of the direct run's probe at the place; empty when it has none. */
  std::string direct_name;
};

/** The probes asked for. @throws UserError for unknown names and places outside. */
std::vector<PlannedProbe> plan_probes(const LocalizationParameters &parameters,
                                      LocalizationInput &input);

/**
 * Snapshots of a run in the window. @throws UserError when there are none.
 */
IndexRange snapshots_in(const RunFile &run, const TimeWindow &window);
} // namespace mesoslip

#endif
