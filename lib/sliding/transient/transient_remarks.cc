#include "sliding/transient/transient_summary.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
/** Share of a spectrum's power near its highest frequency that makes it doubtful. */
constexpr double doubtful_share = 0.01;

/** Means of steady sliding are above the coefficient by rounding and the last drift. */
constexpr double tolerated_excess = 1e-3;

std::string duration_remark(const ContactDuration &duration)
{
  if (!duration.complete() || duration.representative())
    return "";
  std::ostringstream text;
  text.precision(3);
  text << "T_G = " << duration.mean << " s rests on the " << 100. * duration.node_share
       << " % of the contact nodes that landed in the steady part; the others never left "
          "the flat "
          "and only add time, so T_G grows with the run and eq. (13) should not be used "
          "with it";
  return text.str();
}

/** A short run, or one that ended before Steady from, at a limit cycle or on request. */
std::string steady_part_remark(const TransientObservations &observed)
{
  const std::vector<double> &time = observed.series.time;
  std::ostringstream text;
  if (time.size() < TransientSummary::least_samples)
    text << "the run has " << time.size() << " samples for statistics, fewer than the "
         << TransientSummary::least_samples
         << " that they take: mu_inter and the spectrum are left out; set a later "
            "Time/End time";
  else
    text << "fewer than three samples lie between the start of the steady part, "
         << observed.steady_from << " s, and the end, " << time.back()
         << " s: mu_inter and the spectrum are left out; set Observation/Steady from "
            "earlier";
  return text.str();
}

std::string friction_remark(const BodyDescription &body, const TransientSummary &summary)
{
  std::ostringstream text;
  text.precision(4);
  if (!summary.mu_inter)
    {
      if (!summary.load_meaning.empty())
        text << "mu_inter is left out: the mean of F_N |V| in the steady part is "
             << summary.load_power
             << " W/m, so that there is no load along the way of the flat to relate the "
                "frictional power to";
      return text.str();
    }
  const double largest =
    *std::max_element(body.node_friction.begin(), body.node_friction.end());
  if (!(std::fabs(summary.mu_inter->value) <= (1. + tolerated_excess) * largest))
    text
      << "mu_inter = " << summary.mu_inter->value
      << " is above the largest friction coefficient, " << largest
      << ": the contact moves faster than the flat, whose velocity alone mu_inter takes "
         "into account; it is not a friction coefficient of this motion";
  return text.str();
}

/** Frequencies that the samples of the statistics cannot tell. */
std::string spectrum_remark(const TransientObservations &observed,
                            const TransientSummary &summary)
{
  std::ostringstream text;
  text.precision(3);
  const double limit = 5e-4 / observed.series.interval; // kHz
  if (summary.hidden_share > 0.5)
    text << 100. * summary.hidden_share
         << " % of the motion of the reference node is faster than the " << limit
         << " kHz that the samples kept of so long a run can carry: there is no "
            "main frequency; reduce Time/End time";
  else if (summary.folded_share > doubtful_share)
    text << 100. * summary.folded_share
         << " % of the power of the reference node's motion lies between " << 0.9 * limit
         << " and " << limit
         << " kHz, the highest frequency that its samples can carry: faster motion shows "
            "up at lower frequencies, and the main frequency may be wrong; is the motion "
            "that of the grid, for want of Time/Rayleigh beta?";
  return text.str();
}

/** Histories that show slower vibrations than there are. */
std::string history_remark(const ContactParameters &parameters,
                           const TransientObservations &observed,
                           const TransientSummary &summary)
{
  const ObservationParameters &o = parameters.observation;
  const unsigned int interval =
    std::max(parameters.history_interval, o.probes.empty() ? 0 : o.probe_interval);
  if (!summary.frequencies)
    return "";
  const double highest = summary.frequencies->highest_frequency;
  const double steps   = 0.5 / (highest * observed.dt); // half a period
  if (interval <= steps)
    return "";
  std::ostringstream text;
  text.precision(4);
  text << "the reference node vibrates at up to " << 1e-3 * highest
       << " kHz (main frequency " << 1e-3 * summary.frequencies->main_frequency
       << " kHz), but the histories and probes in dynamics.h5 have samples every "
       << interval << " steps, which carry up to " << 5e-4 / (interval * observed.dt)
       << " kHz: spectra computed from them would show frequencies that are not there; "
          "set Observation/History interval and Probe interval to at most "
       << std::max(1., std::floor(0.5 * steps));
  return text.str();
}

std::string separation_remark(const ContactParameters &parameters,
                              const TransientSummary &summary)
{
  if (summary.contact.node_shares.empty() || summary.contact.shares.separation < 1.)
    return "";
  const double pressure = parameters.top.pressure.amplitude();
  std::ostringstream text;
  text << "no node touched the flat in the steady part";
  if (parameters.top.kind != TopSetup::Kind::held && !(pressure > 0.))
    text << ": Top/Pressure is " << pressure << " Pa, which "
         << (pressure < 0. ? "pulls the body off the flat; a positive one presses"
                           : "presses nothing");
  return text.str();
}
} // namespace

void add_remarks(const ContactParameters &parameters,
                 const BodyDescription &body,
                 const TransientObservations &observed,
                 TransientSummary &summary)
{
  summary.duration_warning = duration_remark(summary.contact.duration);
  summary.friction_warning = summary.has_statistics ? friction_remark(body, summary)
                                                    : steady_part_remark(observed);
  for (const std::string &text :
       {spectrum_remark(observed, summary), history_remark(parameters, observed, summary),
        separation_remark(parameters, summary)})
    if (!text.empty())
      summary.warnings.push_back(text);
}
} // namespace mesoslip
