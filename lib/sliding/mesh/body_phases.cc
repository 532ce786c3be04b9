#include "base/errors.h"
#include "base/files.h"
#include "base/object_exchange.h"
#include "exchange/rve_file.h"
#include "sliding/body_grid.h"
#include "sliding/contact_parameters.h"

#include <utility>

namespace mesoslip
{
namespace
{
/** Name of a phase, the upper triangle of its stiffness, density and friction coefficient. */
using PhaseNumbers = std::pair<std::string, std::vector<double>>;

template <int dim>
PhaseNumbers numbers_of(const Phase<dim> &phase)
{
  PhaseNumbers numbers = {phase.name, {}};
  for (int i = 0; i < n_voigt<dim>; ++i)
    for (int j = i; j < n_voigt<dim>; ++j)
      numbers.second.push_back(0.5 * (phase.stiffness(i, j) + phase.stiffness(j, i)));
  numbers.second.insert(numbers.second.end(),
                        {phase.density, phase.friction_coefficient});
  return numbers;
}

/** The phase in the form of section Phases. */
PhaseParameters phase_parameters(const PhaseNumbers &numbers)
{
  PhaseParameters phase;
  phase.name                 = numbers.first;
  phase.type                 = PhaseParameters::Type::stiffness;
  phase.coefficients         = {numbers.second.begin(), numbers.second.end() - 2};
  phase.density              = *(numbers.second.end() - 2);
  phase.friction_coefficient = numbers.second.back();
  return phase;
}

/** Phases of the RVE file: all phases of a heterogeneous body (a mesh has no
 * orientations), else the effective one. */
template <int dim>
std::vector<PhaseNumbers>
phases_of_file(const BodyParameters &body, const bool on_mesh, const RveFile<dim> &rve)
{
  require_densities(rve);
  if (on_mesh && body.heterogeneous && !rve.materials.oriented.empty())
    throw UserError(
      body.section + "/RVE file = " + body.rve_file +
      " has phases in orientations by cell, which a mesh does not have; set "
      "Material = homogeneous, or remove the mesh");
  if (!body.heterogeneous)
    return {numbers_of<dim>(
      {"effective", rve.stiffness(body.stiffness_name), rve.mean_density(), 0.})};
  std::vector<PhaseNumbers> phases;
  for (const Phase<dim> &phase : rve.phases)
    phases.push_back(numbers_of<dim>(phase));
  return phases;
}
} // namespace

template <int dim>
ContactParameters with_phases(ContactParameters parameters)
{
  const BodyParameters &body = parameters.body;
  if (parameters.mesh.is_given() && body.rve_file.empty() && !parameters.is_counter)
    return parameters;
  if (parameters.friction.coefficient_by_phase && !body.heterogeneous)
    throw UserError(
      "Friction/Coefficient from is 'phases', but the body is homogeneous; use "
      "'constant' (analysis 'friction homogenization' gives the coefficient)");
  std::vector<PhaseNumbers> found;
  on_root(MPI_COMM_WORLD, [&]() {
    if (body.rve_file.empty())
      {
        found = {numbers_of<dim>(given_phase<dim>(body))};
        return;
      }
    require_readable_file(body.section + "/RVE file: ", body.rve_file,
                          "run rve_homogenization first");
    const RveFile<dim> rve(body.rve_file);
    found                       = phases_of_file(body, parameters.mesh.is_given(), rve);
    parameters.mesh.rve_digest  = rve.digest;
    parameters.mesh.rve_content = rve.content();
    parameters.mesh.rve_note    = rve.change_note();
  });
  broadcast_object(MPI_COMM_WORLD, found);
  broadcast(MPI_COMM_WORLD, parameters.mesh.rve_digest);
  broadcast(MPI_COMM_WORLD, parameters.mesh.rve_content);
  parameters.mesh.phases.clear();
  for (const PhaseNumbers &numbers : found)
    parameters.mesh.phases.push_back(phase_parameters(numbers));
  return parameters;
}

template ContactParameters with_phases<2>(ContactParameters);
template ContactParameters with_phases<3>(ContactParameters);
} // namespace mesoslip
