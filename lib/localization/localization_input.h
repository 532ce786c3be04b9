#ifndef mesoslip_localization_localization_input_h
#define mesoslip_localization_localization_input_h

#include "exchange/rve_file.h"
#include "localization/localization_parameters.h"
#include "localization/snapshot_pass.h"

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** A probe, without series yet, and where they come from. */
struct PlannedProbe : LocalizedProbe
{
  /** Whether the homogeneous run recorded it; otherwise the snapshots are used. */
  bool recorded = false;
  ProbeSeries strain; ///< of a recorded probe, if its own strain is asked for
  ProbeSeries direct; ///< stress of the direct run's probe at the place; may be empty
};

/**
 * The files of a localization, opened and found to belong together, and what is taken from
 * them.
 */
class LocalizationInput
{
public:
  /**
   * @throws UserError when the grids do not cover the same box (to 1e-9), when the
   * homogeneous run is one of a heterogeneous body, when the direct run's grid is no
   * refinement of the RVE's, its phases lie elsewhere or its loads are others; when there
   * are no snapshots or samples in the window, and for unknown probes and places outside.
   * What is only suspicious is added to warnings.
   */
  explicit LocalizationInput(const LocalizationParameters &p);

  /** Files, snapshots and memory, for --validate. */
  void describe(std::ostream &out) const;

  /** Number of the cell of a probe, row by row. */
  std::size_t number_of_cell(const LocalizedProbe &probe) const
  {
    return probe.cell[0] + std::size_t(probe.cell[1]) * rve.grid.cells[0];
  }

  /** Cells of the probes that are followed through the snapshots. */
  std::vector<CellIndex> followed_cells() const;

  const LocalizationParameters parameters; ///< what is asked for
  const RveFile rve;                       ///< morphology, stiffnesses
  const DynamicsFile homogeneous;          ///< run whose strains are localized
  std::optional<DynamicsFile> direct;      ///< heterogeneous run to compare with
  std::vector<std::uint8_t> phase_id;      ///< [ny][nx]
  std::vector<double> concentration;       ///< tensors L [ny][nx][3][3]
  std::vector<double> out_of_plane_ratio;  ///< sigma_zz / (sigma_xx + sigma_yy) by phase
  TimeWindow window;                       ///< times used (s)
  IndexRange snapshots;                    ///< of the homogeneous run that are used
  IndexRange direct_snapshots;             ///< of the direct run that are used
  std::vector<PlannedProbe> probes;        ///< those asked for
  std::vector<ConditionDifference> differences; ///< of the runs, homogeneous first
  std::vector<std::string> notes;               ///< sentences for the log, no warnings
  std::vector<std::string> warnings;            ///< sentences for the log

private:
  void check_run(const DynamicsFile &run, const std::string &role);
  void check_direct();
  void choose_window();
  void choose_snapshots();
  void plan_probes();
  void complete(PlannedProbe &probe);
};
} // namespace mesoslip

#endif
