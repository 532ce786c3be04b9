#include "sliding/body_analysis.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "grid/uniform_grid.h"
#include "material/plausibility.h"
#include "program/machine.h"
#include "program/run_context.h"
#include "sliding/run_plan.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

namespace mesoslip
{
namespace
{
/** Whether each rank does the whole analysis. */
bool is_repeated(const ContactParameters &parameters)
{
  return parameters.analysis != ContactAnalysis::transient &&
         parameters.static_solver != StaticSolverKind::ml;
}

BodyDescription make_body_on_root(const ContactParameters &parameters)
{
  BodyDescription body;
  const unsigned int n_copies = is_repeated(parameters) ? ranks_of_this_machine() : 1;
  on_root(MPI_COMM_WORLD, [&]() { body = make_body(parameters, n_copies); });
  broadcast_object(MPI_COMM_WORLD, body);
  return body;
}

void check_probes(const ObservationParameters &observation, const UniformGrid<2> &grid)
{
  for (const ProbePoint &probe : observation.probes)
    for (unsigned int d = 0; d < 2; ++d)
      if (!(probe.position[d] >= 0. &&
            probe.position[d] <= grid.extent(d) * (1. + 1e-12)))
        throw UserError("Observation/" + probe.name + "/Position: (" +
                        to_text(probe.position[0]) + ", " + to_text(probe.position[1]) +
                        ") m lies outside the body, which reaches from (0, 0) to (" +
                        to_text(grid.extent(0)) + ", " + to_text(grid.extent(1)) +
                        ") m; positions are in m");
  const double x = observation.reference_x;
  if (!std::isnan(x) && !(x >= 0. && x <= grid.extent(0)))
    throw UserError("Observation/Reference x: " + to_text(x) +
                    " m lies outside the body, 0 to " + to_text(grid.extent(0)) + " m");
}
} // namespace

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
      throw NumericalFailure(std::string(e.what()) + "; " + advice);
    }
}

void judge_static_strain(const Deformation &found,
                         const ContactParameters &parameters,
                         const BodyScales &scales,
                         const PlaceText &place,
                         RunContext &context)
{
  const std::string inverted = inverted_cell_text(found, place);
  if (!inverted.empty())
    throw NumericalFailure("static contact: " + inverted +
                           "; likely cause: " + likely_cause(parameters, scales));
  const std::string large = large_strain_warning(found, parameters, scales, place, "");
  if (!large.empty())
    context.warn(large);
  context.summary()["largest_strain"] = found.strain.value;
}

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

BodyAnalysis::BodyAnalysis(const ContactParameters &p)
  : parameters(p)
  , body(make_body_on_root(p))
  , material(make_material(body, p.periodic))
{
  check_probes(parameters.observation, body.grid);
  require_frequency(material);
}

std::vector<std::string> BodyAnalysis::body_lines() const
{
  const std::string &file = parameters.body.rve_file;
  std::string coefficients, names;
  for (const Phase<2> &phase : body.phases)
    {
      const std::string comma = names.empty() ? "" : ", ";
      names += comma + phase.name;
      coefficients += comma + phase.name + " " + to_text(phase.friction_coefficient);
    }
  const VoigtMatrix<2> &D        = body.phases[0].stiffness;
  std::vector<std::string> lines = {
    "Body: " + size_text(body.grid),
    "Material: " +
      (parameters.body.heterogeneous
         ? "heterogeneous, the phases " + names
         : brief_text(4, "homogeneous, D11, D12, D22, D33 = ", 1e-9 * D(0, 0), ", ",
                      1e-9 * D(0, 1), ", ", 1e-9 * D(1, 1), ", ", 1e-9 * D(2, 2),
                      " GPa, ", body.phases[0].density, " kg/m^3")) +
      (file.empty() ? ", from Body/Stiffness and Density (no RVE file)" : " of " + file)};
  if (parameters.friction.coefficient_by_phase)
    lines.push_back("Friction coefficients of the phases: " + coefficients);
  return lines;
}

std::vector<std::string> BodyAnalysis::body_warnings() const
{
  const std::string &file = parameters.body.rve_file;
  const std::string size =
    file.empty() || parameters.body.size[0] > 0. ? "Body/Size" : "the size in " + file;
  const FrictionParameters &friction = parameters.friction;
  std::vector<PlausibleRange> ranges = {
    plausible_length(size + " along x", body.grid.extent(0)),
    plausible_length(size + " along y", body.grid.extent(1))};
  if (friction.has_constant_coefficient())
    ranges.push_back(plausible_friction("Friction/Coefficient", friction.coefficient));
  for (const Phase<2> &phase : body.phases)
    {
      const std::string of_phase = " of phase '" + phase.name + "'";
      ranges.push_back(plausible_density(
        file.empty() ? "Body/Density" : "the density" + of_phase, phase.density));
      if (friction.coefficient_by_phase)
        ranges.push_back(plausible_friction("the friction coefficient" + of_phase,
                                            phase.friction_coefficient));
    }
  if (parameters.analysis == ContactAnalysis::static_contact)
    ranges.push_back(plausible_pressure("Top/Pressure",
                                        std::fabs(parameters.top.pressure.amplitude()),
                                        BodyScales(material).stiffness));

  std::vector<std::string> warnings = body.warnings;
  for (const std::string &sentence : implausible(ranges))
    warnings.push_back(sentence);
  for (const std::string &one : stiffness_warnings<2>(body.phases))
    warnings.push_back(one);
  return warnings;
}

void BodyAnalysis::describe(std::ostream &out) const
{
  describe_body(out, 0.);
}

void BodyAnalysis::describe_body(std::ostream &out, const double bytes_of_histories) const
{
  for (const std::string &line : body_lines())
    out << line << '\n';
  out << 2 * body.grid.n_nodes() << " degrees of freedom\n"
      << bytes_text(field_memory(parameters, body.grid) + bytes_of_histories)
      << " of memory\n";
  for (const std::string &warning : body_warnings())
    out << "warning: " << warning << '\n';
}

void BodyAnalysis::log_body(RunContext &context) const
{
  if (context.n_ranks() > 1 && is_repeated(parameters))
    context.log(
      "This analysis runs on one process, all others repeat it; start it without mpirun "
      "or set Performance/Static solver = ml");
  for (const std::string &line : body_lines())
    context.log(line);
  for (const std::string &warning : body_warnings())
    context.warn(warning);
}

void BodyAnalysis::summarize_body(const std::string &analysis, RunContext &context) const
{
  nlohmann::json &json = context.summary();
  json["dim"]          = 2;
  json["cells"]        = body.grid.n_cells();
  json["dofs"]         = 2 * body.grid.n_nodes();
  json["analysis"]     = analysis;
  json["material"]     = parameters.body.heterogeneous ? "heterogeneous" : "homogeneous";
}
} // namespace mesoslip
