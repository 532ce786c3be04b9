#ifndef mesoslip_localization_localization_input_h
#define mesoslip_localization_localization_input_h

#include "exchange/rve_file.h"
#include "localization/snapshot_pass.h"
#include "localization/stress_statistics.h"
#include "program/output_folder.h"

#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** What stress_localization is asked for. */
struct LocalizationParameters
{
  std::string rve_file;        ///< path of rve.h5
  std::string homogeneous_run; ///< path of its dynamics.h5
  /** Empty: no comparison. */
  std::string direct_run;
  /** Compare with a direct run under other loads all the same. */
  bool allow_different_loads = false;

  /** KUBC, PBC or MUBC. */
  std::string concentration = "KUBC";
  /** Eq. 24: the macroscopic strain at the place. */
  bool local_strain = true;
  /** Eq. 23: its mean over the body. */
  bool mean_strain = false;
  FieldSelection fields; ///< averages over time to compute
  /** sigma_zz / (sigma_xx + sigma_yy) by phase; empty: from the stiffnesses. */
  std::vector<double> out_of_plane_ratio;

  /** Begin of the window (s); NaN: when the runs are steady, as their files tell. */
  double from = std::numeric_limits<double>::quiet_NaN();
  /** End of the window (s); NaN: the end of the runs. */
  double to = std::numeric_limits<double>::quiet_NaN();

  /** Names of probes of the homogeneous run, or "all". */
  std::vector<std::string> run_probes = {"all"};
  std::vector<LocalizedProbe> further_probes; ///< places of one's own

  /** Points of a body that is larger than the volume, whose fields are wanted there. */
  std::vector<LocalizedProbe> points;

  /** Cells whose centres are nearer to the contact are the surface (m). */
  double surface_depth = 0.4e-3;
  /** Cells nearer to an edge are not in the interior (m). */
  double edge_distance = 1.6e-3;

  /** Whether every probe of the homogeneous run is wanted. */
  bool all_run_probes() const
  {
    return run_probes == std::vector<std::string>{"all"};
  }

  /** Binds the keys of all sections. @throws UserError naming the key. */
  void bind(Keys &keys);

  /** @throws UserError for keys that others leave without effect. */
  static void check_keys(const Keys &keys);

  /**
   * Checks that the input files exist; a folder becomes the path of the file in it.
   * @throws UserError
   */
  void check();
};

/** sigma_zz / (sigma_xx + sigma_yy) of each phase, as asked for or Poisson's ratio of the
 * closest isotropic solid. @throws UserError for another number of them */
template <int dim>
std::vector<double> out_of_plane_ratios(const LocalizationParameters &parameters,
                                        const RveFile<dim> &rve);

/** What takes the place in localization.h5. */
struct LocalizationExtent
{
  double n_cells      = 0.; ///< of the volume
  double mesh_bytes   = 0.; ///< of its points and cells; a grid takes none
  double n_field_sets = 0.; ///< of variants, direct run, differences and points
  double n_series     = 0.; ///< probes in all variants
  double n_numbers    = 0.; ///< in these
};

/** Bytes of localization.h5 with these fields. */
template <int dim>
ResourceNeed need_of(const LocalizationExtent &extent, const FieldSelection &fields);

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

  /** Files, snapshots, memory and disk, for --validate. */
  void describe(std::ostream &out) const;

  /** What localization.h5 takes. */
  ResourceNeed need() const;

  /** Number of the cell of a probe, row by row. */
  std::size_t number_of_cell(const LocalizedProbe &probe) const
  {
    return probe.cell[0] + std::size_t(probe.cell[1]) * rve.grid.cells[0];
  }

  /** Cells of the probes that are followed through the snapshots. */
  std::vector<CellIndex> followed_cells() const;

  const LocalizationParameters parameters; ///< what is asked for
  const RveFile<2> rve;                    ///< morphology, stiffnesses
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
