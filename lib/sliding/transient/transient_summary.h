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

  /** What mu_inter is over. */
  struct Load
  {
    double power = 0.;   ///< W/m
    std::string meaning; ///< in words; empty: no steady part
  };

  /** Values of the series that a run, and for the spectrum its steady part, needs. */
  static constexpr std::size_t least_samples = 16;

  /** Whether there are enough samples for mu_inter and the mean of mu_app. */
  bool has_statistics(const TransientObservations &observed) const;

  std::size_t n_steady = 0; ///< values of the series in the steady part
  Load load;                ///< of mu_inter

  /** Eq. (9); none without statistics or without a load. */
  std::optional<Estimate> mu_inter;
  std::optional<Estimate> mean_apparent_friction; ///< paper, remark 1
  ContactSummary contact;          ///< shares and durations in the steady part
  unsigned int reference_node = 0; ///< number on the contact line
  std::string regime;              ///< of the reference node, in words
  Spectrum spectrum;               ///< of the reference node's u_x, cut at 1 MHz
  /** None without a peak, or when most of the motion is faster than the series. */
  std::optional<SpectralSummary> frequencies;
  double hidden_share = 0.; ///< of the variance of u_x that the series does not show
  double folded_share =
    0.; ///< of the spectrum's power that is near the highest frequency
  /** Of the reference node's motion along x. */
  PhaseDiagram phase_diagram;
  double friction_energy = 0.; ///< J/m

  /**
   * None with fewer than two samples, of which the first is the start.
   * Largest residual of the energy balance as a share of the frictional work or, while
   * that is below a tenth of the largest term of the balance, of that term.
   */
  std::optional<double> energy_residual;
  /** That term in words: "the frictional work". */
  std::string residual_scale;
};

/** Evaluates the steady part of a run; the root's business. */
TransientSummary summarize_transient(const ContactParameters &parameters,
                                     const Scene &scene,
                                     const TransientObservations &observed);

/** What a reader of the numbers has to know; each a sentence without its full stop. */
struct TransientRemarks
{
  std::string duration;            ///< on T_G; empty: it can be relied on
  std::string friction;            ///< on mu_inter; empty: there is nothing to say
  std::vector<std::string> others; ///< on everything else
};

/** Looks for what is missing, or cannot be what it seems. */
TransientRemarks remarks_on(const ContactParameters &parameters,
                            const Scene &scene,
                            const TransientObservations &observed,
                            const TransientSummary &summary);

/** Fills summary.json and prints the key numbers. */
void write_summary(const ContactParameters &parameters,
                   const Scene &scene,
                   const TimeStepChoice &time,
                   const TransientObservations &observed,
                   const TransientSummary &summary,
                   RunContext &context);
} // namespace mesoslip

#endif
