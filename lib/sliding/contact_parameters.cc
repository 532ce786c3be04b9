#include "sliding/contact_parameters.h"

#include "base/errors.h"
#include "base/files.h"
#include "parameters/keys.h"
#include "sliding/keys/body_keys.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mesoslip
{
namespace
{
void bind_body(Keys &keys, ContactParameters &p)
{
  const auto section = keys.section("Body");
  bind_material(keys, p.body, p.mesh);
  bind_vector(keys, "Initial velocity", p.body.initial_velocity, p.mesh.mesh.dim,
              "Velocity of the whole body at the start: x, y and, in 3D, z [m/s]");
  bind_vector(
    keys, "Acceleration", p.step.acceleration, p.mesh.mesh.dim,
    "Acceleration that acts on the whole body, such as gravity: x, y and, in 3D, "
    "z [m/s^2]");
  p.n_alphas = bind_damping(
    keys, "Rayleigh alpha", p.step.alpha, p.step.alpha_of_phases,
    "alpha of the mass-proportional damping C = alpha M, which damps a "
    "vibration of the frequency f with the ratio alpha / (4 pi f); one value, "
    "or one for each phase, which then does not act on masses of supports "
    "[1/s]");
}

void bind_time(Keys &keys, ContactParameters &p)
{
  const auto section = keys.section("Time");
  keys.bind("End time", p.time.end_time, Range::positive(),
            "Time at which the run ends, which starts at 0 [s]");
  keys.bind_or_auto("Time step", p.step.dt, Range::positive(),
                    "Time step of the explicit scheme; auto: Safety factor times the "
                    "critical one, which is computed [s]");
  keys.bind(
    "Safety factor", p.time.safety, Range::left_open(0., 1.),
    "Fraction of the critical time step that Time step = auto takes; reduce it if "
    "a run becomes unstable [-]");
  keys.bind("Beta2", p.step.beta2, Range::closed(0.5, 1.),
            "beta2 of the time scheme: 1/2 is the leapfrog scheme of order two; larger "
            "values dissipate vibrations whose periods are a few time steps [-]");
  p.n_betas =
    bind_damping(keys, "Rayleigh beta", p.step.beta, p.step.beta_of_phases,
                 "beta of the stiffness-proportional damping C = beta K, which damps a "
                 "vibration of the frequency f with the ratio pi f beta; it reduces the "
                 "critical time step; one value, or one for each phase, with which steps "
                 "take two to three times as long [s]");
  std::string precision = "double";
  keys.bind("Precision", precision, {"double", "single"},
            "Precision of the motion of a plane grid between its contact and its top; "
            "single: steps of the pin are 1.5 to 1.7 times as fast, and the run says how "
            "much of the largest strain rounding takes: bodies that move far and tiny "
            "vibrations want double; contact, friction, supports, sums and energies are "
            "always in double");
  p.sweep.single_precision = precision == "single";
  keys.bind("Check time step", p.time.check_time_step,
            "Refuse a Time step above the critical one; false is for studies of unstable "
            "runs");
  keys.bind_input(
    "Continue from", p.time.continue_from,
    "Output folder of a run of the same body with Checkpoints/Write end = true, from "
    "whose end this run starts, at the time 0, with its motion and friction; ramps of "
    "Flat/Velocity and of the pressure on the top lead from its loads to those of this "
    "run, others are over; empty: the body starts at rest or with Body/Initial velocity");
  keys.only_with("Time step", {"auto"}, {"Safety factor"});
  keys.require(!(p.step.dt > p.time.end_time), "Time step",
               to_text(p.step.dt) + " s is longer than End time, " +
                 to_text(p.time.end_time) + " s");
}

void bind_friction(Keys &keys, FrictionParameters &friction, FrictionLaw &law)
{
  const auto section = keys.section("Friction");
  friction.bind(keys, law);
}

/** Checks keys that have no effect on a mesh, or only on a mesh. */
void check_mesh(const Keys &keys, const ContactParameters &p)
{
  keys.only_with("Analysis", {"transient", "modal", "static contact", "complex modes"},
                 {"Dimension", "Mesh/"});
  keys.only_if(!p.mesh.is_given(),
               {"Body/Stiffness", "Body/Density", "Body/Size", "Body/Cells", "Sides/"},
               "the body is a mesh", "remove Mesh/File");
  keys.only_if(p.mesh.is_plane_grid(), {"Performance/Temporal blocking"},
               "the body is no plane grid", "");
  keys.only_if(p.mesh.is_plane_grid(), {"Time/Precision"}, "the body is no plane grid",
               "");
  keys.only_if(!p.step.damps_by_phase(), {"Performance/Temporal blocking"},
               "runs with damping by phase go step by step", "");
  keys.only_if(std::none_of(p.supports.begin(), p.supports.end(),
                            [](const SideSupport &side) { return side.is_platen; }),
               {"Performance/Temporal blocking"},
               "runs with a platen at a side go step by step", "");
  const auto only_solver =
    p.mesh.is_given() ? StaticSolverKind::ml : StaticSolverKind::multigrid;
  keys.only_if(p.mesh.is_plane_grid() || p.static_solver == only_solver,
               {"Performance/Static solver"},
               p.mesh.is_given() ? "bodies on meshes are solved with ml"
                                 : "grids in 3D are solved with multigrid",
               "");
  const std::string held = p.mesh.mesh.dim == 2 ? "held in y" : "held in z";
  keys.require(
    p.modal_bottom == "free" || p.modal_bottom == "both" || p.modal_bottom == held,
    "Modal/Bottom",
    "it is '" + p.modal_bottom + "', but the normal of the flat is " + held.back() +
      " as Dimension is " + std::to_string(p.mesh.mesh.dim) + "; use '" + held + "'");
}

/** @p paths, plus the keys @p names of all sections of Supports. */
std::vector<std::string> and_of_supports(const Keys &keys,
                                         const std::vector<std::string> &names,
                                         std::vector<std::string> paths)
{
  for (const Key &key : keys.all())
    if (key.section.rfind("Supports/", 0) == 0 &&
        std::count(names.begin(), names.end(), key.name) > 0)
      paths.push_back(key.path());
  return paths;
}

/** Paths of the deviations of the constants of phases. */
std::vector<std::string> deviation_keys(const Keys &keys)
{
  std::vector<std::string> paths;
  for (const Key &key : keys.all())
    if (key.section.rfind("Phases/", 0) == 0 && key.name == "Relative deviation")
      paths.push_back(key.path());
  return paths;
}

/** Whether each point of a map has complex modes, too. */
bool computes_modes_too(const Keys &keys)
{
  const std::string of_map = "Sweep/Complex modes";
  return keys.has(of_map) && keys.value(of_map) == "true";
}

/** Checks which keys each analysis uses. */
void check_analysis(const Keys &keys)
{
  const bool has_modes_too = computes_modes_too(keys);
  const auto only_with     = [&](const std::vector<std::string> &analyses,
                             const std::vector<std::string> &paths) {
    if (!has_modes_too || analyses.back() != "complex modes")
      keys.only_with("Analysis", analyses, paths);
  };
  only_with(
    {"transient"},
    and_of_supports(keys, {"Ramp", "Ramp time", "Expression"},
                    {"Body/Initial velocity", "Time/End time", "Time/Time step",
                     "Time/Safety factor", "Time/Beta2", "Time/Precision",
                     "Time/Check time step", "Time/Continue from", "Flat/Ramp",
                     "Flat/Ramp time", "Flat/Expression", "Observation/", "Snapshots/",
                     "Contact map/", "Checkpoints/", "Performance/Temporal blocking",
                     "Performance/Instruction set"}));
  only_with({"transient", "complex modes"},
            {"Body/Rayleigh alpha", "Time/Rayleigh beta", "Friction/Law",
             "Friction/Regularization time", "Friction/Length",
             "Friction/Reference velocity", "Friction/Normal stress",
             "Friction/Normal stress time", "Friction/Normal stress length",
             "Friction/Normal stress velocity"});
  only_with({"transient", "static contact", "complex modes"},
            {"Friction/Coefficient law"});
  only_with({"transient", "modal", "complex modes"},
            and_of_supports(keys, {"Platen mass"}, {"Supports/Top/Hold from"}));
  only_with({"transient", "complex modes"}, and_of_supports(keys, {"Dashpot"}, {}));
  only_with({"transient", "static contact"},
            {"Flat/Profile", "Flat/Profile file", "Flat/Profile size",
             "Flat/Profile height", "Flat/Profile repeats"});
  only_with({"transient", "static contact", "complex modes"},
            and_of_supports(keys, {"Motion", "Pressure", "Traction"},
                            {"Body/Acceleration", "Flat/", "Friction/"}));
  only_with({"transient", "modal", "static contact", "complex modes"},
            {"Body/RVE file", "Body/Material", "Body/Stiffness from", "Body/Stiffness",
             "Body/Density", "Body/Size", "Body/Cells", "Supports/", "Sides/"});
  only_with({"modal", "static contact"}, {"Performance/Static solver"});
  only_with({"modal"}, {"Modal/"});
  only_with({"modal"}, deviation_keys(keys));
  only_with({"static contact", "complex modes"}, {"Static contact/"});
  keys.only_if(!keys.has_text("Sweep/Axes") || has_modes_too, {"Complex modes/"},
               "Sweep/Complex modes is false", "set it to true");
  only_with({"complex modes"}, {"Complex modes/"});
  only_with({"friction homogenization"}, {"Friction homogenization/"});
}
} // namespace

ContactParameters::ContactParameters()
{
  step.dt          = automatic;
  step.beta        = 4.4e-9;
  history_interval = probe_interval = 0; // auto
  energy_interval                   = 200;
  modal.tolerance                   = 1e-10;
}

void ContactParameters::bind(Keys &keys)
{
  keys.bind(
    "Analysis", analysis,
    {"transient", "modal", "static contact", "friction homogenization", "complex modes"},
    "What is computed: sliding in time, vibration modes, equilibrium on the flat, an "
    "equivalent friction law, or the vibrations of steady sliding that grow");
  mesh.bind(keys);
  bind_body(keys, *this);
  bind_time(keys, *this);
  bind_loads(keys);
  bind_top(keys);
  bind_sides(keys);
  bind_periodicity(keys);
  keys.renamed("Top/", "Supports/Top/");
  keys.renamed("Top/Lateral held", "Supports/Top/Held = u_x");
  bind_friction(keys, friction, contact.law);
  bind_observation(keys);
  bind_contact_map(keys);
  bind_analyses(keys);
  keys.renamed("Performance/Static solver = assembled", "ml");
  keys.require(
    !contact.slips_on_springs() || friction.law_name != "slip rate", "Friction/Law",
    "it is slip rate, which knows no Flat/Tangential stiffness; use coulomb or "
    "constant time");
  keys.only_if(analysis != ContactAnalysis::static_contact ||
                 contact.flat_velocity.amplitude() == 0.,
               {"Flat/Tangential stiffness"},
               "all nodes slide, as Flat/Velocity is not 0", "set Flat/Velocity = 0");
  std::string on_springs = contact.is_compliant()       ? "Flat/Normal stiffness"
                           : contact.slips_on_springs() ? "Flat/Tangential stiffness"
                                                        : "";
  for (const SideSupport *side : suspended())
    if (side->suspension.has_springs() && on_springs.empty())
      on_springs = side->key("Spring stiffness");
  for (const SideSupport &side : supports)
    if (side.is_platen && on_springs.empty())
      on_springs = side.key("Kind = platen");
  if (mesh.is_plane_grid() && !on_springs.empty())
    {
      keys.only_if(static_solver == StaticSolverKind::ml, {"Performance/Static solver"},
                   on_springs +
                     " is set, and ml alone knows springs and platens at the sides",
                   "set it to ml");
      static_solver = StaticSolverKind::ml;
    }
  check_analysis(keys);
  check_mesh(keys, *this);
  bind_counter(keys);
  keys.only_if(!counter, deviation_keys(keys),
               "there is a Counter body, with which deviations are not known", "");
  if (analysis == ContactAnalysis::transient ||
      analysis == ContactAnalysis::static_contact ||
      analysis == ContactAnalysis::complex_modes)
    make_coefficient_law(keys);
  if (!keys.are_read())
    return;
  contact.profile = profile.make(mesh.mesh.dim);
  check_contact_map(keys);
  continue_run(keys);
}

/** For a run that continues another run: checks its keys; ramps at sides are over. */
void ContactParameters::continue_run(const Keys &keys)
{
  if (time.continue_from.empty())
    return;
  const std::string key = "Time/Continue from";
  keys.only_if(false, {"Body/Initial velocity"}, key + " has another run's", "");
  keys.require(!counter, key, "it knows no Counter body");
  keys.require(!contact.profile, key,
               "it knows no Flat/Profile, whose place at the end of a run is not kept");
  bool depends_on_time = contact.flat_velocity.is_expression() ||
                         top.hold_from < std::numeric_limits<double>::infinity();
  const auto look = [&](const LoadHistory &pressure, const Suspension &suspension) {
    depends_on_time = depends_on_time || pressure.is_expression();
    for (unsigned int c = 0; c < 3; ++c)
      depends_on_time = depends_on_time || suspension.motion[c].is_expression() ||
                        suspension.traction.varies_in_time(c);
  };
  look(top.pressure, top.suspension);
  for (SideSupport &support : supports)
    {
      look(support.pressure, support.suspension);
      if (!support.pressure.is_expression())
        support.pressure = LoadHistory(support.pressure.amplitude());
    }
  keys.require(
    !depends_on_time, key,
    "a load or a support depends on time (an Expression, a Motion, a Traction or "
    "Hold from), which begins again at 0; leave it constant");
}
} // namespace mesoslip
