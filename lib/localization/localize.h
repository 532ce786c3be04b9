#ifndef mesoslip_localization_localize_h
#define mesoslip_localization_localize_h

#include "base/timer.h"
#include "exchange/time_window.h"
#include "localization/comparison/field_errors.h"
#include "localization/comparison/series_comparison.h"
#include "localization/localization_parameters.h"
#include "localization/snapshot_pass.h"
#include "localization/stress_statistics.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace mesoslip
{
/** Localized stress at a place over time. */
struct ProbeResult
{
  std::string name; ///< as in the results
  /** From the lower left corner (m). */
  std::array<double, 2> position = {};
  /** Of the RVE; its L and phase were used. */
  CellIndex cell     = {};
  unsigned int phase = 0; ///< index of the cell's phase
  std::string phase_name; ///< name of the cell's phase

  /** s */
  std::vector<double> time;
  /** Pa, [k][3]. */
  std::vector<double> stress;
  /** Pa, [k][3], the direct run's at the same times; empty without one. */
  std::vector<double> direct_stress;
  std::array<ComponentStatistics, 3> statistics; ///< of xx, yy, xy
};

/** All that follows from one of eqs 23 and 24. */
struct VariantResult
{
  /** "local strain" or "mean strain". */
  std::string name;
  StressFields fields; ///< averages over time
  /** Localized minus direct; empty without a direct run. */
  StressFields difference;
  std::vector<FieldError> errors;  ///< against the direct run
  std::vector<ProbeResult> probes; ///< in the order of the plan
};

/** Everything that localize() found; on rank 0. */
struct LocalizationResult
{
  UniformGrid<2> grid; ///< of the RVE
  /** Degrees of freedom of the homogeneous run. */
  std::size_t dofs = 0;
  std::vector<std::string> phase_names; ///< by index
  /** s; first and last time used. */
  TimeWindow window;
  std::size_t n_snapshots        = 0; ///< of the homogeneous run
  std::size_t n_direct_snapshots = 0; ///< of the direct run
  /** Empty without a direct run. */
  StressFields direct;
  /** Local strain first when both were asked for. */
  std::vector<VariantResult> variants;
  /** In what the runs differ, homogeneous first; empty without a direct run. */
  std::vector<ConditionDifference> differences;
  /** Of the three files. */
  std::vector<std::string> digests;
};

/** Where localize() says what it does; functions may be empty. */
struct LocalizationMonitor
{
  /** One line. */
  std::function<void(const std::string &)> log;

  /** One line, marked as a warning. */
  std::function<void(const std::string &)> warn;
  /** The inputs were checked: the run begins. */
  std::function<void()> begin;
  /** Begin of an activity with so many steps. */
  std::function<void(const std::string &, const std::size_t)> start;
  /** Steps done; may throw to stop. */
  std::function<void(const std::size_t)> update;
  /** For the profile; may be null. */
  Timer *timer = nullptr;
};

/**
 * Eqs 22 to 24 of the paper: the stresses of the composite from a run of the homogenized
 * body. Works on one process. @throws UserError.
 */
LocalizationResult localize(const LocalizationParameters &parameters,
                            const LocalizationMonitor &monitor = {});

/** What --validate tells: files, snapshots, memory. */
std::string describe_localization(const LocalizationParameters &parameters);
} // namespace mesoslip

#endif
