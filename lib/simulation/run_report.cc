#include "simulation/run_report.h"

#include "grid/size_text.h"
#include "io/parameters.h"
#include "material/plausibility.h"
#include "simulation/plausible_input.h"
#include "simulation/run_size.h"

#include <sstream>

namespace mesoslip
{
namespace
{
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

bool flat_moves(const ContactParameters &parameters)
{
  constexpr unsigned int looks = 100;
  for (unsigned int k = 0; k <= looks; ++k)
    if (parameters.friction.flat_velocity(parameters.time.end_time * k / looks) != 0.)
      return true;
  return false;
}

bool slides_undamped(const ContactParameters &parameters)
{
  const FrictionParameters &friction = parameters.friction;
  return friction.law.time == 0. && !friction.law.node_law &&
         parameters.time.beta == 0. && parameters.time.beta2 == 0.5 &&
         (friction.coefficient_by_phase || friction.coefficient > 0.) &&
         flat_moves(parameters);
}
} // namespace

std::vector<std::string> body_text(const ContactParameters &parameters,
                                   const Scene &scene)
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

std::string crossing_text(const ContactParameters &parameters,
                          const UniformMaterial &material)
{
  std::ostringstream text;
  text.precision(4);
  text << "a wave takes " << 1e3 * crossing_time(material)
       << " ms from the flat to the top, the run " << 1e3 * parameters.time.end_time
       << " ms";
  return text.str();
}

std::vector<std::string> body_warnings(const ContactParameters &parameters,
                                       const Scene &scene)
{
  std::vector<std::string> warnings = scene.warnings;
  for (const std::string &warning : implausible_body(parameters, scene))
    warnings.push_back(warning);
  const std::string stiffness = stiffness_warning(scene.phases);
  if (!stiffness.empty())
    warnings.push_back(stiffness);
  if (parameters.analysis == ContactAnalysis::static_contact)
    for (const std::string &warning :
         implausible_static_load(parameters, scene.make_material(parameters.periodic)))
      warnings.push_back(warning);
  return warnings;
}

std::vector<std::string> transient_warnings(const ContactParameters &parameters,
                                            const UniformMaterial &material)
{
  std::vector<std::string> warnings = implausible_run(parameters, material);
  if (!(parameters.time.end_time >= 2. * crossing_time(material)))
    warnings.push_back(
      crossing_text(parameters, material) +
      ": it ends before the wave is back; are Body/Size and Time/End time in "
      "m and s, and the stiffness in Pa?");
  const std::string damping =
    damping_warning(parameters, material, "the critical time step");
  if (!damping.empty())
    warnings.push_back(damping);
  if (slides_undamped(parameters))
    warnings.emplace_back(
      "the run has neither regularization (Friction/Law = coulomb or Regularization time "
      "= 0) nor damping (Time/Rayleigh beta = 0): while nodes slide, waves of three to "
      "four cells grow that the body does not have, the faster the finer the grid is, so "
      "that no grid is fine enough; set one of them, the paper has 1.5e-6 and 4.4e-9 s");
  return warnings;
}
} // namespace mesoslip
