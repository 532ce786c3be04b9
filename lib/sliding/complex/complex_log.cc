#include "material/plausibility.h"
#include "sliding/complex/complex_output.h"
#include "sliding/run_plan.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Number of modes found, and their kind. */
std::string
range_text(const std::size_t n, const ComplexModesParameters &keys, const double highest)
{
  const std::string modes = n == 1 ? "mode" : "modes";
  return std::to_string(n) + " " +
         (keys.least_growth == 0.
            ? "growing " + modes
            : brief_text(4, modes, n == 1 ? " that decays" : " that decay",
                         " by at most ", -keys.least_growth, " 1/s")) +
         (keys.lowest_frequency > 0.
            ? brief_text(6, " from ", 1e-3 * keys.lowest_frequency, " to ",
                         1e-3 * highest, " kHz")
            : brief_text(6, " up to ", 1e-3 * highest, " kHz"));
}

void warn_of_missing(const ComplexCase &of_case,
                     const std::string &place,
                     RunContext &context)
{
  if (of_case.n_missing < 0)
    context.warn("The argument principle failed, as its phase turns too fast" + place +
                 ": whether modes are missing is not known, and missing_modes is null; "
                 "change Complex modes/Highest frequency a little");
  if (of_case.n_missing > 0)
    context.warn(
      "The argument principle counts " + std::to_string(of_case.n_missing) +
      " eigenvalues more than the search found" + place +
      ": the list of modes is not complete; tighten Complex modes/Tolerance or "
      "reduce Highest frequency");
}

/** The coefficient of the law in steady sliding, and its derivatives, as text. */
std::string law_text(const SlidingState &state)
{
  const SlidingNodesAtRest &contact = state.contact;
  const auto mu = std::minmax_element(contact.friction.begin(), contact.friction.end());
  const auto least =
    *std::min_element(contact.slopes.begin(), contact.slopes.end(),
                      [](const FrictionSlopes &a, const FrictionSlopes &b) {
                        return a.rate + a.state < b.rate + b.state;
                      });
  return brief_text(4, "In steady sliding mu = ", *mu.first,
                    *mu.first == *mu.second ? std::string()
                                            : brief_text(4, " to ", *mu.second),
                    ", d mu/dV = ", least.rate, " s/m at once") +
         (state.state_time > 0.
            ? brief_text(4, " and ", least.state, " s/m by the state, within ",
                         1e9 * state.state_time, " ns")
            : std::string()) +
         (*mu.first == *mu.second ? "" : " where the sum is least");
}

/** Contributions of the contact phases to a mode, as text. */
std::string parts_text(const ModeNumbers &mode, const ContactParts &parts)
{
  std::string text;
  for (std::size_t p = 0; p < mode.parts.size(); ++p)
    text += brief_text(4, text.empty() ? "; " : ", ", parts.names[p], " ",
                       mode.parts[p].growth_by_friction, " 1/s and ",
                       100. * mode.parts[p].motion, " % of the motion");
  return text;
}

/** Sliding phases and their shares, as text. */
std::string contact_text(const ContactParts &parts, const SlidingState &state)
{
  const std::vector<double> shares = parts.of_contact(state);
  std::string text                 = "Contact that slides: ";
  for (std::size_t p = 0; p < shares.size(); ++p)
    text += brief_text(4, p > 0 ? ", " : "", parts.names[p], " ", 100. * shares[p], " %");
  return text + "; behind each mode what friction of a phase adds to its growth, and the "
                "phase's share of the mean square motion along the flat";
}
} // namespace

template <int dim>
void log_complex_modes(const ComplexCases<dim> &cases,
                       const ContactParameters &parameters,
                       RunContext &context)
{
  const ComplexCase &base   = cases.base;
  const ComplexModes &found = cases.modes;
  const bool counted        = parameters.complex_modes.count;
  context.log(
    std::to_string(base.n_sliding) + " contact nodes slide" +
    (base.n_separated > 0 ? ", " + std::to_string(base.n_separated) +
                              " are separated in the static state and free"
                          : "") +
    brief_text(4, "; delta = ", 1e9 * base.delta, " ns, ") +
    damping_text(parameters.step) +
    (parameters.step.alpha > 0. ? "" : " (Time/Rayleigh beta)") +
    (parameters.contact.is_compliant()
       ? brief_text(4, "; on springs of ", parameters.contact.normal_spring.stiffness,
                    " Pa/m")
       : "") +
    (parameters.contact.is_compliant() && !parameters.contact.normal_spring.is_linear()
       ? brief_text(4, " at ", parameters.contact.normal_spring.at,
                    " Pa, with the power ", parameters.contact.normal_spring.exponent,
                    " of their depth")
       : "") +
    (parameters.contact.slips_on_springs()
       ? brief_text(4, "; on tangential springs of ",
                    parameters.contact.tangential_stiffness, " Pa/m")
       : ""));
  if (!cases.state.contact.slopes.empty())
    context.log(law_text(cases.state));
  if (parameters.friction.law_name == "slip rate")
    context.log("The slip-rate law is linearized: delta = L / (|V| + V_ref) of steady "
                "sliding, whose changes act on a friction force that is at its target");
  if (cases.parts.differ())
    context.log(contact_text(cases.parts, cases.state));
  context.log(
    range_text(base.modes.size(), parameters.complex_modes, cases.highest_frequency) +
    ", from " + std::to_string(found.n_shifts) +
    (found.n_shifts == 1 ? " shift" : " shifts") +
    (counted && base.n_missing == 0
       ? brief_text(4,
                    "; the argument principle counts none else with growth "
                    "rates up to ",
                    base.fastest_counted, " 1/s") +
           (base.all_counted
              ? ""
              : "; what grows faster, as such friction lets it, is not counted, "
                "and missing_modes is null")
     : counted ? std::string()
               : "; not counted (Count modes = false)"));
  if (const double highest = found.highest / (2. * M_PI);
      highest < cases.highest_frequency)
    context.log(
      brief_text(4, "No mode of these cells is above ", 1e-3 * highest, " kHz"));
  // For a body without support along the flat the frequency is round-off.
  if (base.nothing_grows_above < 1e3 * found.highest)
    context.log(brief_text(5, "No mode above ", 1e-3 * base.nothing_grows_above,
                           " kHz can grow on these cells"));
  else
    context.log("Above the highest frequency modes may grow as well");
  for (std::size_t k = 0; k < std::min<std::size_t>(base.modes.size(), 30); ++k)
    context.log(brief_text(6, "  mode ", k + 1, "  ", 1e-3 * base.modes[k].frequency,
                           " kHz  growth ", base.modes[k].growth_rate, " 1/s",
                           parts_text(base.modes[k], cases.parts)));
  warn_of_missing(base, "", context);
  for (const ComplexCase &of_case : cases.sweep)
    {
      warn_of_missing(of_case, brief_text(6, " at ", of_case.value), context);
      context.log(brief_text(6, "  ", swept_column(parameters), " = ", of_case.value,
                             ": ", of_case.modes.size(), " modes",
                             of_case.modes.empty()
                               ? std::string()
                               : brief_text(6, ", fastest ", of_case.modes[0].growth_rate,
                                            " 1/s at ", 1e-3 * of_case.modes[0].frequency,
                                            " kHz")));
    }
}

template void
log_complex_modes(const ComplexCases<2> &, const ContactParameters &, RunContext &);
template void
log_complex_modes(const ComplexCases<3> &, const ContactParameters &, RunContext &);
} // namespace mesoslip
