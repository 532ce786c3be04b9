#include "sliding/body_analysis.h"

#include "base/collective.h"
#include "base/errors.h"
#include "base/exchange.h"
#include "grid/size_text.h"
#include "material/plausibility.h"
#include "parameters/parameters.h"
#include "program/run_context.h"
#include "sliding/plausible_input.h"
#include "sliding/transient/run_plan.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

namespace mesoslip
{
namespace
{
Scene make_scene_on_root(const ContactParameters &parameters)
{
  Scene scene;
  on_root(MPI_COMM_WORLD, [&]() { scene = make_scene(parameters); });
  broadcast_object(MPI_COMM_WORLD, scene);
  return scene;
}

std::string material_text(const ContactParameters &parameters, const Scene &scene)
{
  const BodyParameters &body = parameters.body;
  std::ostringstream text;
  text.precision(4);
  if (body.heterogeneous)
    {
      std::vector<std::string> names;
      for (const Phase<2> &phase : scene.phases)
        names.push_back(phase.name);
      text << "heterogeneous, the phases " << to_text(names);
    }
  else
    {
      const VoigtMatrix<2> &D = scene.phases[0].stiffness;
      text << "homogeneous, D11, D12, D22, D33 = " << 1e-9 * D(0, 0) << ", "
           << 1e-9 * D(0, 1) << ", " << 1e-9 * D(1, 1) << ", " << 1e-9 * D(2, 2)
           << " GPa, " << scene.phases[0].density << " kg/m^3";
    }
  text << (body.rve_file.empty()
             ? std::string(", from Body/Stiffness and Density (no RVE file)")
             : " of " + body.rve_file);
  return text.str();
}

void check_probes(const ContactParameters &parameters, const UniformGrid<2> &grid)
{
  for (const ProbeParameters &probe : parameters.observation.probes)
    for (unsigned int d = 0; d < 2; ++d)
      if (!(probe.position[d] >= 0. &&
            probe.position[d] <= grid.extent(d) * (1. + 1e-12)))
        throw UserError("Observation/" + probe.name + "/Position: (" +
                        to_text(probe.position[0]) + ", " + to_text(probe.position[1]) +
                        ") m lies outside the body, which reaches from (0, 0) to (" +
                        to_text(grid.extent(0)) + ", " + to_text(grid.extent(1)) + ") m");
  const double x = parameters.observation.reference_x;
  if (!std::isnan(x) && !(x >= 0. && x <= grid.extent(0)))
    throw UserError("Observation/Reference x: " + to_text(x) +
                    " m lies outside the body, 0 to " + to_text(grid.extent(0)) + " m");
}

} // namespace

BodyAnalysis::BodyAnalysis(const ContactParameters &p)
  : parameters(p)
  , scene(make_scene_on_root(p))
  , material(scene.make_material(p.periodic))
{
  check_probes(parameters, scene.grid);
  require_frequency(material);
}

std::vector<std::string> BodyAnalysis::body_lines() const
{
  std::vector<std::string> lines = {"Body: " + size_text(scene.grid),
                                    "Material: " + material_text(parameters, scene)};
  if (!parameters.friction.coefficient_by_phase)
    return lines;
  std::string coefficients;
  for (const Phase<2> &phase : scene.phases)
    coefficients += (coefficients.empty() ? "" : ", ") + phase.name + " " +
                    to_text(phase.friction_coefficient);
  lines.push_back("Friction coefficients of the phases: " + coefficients);
  return lines;
}

std::vector<std::string> BodyAnalysis::body_warnings() const
{
  const bool typed = parameters.body.rve_file.empty();
  const std::string size =
    typed ? "Body/Size" : "the size in " + parameters.body.rve_file;
  std::vector<PlausibleRange> ranges = {
    plausible_length(size + " along x", scene.grid.extent(0)),
    plausible_length(size + " along y", scene.grid.extent(1))};
  for (const Phase<2> &phase : scene.phases)
    ranges.push_back(plausible_density(
      typed ? "Body/Density" : "the density of phase '" + phase.name + "'",
      phase.density));
  if (!parameters.friction.coefficient_by_phase)
    ranges.push_back(
      plausible_friction("Friction/Coefficient", parameters.friction.coefficient));
  else
    for (const Phase<2> &phase : scene.phases)
      ranges.push_back(
        plausible_friction("the friction coefficient of phase '" + phase.name + "'",
                           phase.friction_coefficient));
  std::vector<std::string> warnings = scene.warnings;
  for (const std::string &warning : implausible(ranges))
    warnings.push_back(warning);
  const std::string stiffness = stiffness_warning(scene.phases);
  if (!stiffness.empty())
    warnings.push_back(stiffness);
  if (parameters.analysis == ContactAnalysis::static_contact)
    for (const std::string &warning : implausible_static_load(parameters, material))
      warnings.push_back(warning);
  return warnings;
}

void BodyAnalysis::describe(std::ostream &out) const
{
  for (const std::string &line : body_lines())
    out << line << '\n';
  out << 2 * scene.grid.n_nodes() << " degrees of freedom\n";
  for (const std::string &warning : body_warnings())
    out << "Warning: " << warning << '\n';
}

void BodyAnalysis::log_body(RunContext &context) const
{
  for (const std::string &line : body_lines())
    context.log(line);
  for (const std::string &warning : body_warnings())
    context.warn(warning);
}

void BodyAnalysis::summarize_body(const std::string &analysis, RunContext &context) const
{
  nlohmann::json &json = context.summary();
  json["dim"]          = 2;
  json["cells"]        = scene.grid.n_cells();
  json["dofs"]         = 2 * scene.grid.n_nodes();
  json["analysis"]     = analysis;
  json["material"]     = parameters.body.heterogeneous ? "heterogeneous" : "homogeneous";
}

void BodyAnalysis::log_serial_body(RunContext &context) const
{
  if (context.n_ranks() > 1 && parameters.static_solver != StaticSolverKind::ml)
    context.log(
      "This analysis runs on one process, all others repeat it; start it without mpirun "
      "or set Performance/Static solver = ml");
  log_body(context);
}
} // namespace mesoslip
