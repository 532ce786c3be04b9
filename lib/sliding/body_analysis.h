#ifndef mesoslip_sliding_body_analysis_h
#define mesoslip_sliding_body_analysis_h

#include "program/program.h"
#include "sliding/contact_parameters.h"
#include "sliding/given_body.h"
#include "sliding/run_plan.h"

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
/**
 * Progress callback for the solves of static analyses, which save no state when they are
 * stopped.
 * @throws Interrupted
 */
std::function<void(unsigned int)> stop_or_report(RunContext &context,
                                                 const std::string &activity);

/** Runs @p action. @throws NumericalFailure instead of NotConverged, with @p advice. */
void with_advice(const std::string &advice, const std::function<void()> &action);

/** Advice if no equilibrium with the coefficients @p friction is found; @p slides:
 * whether the flat slides. */
std::string equilibrium_advice(const std::vector<double> &friction, const bool slides);

/** Puts the largest strain of a static contact into the summary; warns of large strains.
 * @throws NumericalFailure if a cell is inverted */
template <int dim>
void judge_static_strain(const GivenBody<dim> &body,
                         const NodalField<double> &displacement,
                         RunContext &context);

/** An analysis of any body on the flat. */
template <int dim>
class BodyAnalysis : public Analysis
{
public:
  void describe(std::ostream &out) const override
  {
    body->describe(out);
  }

protected:
  /** Takes over the body @p given. */
  explicit BodyAnalysis(std::unique_ptr<GivenBody<dim>> given)
    : body(std::move(given))
    , parameters(body->parameters)
    , facts(body->facts())
  {
  }

  const std::unique_ptr<GivenBody<dim>> body; ///< the same on all ranks
  const ContactParameters &parameters;        ///< parameters of the body
  const BodyFacts<dim> &facts;                ///< facts of the body
};
} // namespace mesoslip

#endif
