#ifndef mesoslip_localization_localization_parameters_h
#define mesoslip_localization_localization_parameters_h

#include "exchange/localization_file.h"

#include <limits>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** Parameters of stress_localization. */
struct LocalizationParameters
{
  std::string rve_file;        ///< path of rve.h5
  std::string homogeneous_run; ///< path of its dynamics.h5
  /** Folder or dynamics.h5 of the direct run; empty: no comparison. */
  std::string direct_run;
  /** Whether to compare with a direct run under different loads. */
  bool allow_different_loads = false;

  /** Boundary condition of the concentration tensors: KUBC, PBC or MUBC. */
  std::string concentration = "KUBC";

  double heating = 0.; ///< change of temperature from the stress-free state (K)
  /** Eq. 24: localize the macroscopic strain at the place. */
  bool local_strain = true;
  /** Eq. 23: localize the mean strain of the body. */
  bool mean_strain = false;
  FieldSelection fields; ///< time averages to compute
  /** sigma_zz / (sigma_xx + sigma_yy) by phase; empty: from the stiffnesses. */
  std::vector<double> out_of_plane_ratio;

  /** Start of the window (s); NaN: start of the steady parts of the runs, from their
   * files. */
  double from = std::numeric_limits<double>::quiet_NaN();
  /** End of the window (s); NaN: the end of the runs. */
  double to = std::numeric_limits<double>::quiet_NaN();

  /** Names of probes of the homogeneous run, or "all". */
  std::vector<std::string> run_probes = {"all"};
  std::vector<LocalizedProbe> further_probes; ///< further probes, given by position

  /** Points of a body larger than the volume; the fields of the volume are computed for
   * the strain at each point. */
  std::vector<LocalizedProbe> points;

  /** Cells with centres nearer to the contact belong to the surface region (m). */
  double surface_depth = 0.4e-3;
  /** Cells nearer to a side do not belong to the interior (m). */
  double edge_distance = 1.6e-3;

  /** Whether every probe of the homogeneous run is wanted. */
  bool all_run_probes() const
  {
    return run_probes == std::vector<std::string>{"all"};
  }

  /** Binds the keys of all sections. @throws UserError naming the key. */
  void bind(Keys &keys);

  /** @throws UserError for keys that have no effect with the other keys. */
  static void check_keys(const Keys &keys);

  /**
   * Checks that the input files exist; replaces a folder by the file in it.
   * @throws UserError
   */
  void check();
};
} // namespace mesoslip

#endif
