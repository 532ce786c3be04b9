#include "parameters/keys.h"
#include "sliding/contact_parameters.h"
#include "sliding/keys/body_keys.h"
#include "sliding/supports/side_keys.h"

#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
namespace
{
/** A support of a body that is computed upside down. */
SideSupport turned_over(SideSupport side, const unsigned int dim)
{
  const auto negative = [](const std::string &text) { return "-(" + text + ")"; };
  LoadHistory &motion = side.suspension.motion[dim - 1];
  if (motion.is_expression())
    motion = LoadHistory(1., negative(motion.shape()));
  Traction &traction = side.suspension.traction;
  if (traction.acts(dim - 1))
    traction.set(dim - 1, negative(traction.text(dim - 1)));
  return side;
}

/** The bottom as the top of a body that is computed upside down. */
TopSetup top_of(const SideSupport &bottom, const Keys &keys, const unsigned int dim)
{
  TopSetup top;
  static_cast<SideSupport &>(top) = turned_over(bottom, dim);
  const bool all = bottom.held[0] && bottom.held[dim - 1] && (dim == 2 || bottom.held[1]);
  keys.require(all || !bottom.held[dim - 1], "Bottom/Held",
               std::string("u_") + "xyz"[dim - 1] +
                 " is held, but not all components; set Kind = held, or leave it out");
  if (all)
    top.hold();
  return top;
}
} // namespace

void ContactParameters::bind_counter(Keys &keys)
{
  const auto section   = keys.section("Counter body");
  auto other           = std::make_shared<ContactParameters>();
  other->mesh.mesh.dim = mesh.mesh.dim;
  bind_material(keys, other->body, other->mesh, true);
  bind_vector(
    keys, "Initial velocity", other->body.initial_velocity, mesh.mesh.dim,
    "Velocity of all of the counter body at the start: x, y and, in 3D, z [m/s]");
  other->step       = StepParameters();
  other->step.dt    = step.dt;
  other->step.beta2 = step.beta2;
  other->n_alphas =
    bind_damping(keys, "Rayleigh alpha", other->step.alpha, other->step.alpha_of_phases,
                 "As Body/Rayleigh alpha, of the counter body [1/s]");
  other->n_betas =
    bind_damping(keys, "Rayleigh beta", other->step.beta, other->step.beta_of_phases,
                 "As Time/Rayleigh beta, of the counter body [s]");
  SideSupport bottom;
  {
    const auto of_supports = keys.section("Supports");
    bottom                 = bind_side(keys, "Bottom", mesh.mesh.dim, "held");
    for (const char *name : {"Left", "Right"})
      if (const SideSupport side = bind_side(keys, name, mesh.mesh.dim);
          side.holds() || side.is_loaded())
        other->supports.push_back(turned_over(side, mesh.mesh.dim));
    if (keys.are_read())
      other->top = top_of(bottom, keys, mesh.mesh.dim);
  }
  const bool is_there = other->body.size[0] > 0. || !other->body.rve_file.empty();
  keys.only_if(is_there,
               {"Material", "Stiffness from", "Stiffness", "Density", "Cells",
                "Initial velocity", "Rayleigh alpha", "Rayleigh beta", "Supports/"},
               "Counter body/Size is empty, so that the flat is rigid", "give it");
  if (!keys.are_read() || !is_there)
    return;
  check_counter(keys, *other);
  other->analysis          = analysis;
  other->time              = time;
  other->sweep             = sweep;
  other->periodic          = periodic;
  other->energy_interval   = energy_interval;
  other->upside_down       = true;
  other->step.acceleration = step.acceleration;
  other->step.acceleration[mesh.mesh.dim - 1] *= -1.;
  other->body.initial_velocity[mesh.mesh.dim - 1] *= -1.;
  other->friction.coefficient_by_phase = false;
  other->contact.gap                   = 1.; // nothing is there that it could touch
  other->hold_sides();
  counter = other;
}

/** What a second body goes with. */
void ContactParameters::check_counter(const Keys &keys,
                                      const ContactParameters &other) const
{
  keys.require(analysis == ContactAnalysis::transient, "Size",
               "a counter body is known in transient runs only; leave it empty, or set "
               "Analysis = transient");
  keys.require(mesh.is_plane_grid(), "Size",
               "a counter body is known below plane grids only; leave it empty");
  keys.require(profile.expression.empty() && profile.file.empty(), "Size",
               "a counter body has no Flat/Profile; leave one of the two out");
  for (const SideSupport &side : other.supports)
    keys.require(!periodic, "Supports/" + side.name + "/Kind",
                 "Sides/Periodic is true, so that Left and Right are free; leave it out");
}
} // namespace mesoslip
