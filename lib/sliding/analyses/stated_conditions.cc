#include "base/digest.h"
#include "base/text.h"
#include "sliding/contact_parameters.h"
#include "sliding/run_plan.h"
#include "sliding/supports/support_text.h"

#include <array>
#include <cmath>

namespace mesoslip
{
namespace
{
const char *yes_or_no(const bool value)
{
  return value ? "yes" : "no";
}

/** Text as in the .prm. */
const char *side_text(const std::array<bool, 2> &held)
{
  const char *const names[] = {"free", "u_x", "u_y", "both"};
  return names[(held[0] ? 1 : 0) + (held[1] ? 2 : 0)];
}

void add_load(RunConditions &conditions, const std::string &name, const LoadHistory &load)
{
  conditions[name + "_history"] = load.shape();
  if (!load.is_expression())
    conditions[name] = load.amplitude();
  if (load.duration() > 0.)
    conditions[name + "_ramp_time"] = load.duration();
}

void add_friction(RunConditions &conditions, const ContactParameters &parameters)
{
  const FrictionParameters &friction = parameters.friction;
  conditions["gap"]                  = parameters.contact.gap;
  conditions["coefficient_from"] = friction.coefficient_by_phase ? "phases" : "constant";
  if (friction.coefficient_by_phase)
    conditions["node_rule"] = friction.node_rule;
  else if (friction.has_constant_coefficient() || !parameters.contact.law.coefficient_law)
    conditions["friction_coefficient"] = friction.coefficient;
  if (parameters.contact.law.coefficient_law)
    conditions["coefficient_law"] =
      friction.coefficient_law.text() +
      (friction.coefficient_by_phase && friction.coefficient_law.has_reference()
         ? ", reference = " + to_text(friction.coefficient)
         : "");
  if (parameters.contact.law.normal_stress.is_given())
    conditions["normal_stress"] =
      FrictionParameters::memory_text(parameters.contact.law.normal_stress);
  conditions["friction_law"] = friction.law_name;
  if (friction.law_name == "slip rate")
    {
      conditions["slip_length"]        = friction.slip_length;
      conditions["reference_velocity"] = friction.reference_velocity;
    }
  else if (!parameters.contact.law.node_law)
    conditions["regularization_time"] = parameters.contact.law.time;
}

/** Conditions of a body on a mesh or a 3D box, whose sides are free except the
 * constrained groups. */
void add_mesh(RunConditions &conditions, const ContactParameters &p, const bool transient)
{
  if (p.mesh.phases.size() > 1)
    conditions["material"] = "heterogeneous";
  for (unsigned int c = 0; c < p.mesh.mesh.dim; ++c)
    if (!p.mesh.held[c].empty())
      conditions[std::string("held_in_") + "xyz"[c]] = to_text(p.mesh.held[c]);
  if (!p.mesh.periodic[0].empty())
    conditions["periodic"] = "yes";
  if (!p.mesh.periodic[1].empty())
    conditions["periodic_in_y"] = "yes";
  if (p.mesh.mesh.dim == 3)
    {
      conditions["acceleration_z"] = p.step.acceleration[2];
      if (transient)
        conditions["initial_velocity_z"] = p.body.initial_velocity[2];
    }
}

/** "6e-3 x 4e-3", with a number per axis. */
template <typename Numbers>
std::string product_text(const Numbers &numbers, const unsigned int dim)
{
  std::string text;
  for (unsigned int c = 0; c < dim; ++c)
    text += (c > 0 ? " x " : "") + to_text(numbers[c]);
  return text;
}

/** Shape, material, damping, sliding and supports of a counter body; files enter by their
 * content. Homogeneous and heterogeneous bodies of one volume give the same text on any
 * cells, as for the body above. */
std::string counter_text(const ContactParameters &p)
{
  const BodyParameters &body = p.body;
  const unsigned int dim     = p.mesh.mesh.dim;
  std::string text           = p.mesh.is_given()
                                 ? "mesh " + Digest().add_file(p.mesh.mesh.files[0]).hex() +
                           ", scale " + to_text(p.mesh.mesh.scale)
                               : body.size[0] > 0. ? product_text(body.size, dim) + " m"
                                                   : std::string("as large as its volume");
  if (!body.rve_file.empty())
    text += ", RVE " + Digest().add_file(body.rve_file).hex();
  else
    text += ", " + to_text(body.stiffness) + " Pa, " + to_text(body.density) + " kg/m^3";
  text += ", alpha " + to_text(p.step.alpha) + " 1/s, beta " + to_text(p.step.beta) +
          " s, starts with " + product_text(p.body.initial_velocity, dim) + " m/s";
  if (!p.mesh.is_given())
    text += ", from " + product_text(body.position, dim - 1) + " m on";
  for (unsigned int axis = 0; axis < 2; ++axis)
    if (!p.mesh.periodic[axis].empty())
      text += std::string(", periodic in ") + "xy"[axis];
  if (p.slides_on)
    text += ", slides on";
  for (unsigned int c = 0; c < dim; ++c)
    for (const std::string &name : p.mesh.held[c])
      text += " | " + name + ": u_" + "xyz"[c] + " = 0";
  if (p.top.is_held())
    text += " | Bottom: held";
  const std::string supports = support_texts(p);
  return supports.empty() ? text : text + " | " + supports;
}
} // namespace

RunConditions ContactParameters::stated_conditions() const
{
  const bool transient     = analysis == ContactAnalysis::transient;
  RunConditions conditions = {
    {"analysis", transient ? "transient" : "static contact"},
    {"material", body.heterogeneous ? "heterogeneous" : "homogeneous"},
    {"top", top.suspension.absorbing      ? "absorbing"
            : top.is_suspended_by_nodes() ? "springs"
            : top.is_platen               ? "platen"
            : top.is_held()               ? "held"
                                          : "pressure"},
    {"lateral_held", yes_or_no(top.holds_tangentially())},
    {"left_side", side_text(sides.left_held)},
    {"right_side", side_text(sides.right_held)},
    {"periodic", yes_or_no(periodic)},
    {"acceleration_x", step.acceleration[0]},
    {"acceleration_y", step.acceleration[1]}};
  add_load(conditions, "pressure", top.pressure);
  add_load(conditions, "velocity", contact.flat_velocity);
  if (const auto &along = contact.flat_direction; along[1] != 0.)
    conditions.insert({{"flat_direction_x", along[0]}, {"flat_direction_y", along[1]}});
  add_friction(conditions, *this);
  if (top.is_platen)
    conditions["platen_mass"] = top.platen_mass;
  if (const std::string text = support_texts(*this); !text.empty())
    conditions["supports"] = text;
  if (counter)
    conditions["counter_body"] = counter_text(*counter);
  if (contact.is_compliant())
    conditions["normal_stiffness"] = contact.normal_spring.stiffness;
  if (contact.normal_spring.exponent != 1.)
    conditions.insert({{"normal_exponent", contact.normal_spring.exponent},
                       {"normal_stiffness_at", contact.normal_spring.at}});
  if (contact.slips_on_springs())
    conditions["tangential_stiffness"] = contact.tangential_stiffness;
  if (contact.profile)
    conditions["flat_profile"] = contact.profile->text();
  if (std::isfinite(top.hold_from))
    conditions["hold_from"] = top.hold_from;
  if (transient)
    {
      conditions["initial_velocity_x"] = body.initial_velocity[0];
      conditions["initial_velocity_y"] = body.initial_velocity[1];
      conditions["beta2"]              = step.beta2;
      conditions["rayleigh_beta"]      = step.beta;
      if (step.alpha > 0.)
        conditions["rayleigh_alpha"] = step.alpha;
      if (step.damps_by_phase())
        conditions["damping_by_phase"] = damping_text(step);
    }
  if (!mesh.is_plane_grid())
    add_mesh(conditions, *this, transient);
  return conditions;
}
} // namespace mesoslip
