#ifndef mesoslip_simulation_transient_summary_h
#define mesoslip_simulation_transient_summary_h

#include "observation/contact_shares.h"
#include "observation/friction_summary.h"
#include "observation/phase_diagram.h"
#include "observation/spectrum.h"
#include "simulation/transient.h"

#include <optional>
#include <vector>

namespace mesoslip
{
class RunContext;

/** What follows from the observations of a run; absent where it has no meaning. */
struct TransientSummary
{
  /** Ratio of tangential to normal force at the top (contact forces if it is free). */
  std::vector<double> apparent_friction;

  /** Eq. (9); none with fewer than three samples in the steady part. */
  std::optional<Estimate> mu_inter;
  std::optional<Estimate> mean_apparent_friction; ///< paper, remark 1
  ContactSummary contact;          ///< shares and durations in the steady part
  unsigned int reference_node = 0; ///< number on the contact line
  std::string regime;              ///< of the reference node, in words
  Spectrum spectrum;               ///< of the reference node's u_x, cut at 1 MHz
  std::optional<SpectralSummary> frequencies; ///< none without a peak
  /** Of the reference node's motion along x. */
  PhaseDiagram phase_diagram;
  double friction_energy = 0.; ///< J/m

  /**
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

/** Fills summary.json and prints the key numbers. */
void write_summary(const ContactParameters &parameters,
                   const Scene &scene,
                   const TimeStepChoice &time,
                   const TransientObservations &observed,
                   const TransientSummary &summary,
                   RunContext &context);
} // namespace mesoslip

#endif
