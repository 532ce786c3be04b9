#include "simulation/contact_declarations.h"

namespace mesoslip
{
void declare_observation(dealii::ParameterHandler &prm, const RawParameters &raw)
{
  {
    const ParameterSection section(prm, "Observation");
    declare_integer(
      prm, "History interval", 10, 1, most_steps_or_cells,
      "Steps between samples of the histories in dynamics.h5; statistics and "
      "spectrum have samples of their own [-]");
    declare_integer(prm, "Energy interval", 200, 0, most_steps_or_cells,
                    "Steps between energy balances; 1: exact to round-off, 0: none [-]");
    declare_integer(
      prm, "Blocks", 200, 1, 100000,
      "Time blocks in which stick, slip and separation of each contact node are "
      "counted [-]");
    declare_double_or_auto(prm, "Steady from", "auto", Range::non_negative(),
                           "Start of the steady part; auto: that of the limit cycle, or "
                           "half of the run without one [s]");
    declare_double_or_auto(
      prm, "Reference x", "auto", Range::any(),
      "Position of the reference contact node M; auto: the middle [m]");
    declare_bool(prm, "Stop at limit cycle", false,
                 "Ends the run when the second half of it was a limit cycle");
    declare_double(prm, "Limit cycle tolerance", 0.02, Range::positive(),
                   "Largest relative difference among the windows of a limit cycle [-]");
    declare_integer(prm, "Limit cycle periods", 3, 1, 1000,
                    "Periods that a window has at least [-]");
    declare_integer(
      prm, "Limit cycle windows", 3, 2, 1000,
      "Equal windows, together the second half of the run, that have to agree [-]");
    declare_word_list(prm, "Probes", {}, {}, "Names of probes, each with a subsection");
    declare_integer(prm, "Probe interval", 10, 1, most_steps_or_cells,
                    "Steps between samples of the probes [-]");
    for (const std::string &name : raw.section_names("Observation/Probes", {}, "probe"))
      {
        const ParameterSection probe(prm, name);
        declare_double_list(prm, "Position", {}, Range::any(),
                            "x and y from the lower left corner; has to be given [m]", 0,
                            2);
        declare_bool(prm, "Nearest node", false, "Move the probe to the nearest node");
      }
  }
  const ParameterSection section(prm, "Snapshots");
  declare_double(prm, "From", 0., Range::non_negative(), "First snapshot [s]");
  declare_double_or_auto(prm, "To", "auto", Range::non_negative(),
                         "Last snapshot; auto: the end [s]");
  declare_double(prm, "Interval", 0., Range::non_negative(),
                 "Time between snapshots of the displacement; 0: none [s]");
}

void declare_checkpoints(dealii::ParameterHandler &prm)
{
  const ParameterSection section(prm, "Checkpoints");
  declare_double(
    prm, "Interval", 5., Range::non_negative(),
    "Time on the clock between checkpoints of a transient run, which --resume continues; "
    "0: only when the run is stopped [min]");
  declare_bool(
    prm, "Keep", false,
    "Keep the state (and twice the space of the snapshots) when the run is complete, so "
    "that --resume goes on to a later End time");
}

void declare_other_analyses(dealii::ParameterHandler &prm)
{
  {
    const ParameterSection section(prm, "Modal");
    declare_integer(prm, "Number of modes", 4, 1, 1000, "Lowest modes wanted [-]");
    declare_selection(
      prm, "Bottom", "both", {"free", "held in y", "both"},
      "The paper's boundary conditions BC1 (free) and BC2 (held in y); the top is that "
      "of section Top at the start of a run");
    declare_double(
      prm, "Tolerance", 1e-10, Range::open(0., 1.),
      "Relative residual of the static solves within the Lanczos iteration [-]");
  }
  {
    const ParameterSection section(prm, "Static contact");
    declare_double(
      prm, "Tolerance", 1e-8, Range::open(0., 1.),
      "Of equilibrium and of the friction forces, relative to the contact force [-]");
    declare_integer(prm, "Iterations", 200, 1, 100000,
                    "Limit for contact states and friction [-]");
  }
  const ParameterSection section(prm, "Friction homogenization");
  declare_input_file(prm, "Heterogeneous run", "",
                     "Output folder of a transient run of the heterogeneous body");
  declare_input_file(
    prm, "Homogeneous run", "",
    "Output folder of a transient run of the homogeneous body, for T_G; empty: "
    "T_G of the heterogeneous one");
  declare_input_file(
    prm, "Static contact", "",
    "Output folder of a static contact analysis, for the phases' pressures; "
    "empty: the static pressure repartition of eq. (19)");
  declare_selection(
    prm, "Pressures from", "auto",
    {"auto", "static contact", "surface fractions", "volume fractions",
     "nodes in static contact", "nodes"},
    "Pressures for mu_homo, eq. (17): of the phases in a static contact analysis "
    "(auto: if named), or by eq. (19) with their fractions of the contact line "
    "(auto) or the volume; or of the contact nodes, with their own coefficients");
  declare_bool(
    prm, "Calibrate", false,
    "Take from eq. (13) only the ratio of mu_inter between two delta and start from "
    "the homogeneous run's; false: invert it as it stands");
}
} // namespace mesoslip
