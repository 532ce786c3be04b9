#include "simulation/contact_declarations.h"

#include "simulation/contact_parameters.h"

namespace mesoslip
{
namespace
{
using Handler = dealii::ParameterHandler;

void declare_body(Handler &prm)
{
  const ParameterSection section(prm, "Body");
  declare_selection(
    prm, "Material", "homogeneous", {"homogeneous", "heterogeneous"},
    "One effective material, or the phases and the morphology of the RVE file");
  declare_input_file(prm, "RVE file", "",
                     "rve.h5 of rve_homogenization; empty: the material typed in below");
  declare_selection(prm, "Stiffness from", "effective",
                    {"effective", "KUBC", "SUBC", "PBC"},
                    "Which stiffness of the RVE file a homogeneous body takes");
  declare_double_list(
    prm, "Stiffness", {36.54e9, 9.1e9, 47.26e9, 13.785e9}, Range::stiffness(),
    "Without RVE file: D11, D12, D22, D33, or all six D11, D12, D13, D22, D23, "
    "D33; Voigt order xx, yy, xy, plane strain; default eq. (10) [Pa]",
    4, 6);
  declare_double(prm, "Density", 1770., Range::density(),
                 "Density without RVE file [kg/m^3]");
  declare_double_list(
    prm, "Size", {}, Range::length(),
    "Width and height; empty: those of the RVE file, or the paper's 56 x 16 mm [m]", 0,
    2);
  declare_integer_list(
    prm, "Cells", {}, 1, most_steps_or_cells,
    "Cells along x and y; empty: those of the RVE file, or 560, 160. A "
    "heterogeneous body may have whole multiples of the RVE's [-]",
    0, 2);
  declare_double_list(prm, "Initial velocity", {0., 0.}, Range::any(),
                      "Velocity of the whole body at the start [m/s]", 2, 2);
  declare_double_list(prm, "Acceleration", {0., 0.}, Range::any(),
                      "Body acceleration, gravity [m/s^2]", 2, 2);
}

void declare_time(Handler &prm)
{
  const ParameterSection section(prm, "Time");
  declare_double(prm, "End time", 5e-4, Range::positive(), "Simulated time [s]");
  declare_double_or_auto(prm, "Time step", "auto", Range::positive(),
                         "auto: Safety factor times the critical one [s]");
  declare_double(prm, "Safety factor", 0.95, Range::left_open(0., 1.),
                 "Share of the critical time step that auto takes [-]");
  declare_double(
    prm, "Beta2", 0.5, Range::closed(0.5, 1.),
    "beta2 of the scheme: 1/2 leapfrog, above it dissipates high frequencies [-]");
  declare_double(prm, "Rayleigh beta", 4.4e-9, Range::non_negative(),
                 "Stiffness-proportional damping, C = beta K [s]");
  declare_bool(
    prm, "Check time step", true,
    "Refuse a time step above the critical one (false: for stability studies)");
}

void declare_ramp(Handler &prm, const std::string &what, const std::string &unit)
{
  declare_selection(prm, "Ramp", "step", {"step", "linear", "smooth"},
                    "How the " + what + " grows from zero");
  declare_double(prm, "Ramp time", 0., Range::non_negative(), "Duration of the ramp [s]");
  declare_string(prm, "Expression", "",
                 "The " + what +
                   " as an expression in the time t (s), instead of a ramp, e.g. "
                   "2*cos(2*pi*1000*t) [" +
                   unit + "]");
}

void declare_flat(Handler &prm)
{
  const ParameterSection section(prm, "Flat");
  declare_double(prm, "Velocity", 2., Range::any(),
                 "Velocity of the rigid flat along x [m/s]");
  declare_ramp(prm, "velocity", "m/s");
  declare_double(prm, "Gap", 0., Range::non_negative(),
                 "Distance between the body and the flat at the start [m]");
}

void declare_top(Handler &prm)
{
  const ParameterSection section(prm, "Top");
  declare_selection(
    prm, "Kind", "platen", {"pressure", "platen", "held"},
    "A pressure on each node; a rigid platen (u_x = 0, one common u_y) pushed by "
    "the pressure's resultant; or u = 0");
  declare_double(prm, "Pressure", 5e6, Range::any(), "Pressure on the top [Pa]");
  declare_ramp(prm, "pressure", "Pa");
  declare_bool(prm, "Lateral held", false,
               "With a pressure: u_x = 0 on the top, as under a platen");
  declare_double(prm, "Platen mass", 0., Range::non_negative(),
                 "Mass of the platen itself, per unit thickness [kg/m]");
  declare_double_or_auto(prm, "Hold from", "auto", Range::non_negative(),
                         "From this time on the top stays where it is; auto: never [s]");
}

void declare_sides(Handler &prm)
{
  const ParameterSection section(prm, "Sides");
  const std::vector<std::string> choices = {"free", "u_x", "u_y", "both"};
  declare_selection(prm, "Left", "free", choices,
                    "Displacement that is held on the left");
  declare_selection(prm, "Right", "free", choices,
                    "Displacement that is held on the right");
  declare_bool(prm, "Periodic", false, "The left and the right side are one");
}

void declare_friction(Handler &prm)
{
  const ParameterSection section(prm, "Friction");
  declare_selection(
    prm, "Law", "constant time", {"coulomb", "constant time", "slip rate"},
    "Plain Coulomb; relaxing to it in a constant time delta (eq. 7); or in "
    "L / (|V_rel| + V_ref)");
  declare_selection(
    prm, "Coefficient from", "constant", {"constant", "phases"},
    "One coefficient, or those of the phases in the RVE file (section 4)");
  declare_double(prm, "Coefficient", 0.25, Range::non_negative(),
                 "Coulomb friction coefficient mu [-]");
  declare_double(prm, "Regularization time", 1.5e-6, Range::non_negative(),
                 "delta of eq. (7); 0 is plain Coulomb [s]");
  declare_double(prm, "Length", 3e-6, Range::positive(), "L of the slip-rate law [m]");
  declare_double(prm, "Reference velocity", 1e-3, Range::positive(),
                 "V_ref of the slip-rate law [m/s]");
  declare_selection(
    prm, "Node rule", "stiffness", {"stiffness", "mean", "largest", "smallest"},
    "Coefficient of a node between cells of two phases: their mean weighted with the "
    "stiffness D22, as the pressure is shared, the plain mean, or one of the two");
}

} // namespace

void ContactParameters::declare(dealii::ParameterHandler &prm, const RawParameters &raw)
{
  declare_selection(prm, "Analysis", "transient",
                    {"transient", "modal", "static contact", "friction homogenization"},
                    "What is computed");
  declare_body(prm);
  declare_time(prm);
  declare_flat(prm);
  declare_top(prm);
  declare_sides(prm);
  declare_friction(prm);
  declare_observation(prm, raw);
  declare_other_analyses(prm);
  declare_checkpoints(prm);
  const ParameterSection section(prm, "Performance");
  declare_integer(
    prm, "Wavefront", 0, 0, 64,
    "Time steps in flight on grids larger than the cache; 0: automatic, 1: none. "
    "Never changes a result [-]");
  declare_selection(
    prm, "Instruction set", "auto",
    {"auto", "x86-64", "x86-64-v3", "x86-64-v4", "generic"},
    "Kernels to use; auto: the widest the processor has; generic: those of "
    "processors other than x86-64");
  declare_selection(
    prm, "Static solver", "multigrid", {"multigrid", "jacobi", "assembled"},
    "Of the modal and the static contact analysis, as Homogenization/Solver");
}
} // namespace mesoslip
