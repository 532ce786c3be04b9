#include "parameters/keys.h"
#include "sliding/contact_parameters.h"
#include "sliding/counter/counter_text.h"
#include "sliding/keys/body_keys.h"
#include "sliding/supports/support_keys.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
namespace
{
/** Whether an expression is "-(...)" with matching brackets. */
bool is_negative(const std::string &text)
{
  if (text.size() < 3 || text.compare(0, 2, "-(") != 0)
    return false;
  int depth     = 0;
  std::size_t k = 1;
  do
    depth += text[k] == '(' ? 1 : text[k] == ')' ? -1 : 0;
  while (depth > 0 && ++k < text.size());
  return k + 1 == text.size();
}

std::string negative(const std::string &text)
{
  return is_negative(text) ? text.substr(2, text.size() - 3) : "-(" + text + ")";
}
} // namespace

SideSupport turned_over(SideSupport side, const unsigned int dim)
{
  LoadHistory &motion = side.suspension.motion[dim - 1];
  if (motion.is_expression())
    motion = LoadHistory(1., negative(motion.shape()));
  Traction &traction = side.suspension.traction;
  if (traction.acts(dim - 1))
    traction.set(dim - 1, negative(traction.text(dim - 1)));
  return side;
}

namespace
{
/** Converts the bottom to the top of a body that is computed upside down. */
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

/** Binds the supports of a counter body: the bottom, other sides of grids, and groups of
 * a mesh. */
void ContactParameters::bind_supports_below(Keys &keys, ContactParameters &other) const
{
  const auto section             = keys.section("Supports");
  const unsigned int dim         = mesh.mesh.dim;
  const bool turned              = other.is_turned_over();
  const SideSupport bottom       = bind_support(keys, "Bottom", dim, {"held"});
  std::vector<std::string> names = sides_of_grid;
  for (const std::string &name : keys.typed_sections())
    if (name != "Bottom" && !is_side_of_grid(name))
      names.push_back(name);
  const auto add = [&](const SideSupport &side) {
    if (side.holds() || side.is_loaded())
      other.supports.push_back(turned ? turned_over(side, dim) : side);
  };
  if (!turned)
    add(bottom);
  for (const std::string &name : names)
    {
      const SideSupport side = bind_support(keys, name, dim);
      keys.require(other.mesh.is_given() || is_side_of_grid(name), name,
                   "the counter body is a grid, whose sides are Left, Right, Front, Back "
                   "and Bottom; name one of them, or set Counter body/Mesh/File");
      keys.require(
        name != other.mesh.contact_boundary || (!side.holds() && !side.is_loaded()), name,
        "it is the contact of the counter body, which has no support; leave "
        "the section out");
      add(side);
    }
  keys.only_if(dim == 3 || other.mesh.is_given(), {"Front/", "Back/"},
               "the body is plane", "set Dimension = 3");
  if (!keys.are_read())
    return;
  if (turned)
    other.top = top_of(bottom, keys, dim);
}

void ContactParameters::bind_counter(Keys &keys)
{
  const auto section       = keys.section("Counter body");
  const unsigned int dim   = mesh.mesh.dim;
  auto other               = std::make_shared<ContactParameters>();
  other->is_counter        = true;
  other->analysis          = analysis;
  other->body.section      = "Counter body";
  other->mesh.section      = "Counter body/";
  other->mesh.mesh.dim     = dim;
  other->mesh.top_boundary = "";
  other->top               = TopSetup();
  other->top.is_platen     = false;
  other->mesh.bind_below(keys);
  bind_material(keys, other->body, other->mesh, true);
  other->mesh.mesh.one_phase = !other->body.heterogeneous;
  bind_vector(
    keys, "Initial velocity", other->body.initial_velocity, dim,
    "Velocity of all of the counter body at the start: x, y and, in 3D, z [m/s]");
  std::vector<double> place = {0.};
  keys.bind_list("Position", place, Range::any(),
                 "x and, in 3D, y of the corner of a grid with the lowest ones; the body "
                 "has it at 0 [m]",
                 1, dim - 1);
  std::copy(place.begin(), place.end(), other->body.position.begin());
  keys.bind("Sliding", other->slides_on, {"small", "finite"},
            "small: the body meets the same nodes all the time; finite: the counter body "
            "moves on below it by what the flat moves [-]");
  std::array<bool, 2> repeats = {};
  keys.bind("Periodic", repeats[0],
            "Periodic in x, also below a body that is not: an endless counter body");
  keys.bind("Periodic in y", repeats[1], "The same along y, in 3D");
  other->step       = StepParameters();
  other->step.dt    = step.dt;
  other->step.beta2 = step.beta2;
  other->n_alphas =
    bind_damping(keys, "Rayleigh alpha", other->step.alpha, other->step.alpha_of_phases,
                 "As Body/Rayleigh alpha, of the counter body [1/s]");
  other->n_betas =
    bind_damping(keys, "Rayleigh beta", other->step.beta, other->step.beta_of_phases,
                 "As Time/Rayleigh beta, of the counter body [s]");
  bind_supports_below(keys, *other);
  {
    const auto part           = keys.section("Observation");
    other->observation.probes = bind_probes(keys, "Counter body/Observation", dim);
  }
  const bool is_there =
    other->body.size[0] > 0. || !other->body.rve_file.empty() || other->mesh.is_given();
  keys.only_if(is_there,
               {"Material", "Stiffness from", "Stiffness", "Density", "Cells", "Position",
                "Sliding", "Periodic", "Periodic in y", "Initial velocity",
                "Rayleigh alpha", "Rayleigh beta", "Supports/", "Observation/"},
               "Counter body/Size is empty, so that the flat is rigid", "give it");
  keys.only_if(!other->mesh.is_given(), {"Size", "Cells", "Position"},
               "the counter body is a mesh", "remove Counter body/Mesh/File");
  keys.only_if(!other->mesh.is_given(), {"Periodic", "Periodic in y"},
               "the counter body is a mesh", "set Counter body/Mesh/Periodic in x or y");
  keys.only_if(dim == 3, {"Periodic in y"}, "the body is plane", "set Dimension = 3");
  if (!keys.are_read() || !is_there)
    return;
  other->periodic = periodic || repeats[0];
  for (std::size_t axis = 0; axis < 2 && !other->mesh.is_given(); ++axis)
    if (!mesh.periodic[axis].empty() || repeats[axis])
      other->mesh.periodic[axis] = {sides_of_grid[2 * axis], sides_of_grid[2 * axis + 1]};
  check_counter(keys, *other);
  other->time              = time;
  other->sweep             = sweep;
  other->energy_interval   = energy_interval;
  other->step.acceleration = step.acceleration;
  if (other->is_turned_over())
    {
      other->step.acceleration[1] *= -1.;
      if (other->body.initial_velocity[1] != 0.)
        other->body.initial_velocity[1] *= -1.;
    }
  other->friction.coefficient_by_phase = false;
  other->contact.gap                   = 1.; // the body below has no opponent
  other->hold_sides();
  counter = other;
}

/** Checks which keys and analyses support a counter body. */
void ContactParameters::check_counter(const Keys &keys,
                                      const ContactParameters &other) const
{
  const std::string size = other.mesh.is_given() ? "Mesh/File" : "Size";
  keys.require(analysis != ContactAnalysis::friction_homogenization, size,
               "the homogenization of friction knows no counter body; leave it empty, or "
               "set Analysis = transient");
  keys.require(analysis != ContactAnalysis::transient ||
                 mesh.is_plane_grid() == other.mesh.is_plane_grid(),
               size,
               mesh.is_plane_grid()
                 ? "the body is a plane grid, and so has to be the counter body; give "
                   "Counter body/Size and Cells, or set Mesh/File"
                 : "the body is a plane mesh, and so has to be the counter body; set "
                   "Counter body/Mesh/File, or remove Mesh/File");
  keys.require(
    !other.slides_on || analysis == ContactAnalysis::transient, "Sliding",
    "a counter body that moves on is known in transient runs; set it to small, "
    "or Analysis = transient");
  keys.require(profile.expression.empty() && profile.file.empty(), size,
               "a counter body has no Flat/Profile; leave one of the two out");
  for (const SideSupport &side : other.supports)
    for (const auto &groups : other.mesh.periodic)
      keys.require(std::count(groups.begin(), groups.end(), side.name) == 0,
                   "Supports/" + side.name + "/Kind",
                   other.mesh.is_given()
                     ? "the group is one of Counter body/Mesh/Periodic in x or y, which "
                       "are free; leave it out"
                     : "Sides/Periodic is true for this side and the one opposite, which "
                       "are free; leave it out");
}
} // namespace mesoslip
