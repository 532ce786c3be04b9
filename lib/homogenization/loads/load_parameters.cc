#include "homogenization/loads/load_parameters.h"

#include "base/errors.h"
#include "homogenization/loads/load_members.h"
#include "material/voigt.h"
#include "parameters/keys.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/** Name of a component in 2D or 3D, depending on the number @p n of components. */
const char *component_name(const std::size_t component, const std::size_t n)
{
  const bool in_plane =
    n_voigt<2> == n; // operands in this order, as cppcheck misreads the opposite order
  return in_plane ? voigt_names<2>[component] : voigt_names<3>[component];
}

// Binds all six components in 2D, too: zz, yz or xz get an error message of their own.
PrescribedLoad bind_load(Keys &keys, const std::string &name, const unsigned int dim)
{
  const auto section = keys.section(name);
  PrescribedLoad load;
  load.name = name;
  keys.bind(
    "Temperature change", load.heating, Range::any(),
    "Change of temperature of the whole volume, of phases with a Thermal expansion "
    "that are free of stress without it [K]");
  for (const std::string component : voigt_names<3>)
    {
      const bool shear = component[0] != component[1];
      double strain = not_given, stress = not_given;
      keys.bind_or_auto("Strain " + component, strain, Range::any(),
                        "Macroscopic strain " + component +
                          (shear ? ", as engineering shear" : "") +
                          "; auto: the stress is given instead [-]");
      keys.bind_or_auto("Stress " + component, stress, Range::any(),
                        "Macroscopic stress " + component +
                          "; auto: 0, unless the strain is given [Pa]");
      const bool in_plane = component.find('z') == std::string::npos;
      if (dim == 2 && !in_plane)
        {
          const std::string why = " is given where Dimension is 2, which is plane "
                                  "strain: strains with z are 0, "
                                  "and stresses with z follow; remove it";
          keys.require(std::isnan(strain), "Strain " + component, "a strain" + why);
          keys.require(std::isnan(stress), "Stress " + component, "a stress" + why);
          continue;
        }
      keys.require(std::isnan(strain) || std::isnan(stress), "Strain " + component,
                   "this strain and Stress " + component +
                     " are both given; a load has one of them, and the other follows: "
                     "remove one");
      load.strain.push_back(strain);
      load.stress.push_back(stress);
    }
  return load;
}

void check_limit(const std::string &key,
                 const std::vector<double> &limit,
                 const std::size_t n_phases)
{
  if (limit.size() > 1 && limit.size() != n_phases)
    throw UserError("Loads/" + key + " has " + std::to_string(limit.size()) +
                    " numbers for " + std::to_string(n_phases) +
                    " phases; give one for all phases, or one a phase in the order of "
                    "Phases/Names");
}
} // namespace

std::vector<std::string> PrescribedLoad::assumed() const
{
  std::vector<std::string> names;
  for (std::size_t k = 0; k < strain.size(); ++k)
    if (std::isnan(strain[k]) && std::isnan(stress[k]))
      names.emplace_back(component_name(k, strain.size()));
  return names;
}

void LoadParameters::bind(Keys &keys, const unsigned int dim)
{
  const auto section = keys.section("Loads");
  std::vector<std::string> names, of;
  keys.bind_names(
    "Names", names, "load",
    "Names of macroscopic loads, each with a subsection of that name: of each "
    "component a strain or a stress. Local fields follow from the unit load "
    "cases without a further solve; empty: none");
  keys.bind_list("Boundary conditions", of, {"KUBC", "SUBC", "PBC", "MUBC"},
                 "Whose unit load cases are superposed, out of those of Homogenization; "
                 "empty: all of them [-]");
  keys.bind(
    "Write fields", write_fields,
    "Write the strains and stresses of all cells under each load into loads.h5: 64 "
    "bytes a cell, load and condition in 2D, 104 in 3D [-]");
  keys.bind(
    "Histogram bins", n_bins, 0, 10000,
    "Number of equal intervals, from the least to the largest value in a phase, of "
    "the histograms in loads.h5; 0: no histograms [-]");
  constexpr std::size_t most = 255;
  keys.bind_list(
    "Von Mises limit", von_mises_limit, Range::positive(),
    "Von Mises stress beyond which the share of each phase's volume is given: "
    "one for all phases or one a phase; empty: none [Pa]",
    0, most);
  keys.bind_list("Principal stress limit", principal_limit, Range::positive(),
                 "The same for the largest principal stress [Pa]", 0, most);
  loads.clear();
  for (const std::string &name : names)
    loads.push_back(bind_load(keys, name, dim));
  conditions.clear();
  for (const std::string &name : of)
    if (const BoundaryCondition condition = boundary_condition(name);
        !uses(condition) || conditions.empty())
      conditions.push_back(condition);
  keys.only_if(!loads.empty() || keys.is_typed("Loads/Names"),
               {"Boundary conditions", "Write fields", "Histogram bins",
                "Von Mises limit", "Principal stress limit"},
               "there are no loads", "name some in Loads/Names");
}

void LoadParameters::check(const std::vector<BoundaryCondition> &solved,
                           const std::vector<PhaseParameters> &phases) const
{
  const std::size_t n_phases = phases.size();
  for (const PhaseParameters &phase : phases)
    if (!loads.empty() && phase.name == whole_volume)
      throw UserError(
        "Phases/Names: a phase is called '" + phase.name +
        "', as results of loads call the whole volume; give it another name");
  for (const BoundaryCondition condition : conditions)
    if (std::find(solved.begin(), solved.end(), condition) == solved.end())
      throw UserError(
        "Loads/Boundary conditions: " + to_string(condition) +
        " is not among Homogenization/Boundary conditions; add it there, or "
        "take one of those");
  check_limit("Von Mises limit", von_mises_limit, n_phases);
  check_limit("Principal stress limit", principal_limit, n_phases);
  const auto nothing = [](const double value) {
    return std::isnan(value) || value == 0.;
  };
  const bool expands =
    std::any_of(phases.begin(), phases.end(),
                [](const PhaseParameters &phase) { return phase.expands(); });
  for (const PrescribedLoad &load : loads)
    if (load.heating != 0. && !expands)
      throw UserError("Loads/" + load.name +
                      "/Temperature change has no effect, as no phase has a Thermal "
                      "expansion; give one under Phases, or remove it");
    else if (load.heating == 0. &&
             std::all_of(load.strain.begin(), load.strain.end(), nothing) &&
             std::all_of(load.stress.begin(), load.stress.end(), nothing))
      throw UserError("Loads/" + load.name +
                      " prescribes no strain and no stress that is not 0; give one, such "
                      "as Stress xx, or a Temperature change");
}

bool LoadParameters::uses(const BoundaryCondition condition) const
{
  return conditions.empty() ||
         std::find(conditions.begin(), conditions.end(), condition) != conditions.end();
}
} // namespace mesoslip
