#include "microstructure/phase_parameters.h"

#include "io/errors.h"
#include "io/key_use.h"
#include "io/parameters.h"
#include "io/raw_parameters.h"
#include "material/rotation.h"
#include "material/stiffness.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mesoslip
{
namespace
{
constexpr const char *names_key = "Names";

const std::vector<std::string> default_names = {"matrix", "fibre"};

void declare_phase(dealii::ParameterHandler &prm)
{
  const SinglePhaseParameters defaults;
  const Range modulus = Range::closed(0., Range::stiffness().upper);
  declare_selection(
    prm, "Type", "isotropic", {"isotropic", "orthotropic", "stiffness"},
    "Which keys give the stiffness: Young modulus and Poisson ratio; the "
    "three lists of orthotropic constants; the stiffness coefficients [-]");
  declare_double(
    prm, "Young modulus", defaults.young_modulus, modulus,
    "Isotropic: Young's modulus E; has to be given; a void has 1e-6 to 1e-4 of that "
    "of the stiffest phase [Pa]");
  declare_double(prm, "Poisson ratio", defaults.poisson_ratio, Range::open(-1., 0.5),
                 "Isotropic: Poisson's ratio [-]");
  declare_double_list(prm, "Young moduli", {}, modulus, "Orthotropic: E1, E2, E3 [Pa]", 0,
                      3);
  declare_double_list(
    prm, "Poisson ratios", {}, Range::any(),
    "Orthotropic: nu12, nu13, nu23, where nu_ij is the contraction along "
    "j for a load along i [-]",
    0, 3);
  declare_double_list(prm, "Shear moduli", {}, modulus, "Orthotropic: G12, G13, G23 [Pa]",
                      0, 3);
  declare_double_list(
    prm, "Stiffness coefficients", {}, Range::stiffness(),
    "Stiffness in plane strain: Dxx, Dxy, Dyy, Dss, or the upper triangle "
    "Dxx, Dxy, Dxs, Dyy, Dys, Dss with s the engineering shear [Pa]",
    0, 6);
  declare_double(prm, "Angle", defaults.angle, Range::any(),
                 "Turns the material counter-clockwise, from x to axis 1 [rad]");
  declare_double(prm, "Density", defaults.density,
                 Range::closed(0., Range::density().upper),
                 "Mass density; needed for dynamics [kg/m^3]");
  declare_double(prm, "Friction coefficient", defaults.friction_coefficient,
                 Range::non_negative(),
                 "Coulomb coefficient of contact nodes in this phase [-]");
}

SinglePhaseParameters::Type parse_type(const std::string &text)
{
  using Type = SinglePhaseParameters::Type;
  return text == "isotropic"     ? Type::isotropic
         : text == "orthotropic" ? Type::orthotropic
                                 : Type::stiffness;
}

SinglePhaseParameters parse_phase(dealii::ParameterHandler &prm, const std::string &name)
{
  SinglePhaseParameters phase;
  phase.name                   = name;
  phase.type                   = parse_type(get_string(prm, "Type"));
  phase.young_modulus          = get_double(prm, "Young modulus");
  phase.poisson_ratio          = get_double(prm, "Poisson ratio");
  phase.young_moduli           = get_double_list(prm, "Young moduli");
  phase.poisson_ratios         = get_double_list(prm, "Poisson ratios");
  phase.shear_moduli           = get_double_list(prm, "Shear moduli");
  phase.stiffness_coefficients = get_double_list(prm, "Stiffness coefficients");
  phase.angle                  = get_double(prm, "Angle");
  phase.density                = get_double(prm, "Density");
  phase.friction_coefficient   = get_double(prm, "Friction coefficient");
  return phase;
}
} // namespace

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

void PhaseParameters::declare(dealii::ParameterHandler &prm, const RawParameters &raw)
{
  const ParameterSection section(prm, "Phases");
  declare_word_list(prm, names_key, default_names, {},
                    "Names of the phases, each with a subsection of its name; the first "
                    "one is the background [-]");
  for (const std::string &name :
       raw.section_names("Phases/Names", default_names, "phase"))
    {
      const ParameterSection subsection(prm, name);
      declare_phase(prm);
    }
}

void PhaseParameters::check_keys(const KeyUse &use)
{
  for (const std::string &name :
       split_list(use.value(std::string("Phases/") + names_key)))
    {
      const std::string phase = "Phases/" + name + "/", type = phase + "Type";
      use.only_with(type, {"isotropic"},
                    {phase + "Young modulus", phase + "Poisson ratio"});
      use.only_with(
        type, {"orthotropic"},
        {phase + "Young moduli", phase + "Poisson ratios", phase + "Shear moduli"});
      use.only_with(type, {"stiffness"}, {phase + "Stiffness coefficients"});
      use.only_with(type, {"orthotropic", "stiffness"}, {phase + "Angle"});
    }
}

void PhaseParameters::parse(dealii::ParameterHandler &prm)
{
  const ParameterSection section(prm, "Phases");
  phases.clear();
  for (const std::string &name : get_word_list(prm, names_key))
    {
      if (std::any_of(phases.begin(), phases.end(),
                      [&](const SinglePhaseParameters &p) { return p.name == name; }))
        throw UserError("Phases/Names: there are two phases named '" + name +
                        "'; rename one");
      const ParameterSection subsection(prm, name);
      phases.push_back(parse_phase(prm, name));
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
