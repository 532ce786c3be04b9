#include "sliding/contact_parameters.h"

#include "base/errors.h"
#include "parameters/keys.h"

#include <cmath>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** Upper end of the range of whole numbers that only the machine limits. */
constexpr long most_steps_or_cells = 1000000000;

/** x and y, or nothing. */
std::array<double, 2> pair(const std::string &key, const std::vector<double> &values)
{
  if (values.size() == 1)
    throw UserError(key + ": one number found, two (x, y) are needed");
  return values.empty() ? std::array<double, 2>{}
                        : std::array<double, 2>{{values[0], values[1]}};
}

void bind(Keys &keys, BodyParameters &body)
{
  const auto section = keys.section("Body");
  std::vector<double> size;
  std::vector<long> cells;
  keys.bind("Material", body.heterogeneous, {"homogeneous", "heterogeneous"},
            "One effective material, or the phases and the morphology of the RVE file");
  keys.bind_input("RVE file", body.rve_file,
                  "rve.h5 of rve_homogenization; empty: the material typed in below");
  keys.bind("Stiffness from", body.stiffness_name, {"effective", "KUBC", "SUBC", "PBC"},
            "Which stiffness of the RVE file a homogeneous body takes");
  keys.bind_list(
    "Stiffness", body.stiffness, Range::stiffness(),
    "Without RVE file: D11, D12, D22, D33, or all six D11, D12, D13, D22, D23, "
    "D33; Voigt order xx, yy, xy, plane strain; default eq. (10) [Pa]",
    4, 6);
  keys.bind("Density", body.density, Range::density(),
            "Density without RVE file [kg/m^3]");
  keys.bind_list(
    "Size", size, Range::length(),
    "Width and height; empty: those of the RVE file, or the paper's 56 x 16 mm [m]", 0,
    2);
  keys.bind_list("Cells", cells, 1, most_steps_or_cells,
                 "Cells along x and y; empty: those of the RVE file, or 560, 160. A "
                 "heterogeneous body may have whole multiples of the RVE's [-]",
                 0, 2);
  keys.bind("Initial velocity", body.initial_velocity, Range::any(),
            "Velocity of the whole body at the start [m/s]");
  keys.bind("Acceleration", body.acceleration, Range::any(),
            "Body acceleration, gravity [m/s^2]");
  body.size = pair("Body/Size", size);
  const auto numbers =
    pair("Body/Cells", std::vector<double>(cells.begin(), cells.end()));
  for (unsigned int d = 0; d < 2; ++d)
    body.cells[d] = static_cast<unsigned int>(numbers[d]);
}

void bind(Keys &keys, TimeParameters &time)
{
  const auto section = keys.section("Time");
  keys.bind("End time", time.end_time, Range::positive(), "Simulated time [s]");
  keys.bind_or_auto("Time step", time.time_step, Range::positive(),
                    "auto: Safety factor times the critical one [s]");
  keys.bind("Safety factor", time.safety, Range::left_open(0., 1.),
            "Share of the critical time step that auto takes [-]");
  keys.bind("Beta2", time.beta2, Range::closed(0.5, 1.),
            "beta2 of the scheme: 1/2 leapfrog, above it dissipates high frequencies "
            "[-]");
  keys.bind("Rayleigh beta", time.beta, Range::non_negative(),
            "Stiffness-proportional damping, C = beta K [s]");
  keys.bind("Check time step", time.check_time_step,
            "Refuse a time step above the critical one (false: for stability studies)");
}

/** The key of an amplitude is bound already. */
LoadHistory bind_history(Keys &keys,
                         const double amplitude,
                         const std::string &what,
                         const std::string &unit)
{
  Ramp ramp   = Ramp::step;
  double time = 0.;
  std::string expression;
  keys.bind("Ramp", ramp, {"step", "linear", "smooth"},
            "How the " + what + " grows from zero");
  keys.bind("Ramp time", time, Range::non_negative(), "Duration of the ramp [s]");
  keys.bind("Expression", expression,
            "The " + what +
              " as an expression in the time t (s), instead of a ramp, e.g. "
              "2*cos(2*pi*1000*t) [" +
              unit + "]");
  if (expression.empty())
    return {amplitude, ramp, time};
  try
    {
      return {amplitude, expression};
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(keys.path("Expression") + ": " + e.what() +
                      "; write for example 2*cos(2*pi*1000*t)");
    }
}

void bind_flat(Keys &keys, FrictionParameters &friction)
{
  const auto section = keys.section("Flat");
  double velocity    = 2.;
  keys.bind("Velocity", velocity, Range::any(),
            "Velocity of the rigid flat along x [m/s]");
  friction.flat_velocity = bind_history(keys, velocity, "velocity", "m/s");
  keys.bind("Gap", friction.gap, Range::non_negative(),
            "Distance between the body and the flat at the start [m]");
}

void bind(Keys &keys, TopSetup &top)
{
  const auto section = keys.section("Top");
  double pressure = 5e6, hold_from = automatic;
  keys.bind("Kind", top.kind, {"pressure", "platen", "held"},
            "A pressure on each node; a rigid platen (u_x = 0, one common u_y) pushed by "
            "the pressure's resultant; or u = 0");
  keys.bind("Pressure", pressure, Range::any(), "Pressure on the top [Pa]");
  top.pressure = bind_history(keys, pressure, "pressure", "Pa");
  keys.bind("Lateral held", top.lateral_held,
            "With a pressure: u_x = 0 on the top, as under a platen");
  keys.bind("Platen mass", top.platen_mass, Range::non_negative(),
            "Mass of the platen itself, per unit thickness [kg/m]");
  keys.bind_or_auto("Hold from", hold_from, Range::non_negative(),
                    "From this time on the top stays where it is; auto: never [s]");
  if (!std::isnan(hold_from))
    top.hold_from = hold_from;
}

void bind_sides(Keys &keys, ContactParameters &parameters)
{
  const auto section  = keys.section("Sides");
  const auto bind_one = [&](const std::string &key, const std::string &side,
                            std::array<bool, 2> &held) {
    std::string value = "free";
    keys.bind(key, value, {"free", "u_x", "u_y", "both"},
              "Displacement that is held on the " + side);
    held = {{value == "u_x" || value == "both", value == "u_y" || value == "both"}};
  };
  bind_one("Left", "left", parameters.sides.left_held);
  bind_one("Right", "right", parameters.sides.right_held);
  keys.bind("Periodic", parameters.periodic, "The left and the right side are one");
}

void bind_friction(Keys &keys, FrictionParameters &friction)
{
  const auto section = keys.section("Friction");
  double length = 3e-6, reference_velocity = 1e-3;
  keys.bind("Law", friction.law_name, {"coulomb", "constant time", "slip rate"},
            "Plain Coulomb; relaxing to it in a constant time delta (eq. 7); or in "
            "L / (|V_rel| + V_ref)");
  keys.bind("Coefficient from", friction.coefficient_by_phase, {"constant", "phases"},
            "One coefficient, or those of the phases in the RVE file (section 4)");
  keys.bind("Coefficient", friction.coefficient, Range::non_negative(),
            "Coulomb friction coefficient mu [-]");
  keys.bind("Regularization time", friction.law.time, Range::non_negative(),
            "delta of eq. (7); 0 is plain Coulomb [s]");
  keys.bind("Length", length, Range::positive(), "L of the slip-rate law [m]");
  keys.bind("Reference velocity", reference_velocity, Range::positive(),
            "V_ref of the slip-rate law [m/s]");
  keys.bind(
    "Node rule", friction.node_rule, {"stiffness", "mean", "largest", "smallest"},
    "Coefficient of a node between cells of two phases: their mean weighted with the "
    "stiffness D22, as the pressure is shared, the plain mean, or one of the two");
  if (friction.law_name == "coulomb")
    friction.law.time = 0.;
  if (friction.law_name == "slip rate")
    {
      friction.slip_length        = length;
      friction.reference_velocity = reference_velocity;
      friction.law.node_law =
        std::make_shared<SlipRateRegularization>(length, reference_velocity);
    }
}

void bind_probes(Keys &keys,
                 const std::vector<std::string> &names,
                 std::vector<ProbeParameters> &probes)
{
  for (const std::string &name : names)
    {
      const auto section = keys.section(name);
      ProbeParameters probe;
      std::vector<double> position;
      probe.name = name;
      keys.bind_list("Position", position, Range::any(),
                     "x and y from the lower left corner; has to be given [m]", 0, 2);
      keys.bind("Nearest node", probe.nearest_node, "Move the probe to the nearest node");
      if (keys.are_read() && position.empty())
        throw UserError(keys.path("Position") +
                        " is missing; give x and y of the probe from the lower left "
                        "corner in m, in a subsection " +
                        name);
      probe.position = pair(keys.path("Position"), position);
      probes.push_back(probe);
    }
}

void bind(Keys &keys, ObservationParameters &o)
{
  {
    const auto section = keys.section("Observation");
    std::vector<std::string> probes;
    keys.bind("History interval", o.history_interval, 1, most_steps_or_cells,
              "Steps between samples of the histories in dynamics.h5; statistics and "
              "spectrum have samples of their own [-]");
    keys.bind("Energy interval", o.energy_interval, 0, most_steps_or_cells,
              "Steps between energy balances; 1: exact to round-off, 0: none [-]");
    keys.bind("Blocks", o.blocks, 1, 100000,
              "Time blocks in which stick, slip and separation of each contact node are "
              "counted [-]");
    keys.bind_or_auto("Steady from", o.steady_from, Range::non_negative(),
                      "Start of the steady part; auto: that of the limit cycle, or "
                      "half of the run without one [s]");
    keys.bind_or_auto("Reference x", o.reference_x, Range::any(),
                      "Position of the reference contact node M; auto: the middle [m]");
    keys.bind("Stop at limit cycle", o.stop_at_limit_cycle,
              "Ends the run when the second half of it was a limit cycle");
    keys.bind("Limit cycle tolerance", o.limit_cycle_tolerance, Range::positive(),
              "Largest relative difference among the windows of a limit cycle [-]");
    keys.bind("Limit cycle periods", o.limit_cycle_periods, 1, 1000,
              "Periods that a window has at least [-]");
    keys.bind("Limit cycle windows", o.limit_cycle_windows, 2, 1000,
              "Equal windows, together the second half of the run, that have to agree "
              "[-]");
    keys.bind_names("Probes", probes, "probe", "Names of probes, each with a subsection");
    keys.bind("Probe interval", o.probe_interval, 1, most_steps_or_cells,
              "Steps between samples of the probes [-]");
    bind_probes(keys, probes, o.probes);
  }
  const auto section = keys.section("Snapshots");
  keys.bind("From", o.snapshots_from, Range::non_negative(), "First snapshot [s]");
  keys.bind_or_auto("To", o.snapshots_to, Range::non_negative(),
                    "Last snapshot; auto: the end [s]");
  keys.bind("Interval", o.snapshots_interval, Range::non_negative(),
            "Time between snapshots of the displacement; 0: none [s]");
}

void bind(Keys &keys, ModalParameters &modal)
{
  const auto section = keys.section("Modal");
  keys.bind("Number of modes", modal.n_modes, 1, 1000, "Lowest modes wanted [-]");
  keys.bind("Bottom", modal.bottom, {"free", "held in y", "both"},
            "The paper's boundary conditions BC1 (free) and BC2 (held in y); the top is "
            "that of section Top at the start of a run");
  keys.bind("Tolerance", modal.tolerance, Range::open(0., 1.),
            "Relative residual of the static solves within the Lanczos iteration [-]");
}

void bind(Keys &keys, StaticContactParameters &statics)
{
  const auto section = keys.section("Static contact");
  keys.bind("Tolerance", statics.tolerance, Range::open(0., 1.),
            "Of equilibrium and of the friction forces, relative to the contact force "
            "[-]");
  keys.bind("Iterations", statics.max_iterations, 1, 100000,
            "Limit for contact states and friction [-]");
}

void bind(Keys &keys, FrictionHomogenizationParameters &p)
{
  const auto section = keys.section("Friction homogenization");
  keys.bind_input("Heterogeneous run", p.heterogeneous_run,
                  "Output folder of a transient run of the heterogeneous body");
  keys.bind_input("Homogeneous run", p.homogeneous_run,
                  "Output folder of a transient run of the homogeneous body, for T_G; "
                  "empty: T_G of the heterogeneous one");
  keys.bind_input("Static contact", p.static_contact,
                  "Output folder of a static contact analysis, for the phases' "
                  "pressures; empty: the static pressure repartition of eq. (19)");
  keys.bind("Pressures from", p.pressures,
            {"auto", "static contact", "surface fractions", "volume fractions",
             "nodes in static contact", "nodes"},
            "Pressures for mu_homo, eq. (17): of the phases in a static contact analysis "
            "(auto: if named), or by eq. (19) with their fractions of the contact line "
            "(auto) or the volume; or of the contact nodes, with their own coefficients");
  keys.bind(
    "Calibrate", p.calibrate,
    "Take from eq. (13) only the ratio of mu_inter between two delta and start from "
    "the homogeneous run's; false: invert it as it stands");
}

void bind(Keys &keys, CheckpointParameters &checkpoints)
{
  const auto section = keys.section("Checkpoints");
  double minutes     = 5.;
  keys.bind("Interval", minutes, Range::non_negative(),
            "Time on the clock between checkpoints of a transient run, which --resume "
            "continues; 0: only when the run is stopped [min]");
  keys.bind(
    "Keep", checkpoints.keep,
    "Keep the state when the run is complete, so that --resume goes on to a later "
    "End time");
  checkpoints.interval = 60. * minutes;
}
} // namespace

void ContactParameters::bind(Keys &keys)
{
  keys.bind("Analysis", analysis,
            {"transient", "modal", "static contact", "friction homogenization"},
            "What is computed");
  mesoslip::bind(keys, body);
  mesoslip::bind(keys, time);
  bind_flat(keys, friction);
  mesoslip::bind(keys, top);
  bind_sides(keys, *this);
  bind_friction(keys, friction);
  mesoslip::bind(keys, observation);
  mesoslip::bind(keys, modal);
  mesoslip::bind(keys, static_contact);
  mesoslip::bind(keys, homogenization);
  mesoslip::bind(keys, checkpoints);
  const auto section = keys.section("Performance");
  keys.bind("Wavefront", wavefront, 0, 64,
            "Time steps in flight on grids larger than the cache; 0: automatic, 1: none. "
            "Never changes a result [-]");
  keys.bind("Instruction set", instruction_set,
            {"auto", "x86-64", "x86-64-v3", "x86-64-v4", "generic"},
            "Kernels to use; auto: the widest the processor has; generic: those of "
            "processors other than x86-64");
  keys.bind("Static solver", static_solver, {"multigrid", "jacobi", "ml"},
            "Of the modal and the static contact analysis, as Homogenization/Solver");
}
} // namespace mesoslip
