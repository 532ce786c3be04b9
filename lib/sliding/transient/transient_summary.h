#ifndef mesoslip_sliding_transient_transient_summary_h
#define mesoslip_sliding_transient_transient_summary_h

#include "observation/contact_shares.h"
#include "observation/friction_summary.h"
#include "observation/phase_diagram.h"
#include "observation/spectrum.h"
#include "sliding/transient/transient.h"

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
class RunContext;

/** What follows from the observations of a run; absent where it has no meaning. */
struct TransientSummary
{
  /** Ratio of tangential to normal force at the top (contact forces if it is free). */
  std::vector<double> apparent_friction;

  /** Values of the series that a run, and for the spectrum its steady part, needs. */
  static constexpr std::size_t least_samples = 16;

  /** Whether there are enough samples for mu_inter and the mean of mu_app. */
  bool has_statistics = false;

  std::string load_meaning; ///< what mu_inter is over; empty: no steady part
  double load_power = 0.;   ///< of what mu_inter is over (W/m)

  /** Eq. (9); none without statistics or without a load. */
  std::optional<Estimate> mu_inter;
  std::optional<Estimate> mean_apparent_friction; ///< paper, remark 1
  ContactSummary contact;       ///< shares and durations in the steady part
  ContactShares reference_node; ///< in the steady part
  std::string regime;           ///< of the reference node, in words; empty without steps
  Spectrum spectrum;            ///< of the reference node's u_x, cut at 1 MHz
  /** None without a peak, or when most of the motion is faster than the series. */
  std::optional<SpectralSummary> frequencies;
  double hidden_share = 0.;    ///< of the variance of u_x that the series does not show
  double folded_share = 0.;    ///< of the spectrum's power near the highest frequency
  PhaseDiagram phase_diagram;  ///< of the reference node's motion along x
  double friction_energy = 0.; ///< dissipated by friction in the whole run (J/m)

  /**
   * Largest residual of the energy balance as a share of the frictional work or, while
   * that is below a tenth of the largest term of the balance, of that term. None with
   * fewer than two samples, of which the first is the start.
   */
  std::optional<double> energy_residual;
  std::string residual_scale; ///< that term in words: "the frictional work"

  std::string duration_warning;      ///< on T_G; empty: it can be relied on
  std::string friction_warning;      ///< on mu_inter; empty: there is nothing to say
  std::vector<std::string> warnings; ///< on everything else

  /** Of the main frequency (s); 0 without one. */
  double period() const
  {
    return frequencies ? 1. / frequencies->main_frequency : 0.;
  }
};

/** Evaluates the steady part of a run, on rank 0. */
TransientSummary summarize_transient(const ContactParameters &parameters,
                                     const BodyDescription &body,
                                     const TransientObservations &observed);

/** Adds the warnings: what is missing, or cannot be what it seems. */
void add_remarks(const ContactParameters &parameters,
                 const BodyDescription &body,
                 const TransientObservations &observed,
                 TransientSummary &summary);

/** Fills summary.json and prints the key numbers. */
void write_summary(const ContactParameters &parameters,
                   const BodyDescription &body,
                   const TimeStepChoice &time,
                   const TransientObservations &observed,
                   const TransientSummary &summary,
                   RunContext &context);
} // namespace mesoslip

#endif
