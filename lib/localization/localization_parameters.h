#ifndef mesoslip_localization_localization_parameters_h
#define mesoslip_localization_localization_parameters_h

#include "localization/stress_statistics.h"
#include "localization/time_window.h"

#include <array>
#include <string>
#include <vector>

namespace dealii
{
class ParameterHandler;
}

namespace mesoslip
{
class KeyUse;
class RawParameters;

/** A place whose stress is followed through the snapshots. */
struct ProbeRequest
{
  std::string name; ///< of its subsection
  /** From the lower left corner (m). */
  std::array<double, 2> position = {};
};

/** What stress_localization is asked for. */
struct LocalizationParameters
{
  std::string rve_file;        ///< path of rve.h5
  std::string homogeneous_run; ///< path of its dynamics.h5
  /** Empty: no comparison. */
  std::string direct_run;
  /** Compare with a direct run under other loads all the same. */
  bool allow_different_loads = false;

  /** KUBC or PBC. */
  std::string concentration = "KUBC";
  /** Eq. 24: the macroscopic strain at the place. */
  bool local_strain = true;
  /** Eq. 23: its mean over the body. */
  bool mean_strain = false;
  FieldSelection fields; ///< averages over time to compute
  /** sigma_zz / (sigma_xx + sigma_yy) by phase; empty: from the stiffnesses. */
  std::vector<double> out_of_plane_ratio;

  /** s; NaN: when the runs are steady, as their files tell, and the end. */
  double from = 0.;
  double to   = 0.; ///< end of the window

  /** Probes of the homogeneous run, unless all are wanted. */
  std::vector<std::string> run_probes;
  bool all_run_probes = true;               ///< every probe of the homogeneous run
  std::vector<ProbeRequest> further_probes; ///< places of one's own

  /** m */
  double surface_depth = 0.4e-3;
  /** m */
  double edge_distance = 1.6e-3;

  /** All sections; @p raw names the probes, which have subsections. */
  static void declare(dealii::ParameterHandler &prm, const RawParameters &raw);

  /** @throws UserError for keys that others leave without effect. */
  static void check_keys(const KeyUse &use);

  /** @throws UserError; input files have to exist. A folder stands for the file in it. */
  static LocalizationParameters parse(dealii::ParameterHandler &prm);
};
} // namespace mesoslip

#endif
