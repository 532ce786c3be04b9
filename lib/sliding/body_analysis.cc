#include "sliding/body_analysis.h"

#include "base/errors.h"
#include "program/run_context.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace mesoslip
{
std::function<void(unsigned int)> stop_or_report(RunContext &context,
                                                 const std::string &activity)
{
  return [&context, activity](const unsigned int n) {
    if (context.stop_requested())
      throw Interrupted("stopped on request in " + activity + " " +
                        std::to_string(n + 1) + "; there is no result yet");
  };
}

void with_advice(const std::string &advice, const std::function<void()> &action)
{
  try
    {
      action();
    }
  catch (const NotConverged &e)
    {
      throw NumericalFailure(std::string(e.what()) + "; " +
                             (e.reason == NotConverged::Reason::iterations
                                ? advice
                                : "the cause is round-off, as of a body that is slender "
                                  "or of cells that are, of phases "
                                  "that differ very much, of one that is nearly "
                                  "incompressible, or of loads beyond "
                                  "the range of numbers"));
    }
}

template <int dim>
void judge_static_strain(const GivenBody<dim> &body,
                         const NodalField<double> &displacement,
                         RunContext &context)
{
  const BodyFacts<dim> &facts = body.facts();
  const Deformation found     = body.deformation(displacement);
  const std::string inverted  = inverted_cell_text(found, facts.place);
  if (!inverted.empty())
    throw NumericalFailure("static contact: " + inverted + "; likely cause: " +
                           likely_cause(body.parameters, facts.scales));
  const std::string large =
    large_strain_warning(found, body.parameters, facts.scales, facts.place, "");
  if (!large.empty())
    context.warn(large);
  context.summary()["largest_strain"] = found.strain.value;
}

template void
judge_static_strain(const GivenBody<2> &, const NodalField<double> &, RunContext &);
template void
judge_static_strain(const GivenBody<3> &, const NodalField<double> &, RunContext &);

std::string equilibrium_advice(const std::vector<double> &friction, const bool slides)
{
  const std::string generic = "loosen Static contact/Tolerance or allow more Iterations";
  const double mu           = *std::max_element(friction.begin(), friction.end());
  if (!slides || mu <= 0.5)
    return generic;
  return "a sliding body need not have an equilibrium: with a friction coefficient of " +
         to_text(mu) +
         " it may wedge, lift off or tip; reduce Friction/Coefficient or, where the "
         "friction forces hardly change any more, " +
         generic;
}
} // namespace mesoslip
