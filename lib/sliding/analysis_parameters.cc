#include "base/text.h"
#include "parameters/keys.h"
#include "sliding/contact_parameters.h"
#include "sliding/keys/body_keys.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Upper end of the range of whole numbers of time steps. */
constexpr long most_steps = 1000000000;

void bind_statics(Keys &keys, ContactParameters &p)
{
  {
    const auto section = keys.section("Modal");
    keys.bind("Number of modes", p.modal.n_modes, 1, 1000,
              "Number of vibration modes wanted, from the lowest frequency on [-]");
    keys.bind(
      "Bottom", p.modal_bottom, {"free", "held in y", "held in z", "both"},
      "Support of the bottom: free (BC1 of the paper), u_y = 0 (BC2; in 3D u_z = 0), or "
      "one after the other; the top is that of Supports/Top at the start of a run");
    keys.bind("Tolerance", p.modal.tolerance, Range::open(0., 1.),
              "Relative residual of the static solves within the Lanczos iteration [-]");
    keys.bind("Derivatives", p.modal_derivatives,
              "Write the derivatives of the frequencies with respect to the stiffness of "
              "each phase to frequency_derivatives.csv");
  }
  const auto section = keys.section("Static contact");
  keys.bind("Tolerance", p.static_contact.tolerance, Range::open(0., 1.),
            "Residual of equilibrium and change of the friction forces at which the "
            "iteration ends, relative to the contact force [-]");
  keys.bind("Iterations", p.static_contact.max_iterations, 1, 100000,
            "Largest number of iterations over contact states and friction forces [-]");
  StaticLoadParameters &load = p.static_load;
  keys.bind(
    "Load steps", load.steps, 1, 100000,
    "Increments in which the loads grow, and then those of "
    "Flat displacement; friction opposes the displacement since the last one [-]");
  keys.bind_list("Flat displacement", load.of_flat, Range::any(),
                 "Displacement of the flat along x and, in 3D, y under the "
                 "whole load of the top; empty: none [m]",
                 0, 2);
  keys.require(load.of_flat.size() < 2 || p.mesh.mesh.dim == 3, "Flat displacement",
               "it has two components, but Dimension is 2");
  keys.require(
    !load.moves_flat() || p.contact.flat_velocity.amplitude() == 0., "Flat displacement",
    "the flat slides with Flat/Velocity, which is not 0; set one of them to 0");
}

void bind_homogenization(Keys &keys, FrictionHomogenizationParameters &p)
{
  const auto section = keys.section("Friction homogenization");
  keys.bind_input("Heterogeneous run", p.heterogeneous_run,
                  "Output folder of a transient run of the heterogeneous body");
  keys.bind_input(
    "Homogeneous run", p.homogeneous_run,
    "Output folder of a transient run of the homogeneous body, for the mean "
    "duration T_G of contacts; empty: T_G of the heterogeneous run");
  keys.bind_input(
    "Static contact", p.static_contact,
    "Output folder of a static contact analysis, for the contact pressures of "
    "the phases; empty: the static pressure repartition of eq. (19)");
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

void bind_control(Keys &keys, ContactParameters &p)
{
  {
    const auto section = keys.section("Checkpoints");
    double minutes     = p.checkpoints.interval / 60.;
    keys.bind(
      "Interval", minutes, Range::non_negative(),
      "Wall-clock time between checkpoints of a transient run, from which --resume "
      "goes on; 0: only when the run is stopped [min]");
    keys.bind(
      "Keep", p.checkpoints.keep,
      "Keep the checkpoint when the run is complete, so that --resume goes on to a "
      "later End time");
    keys.bind("Write end", p.checkpoints.end,
              "Write the motion at the end of the run, from which another run may start "
              "(Time/Continue from)");
    p.checkpoints.interval = 60. * minutes;
  }
  const auto section   = keys.section("Performance");
  std::string set_name = "auto";
  keys.renamed("Wavefront", "Temporal blocking");
  keys.bind("Temporal blocking", p.sweep.steps_at_once, 0, 64,
            "Time steps that are done in one sweep over the grid (temporal blocking) on "
            "grids larger than the cache; 0: automatic, 1: none. Never changes a result "
            "[-]");
  keys.bind(
    "Instruction set", set_name, {"auto", "x86-64", "x86-64-v3", "x86-64-v4", "generic"},
    "Instruction set of the kernels; auto: the widest the processor has; generic: "
    "that of processors other than x86-64");
  keys.bind("Static solver", p.static_solver, {"multigrid", "jacobi", "ml"},
            "Linear solver of the modal and the static contact analysis, as "
            "Homogenization/Solver of rve_homogenization");
  p.sweep.isa = instruction_set(set_name);
}
} // namespace

void ContactParameters::bind_observation(Keys &keys)
{
  ObservationParameters &o = observation;
  {
    const auto section = keys.section("Observation");
    keys.bind_or_auto(
      "History interval", history_interval, most_steps,
      "Time steps between samples of the histories in dynamics.h5; auto: as many as "
      "between those of statistics and spectrum, six while a wave crosses the body, but "
      "10 at most [-]");
    keys.bind(
      "Energy interval", energy_interval, 0, most_steps,
      "Time steps between samples of the energy balance, which closes to round-off "
      "with 1 only; 0: none [-]");
    keys.bind("Blocks", o.blocks, 1, 100000,
              "Number of equal parts of the run in which the time that each contact node "
              "sticks, slips or is separated is counted [-]");
    keys.bind_or_auto("Steady from", o.steady_from, Range::non_negative(),
                      "Time at which the statistics begin; auto: when the limit cycle "
                      "begins, or half of the run without one [s]");
    keys.bind_or_auto("Reference x", o.reference_x, Range::any(),
                      "Position of the reference node, whose motion gives spectrum and "
                      "regime; auto: the middle [m]");
    keys.bind("Stop at limit cycle", o.stop_at_limit_cycle,
              "End the run before End time when its second half was a limit cycle");
    keys.bind("Limit cycle tolerance", o.limit_cycle.tolerance, Range::positive(),
              "Largest relative difference among the windows of a limit cycle [-]");
    keys.bind("Limit cycle periods", o.limit_cycle.periods, 1, 1000,
              "Periods of the main frequency that a window has at least [-]");
    keys.bind(
      "Limit cycle windows", o.limit_cycle.windows, 2, 1000,
      "Number of equal windows, together the second half of the run, that have to "
      "agree [-]");
    keys.bind("Contact means", o.contact_means,
              "Mean pressure and friction work of every contact node, of every step and "
              "over the blocks");
    o.probes = bind_probes(keys, "Observation", mesh.mesh.dim);
    keys.bind_or_auto("Probe interval", probe_interval, most_steps,
                      "Time steps between samples of the probes; auto: as for History "
                      "interval [-]");
    // Switching off probes or snapshots of a complete file must not make the remaining
    // keys errors.
    keys.only_if(keys.is_typed("Observation/Probes") ||
                   keys.is_typed("Counter body/Observation/Probes"),
                 {"Probe interval"}, "there are no probes",
                 "name some in Observation/Probes");
  }
  const auto section = keys.section("Snapshots");
  keys.bind("From", o.snapshots_from, Range::non_negative(),
            "Time of the first snapshot [s]");
  keys.bind_or_auto(
    "To", o.snapshots_to, Range::non_negative(),
    "Time of the last snapshot; auto: the end of the run, whose last state is one "
    "time step before Time/End time [s]");
  keys.bind("Interval", o.snapshots_interval, Range::non_negative(),
            "Time between snapshots of the displacement of all nodes, which "
            "stress_localization needs; 0: none [s]");
  keys.only_if(keys.is_typed("Snapshots/Interval"), {"From", "To"},
               "Snapshots/Interval is 0 and there are no snapshots",
               "set Snapshots/Interval");
}

bool ContactParameters::wants_node_loads() const
{
  const bool mapped =
    std::find(map.fields.begin(), map.fields.end(), "friction work") != map.fields.end();
  return observation.contact_means || (map.interval > 0. && mapped);
}

void ContactParameters::bind_contact_map(Keys &keys)
{
  const auto section = keys.section("Contact map");
  keys.bind("Interval", map.interval, Range::non_negative(),
            "Time between samples of all contact nodes in dynamics.h5, rounded to whole "
            "time steps; 0: none [s]");
  keys.bind("From", map.from, Range::non_negative(), "Time of the first sample [s]");
  keys.bind_or_auto("To", map.to, Range::non_negative(),
                    "Time of the last sample; auto: the end of the run [s]");
  keys.bind_list(
    "Fields", map.fields, map_field_names(),
    "What is sampled: pressure and tangential traction on the tributary area "
    "(Pa), velocity of the flat relative to the node (m/s), state (0 "
    "separated, 1 stick, 2 slip), the friction work since the start "
    "(J/m^2), which is summed up in every step, the state of the Coefficient law (slip, "
    "m, or theta, s), the pressure that friction remembers with Normal stress (Pa), and "
    "the "
    "gap between node and flat (m)");
  keys.only_if(keys.is_typed("Contact map/Interval"), {"From", "To", "Fields"},
               "Contact map/Interval is 0 and there is no map",
               "set Contact map/Interval");
  keys.require(!map.fields.empty(), "Fields",
               "it is empty; name one at least, or set Interval = 0");
}

void ContactParameters::bind_analyses(Keys &keys)
{
  bind_statics(keys, *this);
  bind_homogenization(keys, homogenization);
  complex_modes.bind(keys);
  bind_control(keys, *this);
}
} // namespace mesoslip
