#ifndef mesoslip_localization_comparison_h
#define mesoslip_localization_comparison_h

#include "exchange/localization_file.h"
#include "exchange/run_description.h"
#include "exchange/time_window.h"

#include <array>
#include <limits>
#include <mpi.h>
#include <string>
#include <vector>

namespace mesoslip
{
/** A run and under what it was made, nothing if its file does not tell. */
struct RunSource
{
  std::string path;                        ///< of dynamics.h5
  std::optional<RunConditions> conditions; ///< see there
};

/** The snapshots of a run. */
struct RunSnapshots
{
  std::string path;          ///< of dynamics.h5
  std::vector<double> times; ///< ascending (s)
};

/**
 * In what the conditions of the two runs differ, homogeneous run first; adds sentences on
 * it to @p notes and @p warnings.
 * @throws UserError, unless @p allow_different_loads, if the two were not made under the
 * same loads, supports and friction coefficient: then they differ for other reasons than
 * localization.
 */
std::vector<ConditionDifference> compare_conditions(const RunSource &homogeneous,
                                                    const RunSource &direct,
                                                    const bool allow_different_loads,
                                                    std::vector<std::string> &notes,
                                                    std::vector<std::string> &warnings);

/**
 * When a run is steady (s); minus infinity for a static analysis. @throws UserError
 * naming Window/From if the file does not tell.
 */
double steady_from(const RunSource &run);

/**
 * The part of @p window in which both runs have snapshots, up to half of the longer
 * interval between them, so that averages are over the same time; @p window itself for
 * two static states. @throws UserError if there is none.
 */
TimeWindow shared_snapshots(const RunSnapshots &one,
                            const RunSnapshots &other,
                            const TimeWindow &window);

/** "between 0.1 and 0.2 s", for a sentence. */
std::string window_text(const TimeWindow &window);

/** Snapshots of a run in the window. @throws UserError when there are none. */
IndexRange snapshots_in(const RunSnapshots &run, const TimeWindow &window);

/** One stress component of a probe; NaN where there is nothing to say. */
struct ComponentStatistics
{
  /** Not a number. */
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double mean             = unknown; ///< of the localized series (Pa)
  double deviation        = unknown; ///< standard deviation (Pa)
  double direct_mean      = unknown; ///< of the direct series, at its own samples (Pa)
  double direct_deviation = unknown; ///< standard deviation of the direct one (Pa)
  /**
   * localized / direct - 1: negative when too small in magnitude. They do not ask whether
   * the two series are in step: limit cycles of two runs have arbitrary phases.
   */
  double error_mean      = unknown;
  double error_deviation = unknown; ///< of the standard deviations
  /** rms of the difference at equal times, relative to the rms of the direct series. */
  double rms_difference = unknown;
};

/**
 * Linear interpolation of a series at @p times, which lie within its own up to round-off.
 * A series of one sample holds at all times.
 */
std::vector<double> resample(const ProbeSeries &series, const std::vector<double> &times);

/**
 * @p stress [k][n] against @p direct; @p resampled [k][n] is the latter at the times of
 * the former. An empty direct series leaves all but mean and deviation unknown.
 */
std::vector<ComponentStatistics> compare_series(const std::vector<double> &stress,
                                                const std::vector<double> &direct,
                                                const std::vector<double> &resampled,
                                                const std::size_t n = 3);

/** Some cells of a body under a name. */
struct CellRegion
{
  std::string name;               ///< as in field_errors.csv
  std::vector<std::size_t> cells; ///< indices, on a grid row by row from the bottom
};

/**
 * Regions of the cells with these centres, from the lower corner of the bounding box (m),
 * whose sides are @p extent: all; surface (centres nearer than @p surface_depth (m) to the
 * lower end of the last axis, the contact) and bulk (the others); interior: without the
 * cells whose centres are nearer than @p edge_distance (m) to any side of the box;
 * surface_inner: without those that near to a side across the other axes; for each phase NAME its cells, "NAME", and those in the
 * interior, "NAME_interior" ("phase_NAME..." if the phase is called like another region).
 */
template <int dim>
std::vector<CellRegion> comparison_regions(const std::vector<dealii::Point<dim>> &centres,
                                           const dealii::Point<dim> &extent,
                                           const std::vector<std::uint8_t> &phase,
                                           const std::vector<std::string> &phases,
                                           const double surface_depth,
                                           const double edge_distance);

/** One quantity in one region. */
struct FieldError
{
  /** mean_von_mises, mean_sigma_xx, ..., deviation_sigma_xy. */
  std::string quantity;
  std::string region;      ///< name of the CellRegion
  std::size_t n_cells = 0; ///< in the region
  /** Pa; root mean squares over the cells, on a mesh weighted with their volumes. */
  double rms        = 0.;
  double direct_rms = 0.; ///< of the direct run
  /** ||localized - direct|| / ||direct||; NaN when there is nothing to compare with. */
  double relative = 0.;
};

/** Every quantity of the @p fields in every region; @p volume is that of each cell, empty
 * if all are equal. Each rank has other cells; over all of them. Collective. */
std::vector<FieldError> field_errors(const unsigned int dim,
                                     const FieldSelection &fields,
                                     const StressFields &localized,
                                     const StressFields &direct,
                                     const std::vector<CellRegion> &regions,
                                     const std::vector<double> &volume = {},
                                     const MPI_Comm communicator       = MPI_COMM_SELF);

/** localized - direct, of what both have. */
StressFields difference(const StressFields &localized, const StressFields &direct);
} // namespace mesoslip

#endif
