#include "morphology/phase_parameters.h"

#include "base/errors.h"
#include "material/rotation.h"
#include "material/stiffness.h"
#include "parameters/keys.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mesoslip
{
void SinglePhaseParameters::bind(Keys &keys)
{
  const Range modulus = Range::closed(0., Range::stiffness().upper);
  keys.bind("Type", type, {"isotropic", "orthotropic", "stiffness"},
            "Which keys give the stiffness: Young modulus and Poisson ratio; the "
            "three lists of orthotropic constants; the stiffness coefficients [-]");
  keys.bind("Young modulus", young_modulus, modulus,
            "Isotropic: Young's modulus E; has to be given; a void has 1e-6 to 1e-4 of "
            "that of the stiffest phase [Pa]");
  keys.bind("Poisson ratio", poisson_ratio, Range::open(-1., 0.5),
            "Isotropic: Poisson's ratio [-]");
  keys.bind_list("Young moduli", young_moduli, modulus, "Orthotropic: E1, E2, E3 [Pa]", 0,
                 3);
  keys.bind_list("Poisson ratios", poisson_ratios, Range::any(),
                 "Orthotropic: nu12, nu13, nu23, where nu_ij is the contraction along "
                 "j for a load along i [-]",
                 0, 3);
  keys.bind_list("Shear moduli", shear_moduli, modulus, "Orthotropic: G12, G13, G23 [Pa]",
                 0, 3);
  keys.bind_list("Stiffness coefficients", stiffness_coefficients, Range::stiffness(),
                 "Stiffness in plane strain: Dxx, Dxy, Dyy, Dss, or the upper triangle "
                 "Dxx, Dxy, Dxs, Dyy, Dys, Dss with s the engineering shear [Pa]",
                 0, 6);
  keys.bind("Angle", angle, Range::any(),
            "Turns the material counter-clockwise, from x to axis 1 [rad]");
  keys.bind("Density", density, Range::closed(0., Range::density().upper),
            "Mass density; needed for dynamics [kg/m^3]");
  keys.bind("Friction coefficient", friction_coefficient, Range::non_negative(),
            "Coulomb coefficient of contact nodes in this phase [-]");
}

VoigtMatrix<2> SinglePhaseParameters::stiffness() const
{
  VoigtMatrix<2> D;
  if (type == Type::isotropic)
    D = isotropic_stiffness<2>(young_modulus, poisson_ratio);
  else if (type == Type::orthotropic)
    D = orthotropic_stiffness<2>(
      {young_moduli.at(0), young_moduli.at(1), young_moduli.at(2), poisson_ratios.at(0),
       poisson_ratios.at(1), poisson_ratios.at(2), shear_moduli.at(0), shear_moduli.at(1),
       shear_moduli.at(2)});
  else
    D = stiffness_from_coefficients<2>(stiffness_coefficients);
  return angle == 0. ? D : rotate_stiffness(D, angle);
}

void SinglePhaseParameters::check() const
{
  const std::string section = "'Phases/" + name;
  if (type == Type::isotropic && !(young_modulus > 0.))
    throw UserError(
      section + "/Young modulus' is " + to_text(young_modulus) +
      "; give the modulus in Pa, or set Type = orthotropic (with Young moduli, Poisson "
      "ratios and Shear moduli) or Type = stiffness (with Stiffness coefficients); a "
      "void "
      "needs a small modulus, 1e-6 to 1e-4 of that of the stiffest phase");
  if (type == Type::orthotropic)
    for (const auto &[key, list] : {std::make_pair("Young moduli", &young_moduli),
                                    std::make_pair("Poisson ratios", &poisson_ratios),
                                    std::make_pair("Shear moduli", &shear_moduli)})
      if (list->size() != 3)
        throw UserError(section + "/" + key + "': there are " +
                        std::to_string(list->size()) +
                        " values; an orthotropic phase needs three");
  if (!(density == 0. || Range::density().contains(density)))
    throw UserError(section + "/Density' is " + to_text(density) +
                    "; give the density in kg/m^3");
  if (!(friction_coefficient >= 0.))
    throw UserError(section + "/Friction coefficient' is " +
                    to_text(friction_coefficient) + "; it cannot be negative");
  try
    {
      stiffness();
    }
  catch (const std::invalid_argument &error)
    {
      throw UserError(section + "': " + error.what());
    }
}

std::string SinglePhaseParameters::text() const
{
  std::ostringstream text;
  text.precision(5);
  const VoigtMatrix<2> D = 1e-9 * stiffness();
  if (type == Type::isotropic)
    text << "E = " << 1e-9 * young_modulus << " GPa, nu = " << poisson_ratio;
  else if (D(0, 2) == 0. && D(1, 2) == 0.)
    text << "D11, D12, D22, D33 = " << D(0, 0) << ", " << D(0, 1) << ", " << D(1, 1)
         << ", " << D(2, 2) << " GPa";
  else
    text << "D11, D12, D13, D22, D23, D33 = " << D(0, 0) << ", " << D(0, 1) << ", "
         << D(0, 2) << ", " << D(1, 1) << ", " << D(1, 2) << ", " << D(2, 2) << " GPa";
  if (density > 0.)
    text << ", " << density << " kg/m^3";
  return text.str();
}

std::string SinglePhaseParameters::angle_warning() const
{
  if (!(std::fabs(angle) > 2. * M_PI))
    return "";
  return "'Phases/" + name + "/Angle' is " + to_text(angle) +
         " rad, more than a full turn; " + to_text(angle) + " degrees would be " +
         to_text(std::round(angle * M_PI / 180. * 1e6) / 1e6) + " rad";
}

Phase<2> SinglePhaseParameters::phase() const
{
  return {name, stiffness(), density, friction_coefficient};
}

void PhaseParameters::bind(Keys &keys)
{
  const auto section             = keys.section("Phases");
  std::vector<std::string> names = {"matrix", "fibre"};
  keys.bind_names("Names", names, "phase",
                  "Names of the phases, each with a subsection of its name; the first "
                  "one is the background [-]");
  phases.assign(names.size(), SinglePhaseParameters());
  for (std::size_t p = 0; p < names.size(); ++p)
    {
      const auto subsection = keys.section(names[p]);
      phases[p].name        = names[p];
      phases[p].bind(keys);
    }
}

void PhaseParameters::check_keys(const Keys &keys)
{
  for (const std::string &name : split_list(keys.value("Phases/Names")))
    {
      const std::string phase = "Phases/" + name + "/", type = phase + "Type";
      keys.only_with(type, {"isotropic"},
                     {phase + "Young modulus", phase + "Poisson ratio"});
      keys.only_with(
        type, {"orthotropic"},
        {phase + "Young moduli", phase + "Poisson ratios", phase + "Shear moduli"});
      keys.only_with(type, {"stiffness"}, {phase + "Stiffness coefficients"});
      keys.only_with(type, {"orthotropic", "stiffness"}, {phase + "Angle"});
    }
}

void PhaseParameters::check() const
{
  if (phases.empty() || phases.size() > 256)
    throw UserError("Phases/Names: there are " + std::to_string(phases.size()) +
                    " phases; name 1 to 256");
  for (const SinglePhaseParameters &phase : phases)
    phase.check();
}

void PhaseParameters::check_densities() const
{
  for (const SinglePhaseParameters &phase : phases)
    if (!(phase.density > 0.))
      throw UserError("'Phases/" + phase.name + "/Density' is " + to_text(phase.density) +
                      "; dynamics needs a positive density in kg/m^3");
}

unsigned int PhaseParameters::index_of(const std::string &name,
                                       const std::string &key) const
{
  std::vector<std::string> names;
  for (unsigned int i = 0; i < phases.size(); ++i)
    {
      if (phases[i].name == name)
        return i;
      names.push_back(phases[i].name);
    }
  throw UserError(key + ": there is no phase '" + name + "'; Phases/Names has " +
                  to_text(names));
}

std::vector<Phase<2>> PhaseParameters::make_phases() const
{
  std::vector<Phase<2>> result;
  for (const SinglePhaseParameters &phase : phases)
    result.push_back(phase.phase());
  return result;
}
} // namespace mesoslip
