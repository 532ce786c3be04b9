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
/** A run and its conditions (loads and supports), which are empty if its file has
 * none. */
struct RunSource
{
  std::string path;                        ///< path of dynamics.h5
  std::optional<RunConditions> conditions; ///< see RunConditions
};

/** The snapshots of a run. */
struct RunSnapshots
{
  std::string path;          ///< path of dynamics.h5
  std::vector<double> times; ///< ascending (s)
};

/**
 * Differences between the conditions of the two runs, homogeneous run first; adds
 * sentences on them to @p notes and @p warnings.
 * @throws UserError, unless @p allow_different_loads, if loads, supports or friction
 * coefficients differ: then the stresses differ for reasons other than localization.
 */
std::vector<ConditionDifference> compare_conditions(const RunSource &homogeneous,
                                                    const RunSource &direct,
                                                    const bool allow_different_loads,
                                                    std::vector<std::string> &notes,
                                                    std::vector<std::string> &warnings);

/**
 * Start of the steady part of a run (s); minus infinity for a static analysis.
 * @throws UserError naming Window/From if the file does not state it.
 */
double steady_from(const RunSource &run);

/**
 * The part of @p window in which both runs have snapshots (within half of the longer
 * snapshot interval), so that both averages cover the same time; @p window itself for
 * two static states.
 * @throws UserError if there is none.
 */
TimeWindow shared_snapshots(const RunSnapshots &one,
                            const RunSnapshots &other,
                            const TimeWindow &window);

/** "between 0.1 and 0.2 s", for a sentence. */
std::string window_text(const TimeWindow &window);

/** Snapshots of a run in the window.
 * @throws UserError if there are none. */
IndexRange snapshots_in(const RunSnapshots &run, const TimeWindow &window);

/** Statistics of one stress component of a probe; NaN where undefined. */
struct ComponentStatistics
{
  /** Not a number. */
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double mean             = unknown; ///< mean of the localized series (Pa)
  double deviation        = unknown; ///< standard deviation (Pa)
  double direct_mean      = unknown; ///< mean of the direct series (Pa)
  double direct_deviation = unknown; ///< standard deviation of the direct series (Pa)
  /**
   * Relative error of the mean, localized / direct - 1: negative if too small in
   * magnitude. Independent of the phase between the two series, which is arbitrary for
   * limit cycles of two runs.
   */
  double error_mean      = unknown;
  double error_deviation = unknown; ///< the same for the standard deviations
  /** rms of the difference at equal times, relative to the rms of the direct series. */
  double rms_difference = unknown;
};

/**
 * Linear interpolation of a series at @p times, which lie within its range up to
 * round-off. A series of one sample is constant.
 */
std::vector<double> resample(const ProbeSeries &series, const std::vector<double> &times);

/**
 * Compares @p stress [k][n] with @p direct; @p resampled [k][n] is @p direct at the
 * times of @p stress. Without a direct series only mean and deviation are known.
 */
std::vector<ComponentStatistics> compare_series(const std::vector<double> &stress,
                                                const std::vector<double> &direct,
                                                const std::vector<double> &resampled,
                                                const std::size_t n = 3);

/** A named set of cells of a body. */
struct CellRegion
{
  std::string name;               ///< name in field_errors.csv
  std::vector<std::size_t> cells; ///< indices, on a grid row by row from the bottom
};

/**
 * Regions of the cells with these @p centres, measured from the lower corner of the
 * bounding box (m), whose sides are @p extent. all; surface: centres nearer than
 * @p surface_depth (m) to the lower end of the last axis, the contact; bulk: the rest;
 * interior: centres at least @p edge_distance (m) from every side of the box;
 * surface_inner: surface without cells that near to a side across the other axes; for
 * each phase NAME its cells, "NAME", and its cells in the interior, "NAME_interior"
 * ("phase_NAME..." if another region has the name of the phase).
 */
template <int dim>
std::vector<CellRegion> comparison_regions(const std::vector<dealii::Point<dim>> &centres,
                                           const dealii::Point<dim> &extent,
                                           const std::vector<std::uint8_t> &phase,
                                           const std::vector<std::string> &phases,
                                           const double surface_depth,
                                           const double edge_distance);

/** Error of one quantity in one region. */
struct FieldError
{
  /** mean_von_mises, mean_sigma_xx, ..., deviation_sigma_xy. */
  std::string quantity;
  std::string region;      ///< name of the CellRegion
  std::size_t n_cells = 0; ///< number of cells of the region
  /** Pa; root mean squares over the cells, on a mesh weighted with their volumes. */
  double rms        = 0.;
  double direct_rms = 0.; ///< same for the direct run
  /** ||localized - direct|| / ||direct||; NaN without a direct field. */
  double relative = 0.;
};

/** Errors of all quantities of @p fields in all regions; @p volume is the volume of each
 * cell, empty if all are equal. Sums over the cells of all ranks. Collective. */
std::vector<FieldError> field_errors(const unsigned int dim,
                                     const FieldSelection &fields,
                                     const StressFields &localized,
                                     const StressFields &direct,
                                     const std::vector<CellRegion> &regions,
                                     const std::vector<double> &volume = {},
                                     const MPI_Comm communicator       = MPI_COMM_SELF);

/** localized - direct, for the fields that both have. */
StressFields difference(const StressFields &localized, const StressFields &direct);
} // namespace mesoslip

#endif
