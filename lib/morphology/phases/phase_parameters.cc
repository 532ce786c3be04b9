#include "morphology/phases/phase_parameters.h"

#include "base/errors.h"
#include "material/engineering_constants.h"
#include "material/stiffness.h"
#include "parameters/keys.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** Binds the orientation in 3D. */
void bind_orientation(Keys &keys, PhaseParameters &phase)
{
  const std::string which = "3D, orthotropic and stiffness: ";
  keys.bind_list("Euler angles", phase.euler_angles, Range::any(),
                 which +
                   "Bunge's angles phi1, Phi, phi2: the material is turned about its "
                   "axis 3 by phi1, then about its axis 1 by Phi, then about its "
                   "axis 3 by phi2, each counter-clockwise. Empty: not turned "
                   "[degrees]",
                 0, 3);
  keys.bind_list("Axis 1", phase.axis_1, Range::any(),
                 which +
                   "instead of Euler angles, a vector along axis 1 of the material, "
                   "of any length. Empty: none [-]",
                 0, 3);
  keys.bind_list("Axis 2", phase.axis_2, Range::any(),
                 which + "with Axis 1, a vector along axis 2, perpendicular to it [-]", 0,
                 3);
  for (const auto &[key, list] :
       {std::pair("Euler angles", &phase.euler_angles),
        std::pair("Axis 1", &phase.axis_1), std::pair("Axis 2", &phase.axis_2)})
    keys.require(list->size() % 3 == 0, key,
                 "there are " + std::to_string(list->size()) + " numbers; give three");
}

void bind_deviations(Keys &keys, PhaseParameters &phase, const bool of_volume)
{
  keys.bind_list(
    "Relative deviation", phase.deviations, Range::non_negative(),
    "Standard deviations of the constants of the stiffness over their values: "
    "one number for all of them, or one for each in the order of the keys and "
    "of their numbers (E, nu; E1, E2, E3, nu12, nu13, nu23, G12, G13, G23; the "
    "entries of the matrix as they are given). They are taken as independent, "
    "and the deviations of " +
      std::string(of_volume ? "the effective stiffness" : "the frequencies of modes") +
      " follow; empty: none [-]",
    0, 21);
}

/** Binds keys of what a volume has besides its stiffness. */
void bind_of_volume(Keys &keys, PhaseParameters &phase)
{
  keys.bind_list(
    "Thermal expansion", phase.expansion, Range::any(),
    "Coefficient of linear thermal expansion, one number for all directions or "
    "three along the axes 1, 2, 3 of the material, which are x, y, z before "
    "they are turned; the expansion of the composite follows, and Loads may "
    "change the temperature; empty: none [1/K]",
    0, 3);
  keys.require(
    phase.expansion.size() != 2, "Thermal expansion",
    "there are two numbers; give one, or three along the axes of the material");
  keys.bind_list(
    "Conductivity", phase.conductivities, Range::non_negative(),
    "Conductivity of heat or of a current, in one unit for all phases, one "
    "number for all directions or three along the axes 1, 2, 3 of the material; "
    "the conductivity of the composite follows, under the Boundary conditions of "
    "Homogenization, where a mean strain stands for a mean gradient; empty: none "
    "[W/(m K), S/m]",
    0, 3);
  keys.require(phase.conductivities.size() != 2 &&
                 std::all_of(phase.conductivities.begin(), phase.conductivities.end(),
                             [](const double k) { return k > 0.; }),
               "Conductivity",
               "give one number above 0, or three along the axes of the material");
  keys.bind(
    "Loss factor", phase.loss_factor, Range::non_negative(),
    "Imaginary over real part of the stiffness, the same for all its entries: the "
    "loss factors of the composite follow; 0: none [-]");
}

void bind_phase(Keys &keys, PhaseParameters &phase, const bool of_volume)
{
  const Range modulus = Range::closed(0., Range::stiffness().upper);
  keys.bind("Type", phase.type, {"isotropic", "orthotropic", "stiffness"},
            "Which keys give the stiffness: isotropic: Young modulus and Poisson ratio; "
            "orthotropic: Young moduli, Poisson ratios and Shear moduli; stiffness: the "
            "entries of the matrix [-]");
  keys.bind("Young modulus", phase.young_modulus, modulus,
            "Isotropic: Young's modulus E. It has no default. A void is a phase with "
            "1e-6 to 1e-4 of the modulus of the stiffest phase [Pa]");
  keys.bind("Poisson ratio", phase.poisson_ratio, Range::open(-1., 0.5),
            "Isotropic: Poisson's ratio nu of the three-dimensional solid, which is in "
            "plane strain in 2D [-]");
  keys.bind_list("Young moduli", phase.young_moduli, modulus,
                 "Orthotropic: Young's moduli E1, E2, E3 along the axes of the material, "
                 "of which 1 is x, 2 is y and 3 is z before they are turned by Angle "
                 "[Pa]",
                 0, 3);
  keys.bind_list("Poisson ratios", phase.poisson_ratios, Range::any(),
                 "Orthotropic: Poisson's ratios nu12, nu13, nu23, where nu_ij is the "
                 "contraction along j for a load along i [-]",
                 0, 3);
  keys.bind_list("Shear moduli", phase.shear_moduli, modulus,
                 "Orthotropic: shear moduli G12, G13, G23 [Pa]", 0, 3);
  keys.bind_list("Stiffness", phase.coefficients, Range::stiffness(),
                 "Stiffness matrix D, stress = D strain with the engineering shear "
                 "strain. In 2D, plane strain with the components xx, yy, xy: D11, D12, "
                 "D22, D33, or all of the upper triangle D11, D12, D13, D22, D23, D33. "
                 "In 3D, with xx, yy, zz, yz, xz, xy: D11, D12, D13, D22, D23, D33, D44, "
                 "D55, D66, or all 21 of the upper triangle, row by row [Pa]",
                 0, 21);
  keys.bind("Angle", phase.angle, Range::any(),
            "Orthotropic and stiffness: angle by which the material is turned "
            "counter-clockwise about z, from x to its axis 1, in radians, not in "
            "degrees as Euler angles [rad]");
  bind_orientation(keys, phase);
  keys.bind("Density", phase.density, Range::closed(0., Range::density().upper),
            "Mass density. Statics and homogenization do without; contact_dynamics needs "
            "it [kg/m^3]");
  keys.bind("Friction coefficient", phase.friction_coefficient, Range::non_negative(),
            "Coulomb coefficient of the contact nodes that lie in this phase, used by "
            "contact_dynamics with Coefficient from = phases [-]");
  bind_deviations(keys, phase, of_volume);
  if (of_volume)
    bind_of_volume(keys, phase);
  keys.renamed("Stiffness coefficients", "Stiffness");
  keys.only_with("Type", {"isotropic"}, {"Young modulus", "Poisson ratio"});
  keys.only_with("Type", {"orthotropic"},
                 {"Young moduli", "Poisson ratios", "Shear moduli"});
  keys.only_with("Type", {"stiffness"}, {"Stiffness"});
  keys.only_with("Type", {"orthotropic", "stiffness"},
                 {"Angle", "Euler angles", "Axis 1", "Axis 2"});
}
} // namespace

void bind_mean_dilatation(Keys &keys, MeanDilatation &choice)
{
  keys.bind(
    "Mean dilatation", choice, {"auto", "always", "never"},
    "Phases in which the change of volume of quadrilaterals and hexahedra is that of "
    "their mean (B-bar), so that they do not lock: auto, those whose Poisson's ratio "
    "is above 0.45; always, all; never, none, which takes full integration for all "
    "of them. Triangles and tetrahedra have one strain in any case, and lock [-]");
}

void bind_phases(Keys &keys, std::vector<PhaseParameters> &phases, const bool of_volume)
{
  const auto section             = keys.section("Phases");
  std::vector<std::string> names = {"matrix", "fibre"};
  keys.bind_names("Names", names, "phase",
                  "Names of the phases, each with a subsection of its name. The first "
                  "one is the background of the morphology [-]",
                  256);
  keys.require(!names.empty(), "Names", "there are 0 phases; name 1 to 256");
  phases.assign(names.size(), PhaseParameters());
  for (std::size_t p = 0; p < names.size(); ++p)
    {
      const auto subsection = keys.section(names[p]);
      phases[p].name        = names[p];
      bind_phase(keys, phases[p], of_volume);
    }
}

template <int dim>
std::vector<Phase<dim>> make_phases(const std::vector<PhaseParameters> &parameters)
{
  std::vector<Phase<dim>> phases;
  for (const PhaseParameters &p : parameters)
    phases.push_back({p.name, p.stiffness<dim>(), p.density, p.friction_coefficient,
                      p.thermal_stress<dim>()});
  return phases;
}

template <int dim>
VoigtMatrix<dim> PhaseParameters::stiffness() const
{
  VoigtMatrix<dim> D;
  if (type == Type::isotropic)
    D = isotropic_stiffness<dim>(young_modulus, poisson_ratio);
  else if (type == Type::orthotropic)
    D = orthotropic_stiffness<dim>(orthotropic());
  else
    D = stiffness_from_coefficients<dim>(coefficients);
  return turned<dim>(D);
}

template <int dim>
VoigtMatrix<dim> PhaseParameters::turned(const VoigtMatrix<dim> &of_material) const
{
  if constexpr (dim == 3)
    if (is_turned_in_3d())
      return turn_stiffness(of_material, rotation());
  return angle == 0. ? of_material : rotate_stiffness<dim>(of_material, angle);
}

Eigen::Matrix3d PhaseParameters::rotation() const
{
  if (axis_1.empty() && axis_2.empty())
    {
      const double degree = M_PI / 180.;
      return bunge_rotation(degree * euler_angles.at(0), degree * euler_angles.at(1),
                            degree * euler_angles.at(2));
    }
  if (axis_1.empty() || axis_2.empty())
    throw std::invalid_argument("Axis 1 and Axis 2 must be given together");
  return rotation_from_axes(Eigen::Vector3d(axis_1.data()),
                            Eigen::Vector3d(axis_2.data()));
}

template <int dim>
void PhaseParameters::check() const
{
  const std::string section = "'Phases/" + name;
  const char *turned        = !euler_angles.empty() ? "/Euler angles'" : "/Axis 1'";
  if (dim == 2 && is_turned_in_3d())
    throw UserError(section + turned + " needs Dimension = 3; in the plane set Angle");
  if (is_turned_in_3d() &&
      (angle != 0. || (!euler_angles.empty() && !(axis_1.empty() && axis_2.empty()))))
    throw UserError(section + turned + " contradicts " +
                    (angle != 0. ? "Angle" : "Axis 1 and Axis 2") +
                    "; remove one of them");
  if (type == Type::isotropic && !(young_modulus > 0.))
    throw UserError(
      section + "/Young modulus' is " + to_text(young_modulus) +
      "; give the modulus in Pa, or set Type = orthotropic (with Young moduli, Poisson "
      "ratios and Shear moduli) or Type = stiffness (with Stiffness); a void needs a "
      "small modulus, 1e-6 to 1e-4 of that of the stiffest phase");
  if (type == Type::orthotropic)
    for (const auto &[key, list] : {std::pair("Young moduli", &young_moduli),
                                    std::pair("Poisson ratios", &poisson_ratios),
                                    std::pair("Shear moduli", &shear_moduli)})
      if (list->size() != 3)
        throw UserError(section + "/" + key + "': there are " +
                        std::to_string(list->size()) +
                        " values; an orthotropic phase needs three");
  if (!(density == 0. || Range::density().contains(density)))
    throw UserError(section + "/Density' is " + to_text(density) +
                    "; give the density in kg/m^3");
  try
    {
      stiffness<dim>();
    }
  catch (const std::invalid_argument &error)
    {
      throw UserError(section + "': " + error.what());
    }
  const bool has_axes = std::any_of(expansion.begin(), expansion.end(),
                                    [this](const double a) { return a != expansion[0]; });
  if (type == Type::isotropic && (has_axes || conducts_along_axes()))
    throw UserError(
      section + (has_axes ? "/Thermal expansion'" : "/Conductivity'") +
      " differs along axes, which Type = isotropic has none of; give one number, "
      "or set Type = orthotropic");
  if (dim == 2 && expands() && type == Type::stiffness)
    throw UserError(section +
                    "/Thermal expansion' needs the stiffness along z, of which Type = "
                    "stiffness says nothing in 2D; give the moduli as isotropic or "
                    "orthotropic");
  if (!deviations.empty())
    check_deviations(constants<dim>().size());
}

template <int dim>
std::string PhaseParameters::text() const
{
  std::ostringstream text;
  text.precision(5);
  const VoigtMatrix<dim> D = 1e-9 * stiffness<dim>();
  if (type == Type::isotropic)
    text << "E = " << 1e-9 * young_modulus << " GPa, nu = " << poisson_ratio;
  else
    {
      const bool short_form = D == orthotropic_part<dim>(D);
      std::string names;
      std::ostringstream values;
      values.precision(5);
      for (const StiffnessEntry &entry : stiffness_entries<dim>())
        if (!short_form || !entry.couples_shear(dim))
          {
            names += (names.empty() ? "" : ", ") + entry.name;
            values << (entry.row + entry.column == 0 ? "" : ", ")
                   << D(entry.row, entry.column);
          }
      text << names << " = " << values.str() << " GPa";
    }
  if (density > 0.)
    text << ", " << density << " kg/m^3";
  return text.str();
}

template std::vector<Phase<2>> make_phases<2>(const std::vector<PhaseParameters> &);
template std::vector<Phase<3>> make_phases<3>(const std::vector<PhaseParameters> &);
template VoigtMatrix<2> PhaseParameters::stiffness<2>() const;
template VoigtMatrix<3> PhaseParameters::stiffness<3>() const;
template VoigtMatrix<2> PhaseParameters::turned<2>(const VoigtMatrix<2> &) const;
template VoigtMatrix<3> PhaseParameters::turned<3>(const VoigtMatrix<3> &) const;
template void PhaseParameters::check<2>() const;
template void PhaseParameters::check<3>() const;
template std::string PhaseParameters::text<2>() const;
template std::string PhaseParameters::text<3>() const;
} // namespace mesoslip
