#ifndef mesoslip_sliding_transient_transient_result_h
#define mesoslip_sliding_transient_transient_result_h

#include "contact/contact_recorder.h"
#include "dynamics/energy_audit.h"
#include "dynamics/supports/top_surface.h"
#include "exchange/run_description.h"
#include "observation/contact_statistics.h"
#include "observation/probe_recorder.h"
#include "observation/spectrum.h"
#include "observation/steady_record.h"
#include "sliding/body_size.h"
#include "sliding/run_plan.h"

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
class RunContext;

/** Observations of a run, complete on rank 0, and the results derived from them. */
struct TransientResult
{
  const ContactParameters &parameters; ///< parameters of the run
  const BodySize &body;                ///< the sliding body
  const TimeStepChoice &time;          ///< time step of the run

  /**
   * @name Observed
   * @{
   */
  ContactHistory history                 = {}; ///< contact histories
  TopHistory top                         = {}; ///< top histories
  SteadySeries series                    = {}; ///< series for the statistics
  std::vector<NodeCounts> blocks         = {}; ///< contact states by node
  EnergyHistory energy                   = {}; ///< terms of the balance
  std::vector<ProbeHistory> probes       = {}; ///< in the order of the .prm
  std::vector<ProbeHistory> probes_below = {}; ///< likewise of a counter body
  std::uint64_t steps_done               = 0;  ///< since the start of the run
  double friction_energy                 = 0.; ///< dissipated in all steps (J, in 2D J/m)
  double loop_seconds                    = 0.; ///< wall-clock time of the time loop
  bool interrupted                       = false; ///< stopped on request
  std::string kernel                     = {};    ///< variant and instruction set
  std::string limit_cycle                = {};    ///< criterion and result, as text
  bool limit_cycle_reached               = false; ///< whether the criterion is met
  double steady_from                     = 0.;    ///< s
  LargestStrain strains                  = {};    ///< largest strains of the body
  LargestStrain of_counter               = {};    ///< largest strains of a counter body
  double largest_weakening               = 0.;    ///< see VariableFriction
  PairSettling settling                  = {};    ///< with a counter body, on rank 0
  /** @} */

  /** Largest norm of the strain of a cell of either body [-]. */
  double largest_strain() const
  {
    return std::max(strains.strain, of_counter.strain);
  }

  /** Share of the largest strain that single precision rounds off, in the worse body; 0 in
   * double precision [-]. */
  double rounded_share() const
  {
    const auto share = [](const LargestStrain &of) {
      return of.rounding > 0. ? of.rounding / of.strain : 0.;
    };
    return std::max(share(strains), share(of_counter));
  }

  /**
   * @name Evaluated from the steady part, absent where it has no meaning
   * @{
   */

  /** Least number of samples of the series for statistics; for the spectrum in its steady
   * part. */
  static constexpr std::size_t least_samples = 16;

  /** Ratio of tangential to normal force at the top (contact forces if it is free). */
  std::vector<double> apparent_friction = {};

  /** Whether there are enough samples for mu_inter and the mean of mu_app. */
  bool has_statistics = false;

  std::string load_meaning = {}; ///< denominator of mu_inter; empty: no steady part
  double load_power        = 0.; ///< denominator of mu_inter (W/m)

  /** Eq. (9); none without statistics or without a load. */
  std::optional<Estimate> mu_inter               = {};
  std::optional<Estimate> mean_apparent_friction = {}; ///< paper, remark 1
  ContactSummary contact                         = {}; ///< shares and durations
  ContactShares reference_shares                 = {}; ///< by state, reference node

  /** Regime of the reference node, as text; empty without steps. */
  std::string regime = {};
  /** Spectrum of the reference node's u_x, cut at 1 MHz or twice the highest
   * frequency. */
  Spectrum spectrum = {};
  /** None without a peak, or if most of the motion is too fast for the series. */
  std::optional<SpectralSummary> frequencies = {};
  /** Half the range of v_x of the reference node in the steady part (m/s); none with too
   * few samples. */
  std::optional<double> velocity_amplitude = {};
  double hidden_share = 0.; ///< unresolved share of the variance of u_x
  double folded_share = 0.; ///< share of the spectrum's power near the highest frequency
  PhaseDiagram phase_diagram = {}; ///< motion of the reference node along x

  /**
   * Largest residual of the energy balance relative to the frictional work or, while
   * this work is below a tenth of the largest term of the balance, relative to the
   * largest term. Empty with fewer than two samples, of which the first is the start.
   */
  std::optional<double> energy_residual = {};
  std::string residual_scale            = {}; ///< reference, as "the frictional work"

  std::string duration_warning      = {}; ///< on T_G; empty: T_G is reliable
  std::string friction_warning      = {}; ///< on mu_inter; empty: no remark
  std::vector<std::string> warnings = {}; ///< all other warnings
  /** @} */

  /** Evaluates the observations, with warnings on missing data. On rank 0. */
  void evaluate();

  /** Fills summary.json and prints the key numbers. */
  void write_summary(RunContext &context) const;

private:
  void evaluate_reference_node();
  void evaluate_friction();
  void evaluate_energy();
  void add_remarks();
};
} // namespace mesoslip

#endif
