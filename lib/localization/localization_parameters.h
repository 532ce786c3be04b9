#ifndef mesoslip_localization_localization_parameters_h
#define mesoslip_localization_localization_parameters_h

#include "exchange/localization_file.h"

#include <limits>
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

  double heating = 0.; ///< change of temperature since the phases were free of stress (K)
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
} // namespace mesoslip

#endif
