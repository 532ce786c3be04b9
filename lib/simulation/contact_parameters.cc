#include "simulation/contact_parameters.h"

#include "io/errors.h"
#include "io/parameters.h"

#include <cmath>
#include <set>
#include <stdexcept>

namespace mesoslip
{
namespace
{
using Handler = dealii::ParameterHandler;

LoadHistory
parse_load(Handler &prm, const std::string &section_name, const std::string &key)
{
  const ParameterSection section(prm, section_name);
  const double amplitude       = get_double(prm, key);
  const std::string expression = get_string(prm, "Expression");
  if (expression.empty())
    return LoadHistory(amplitude, ramp_from_string(get_string(prm, "Ramp")),
                       get_double(prm, "Ramp time"));
  try
    {
      return LoadHistory(amplitude, expression);
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(section_name + "/Expression: " + e.what() +
                      "; write for example 2*cos(2*pi*1000*t)");
    }
}

template <typename Number>
std::array<Number, 2> pair(const std::string &key, const std::vector<Number> &values)
{
  if (values.empty())
    return {};
  if (values.size() != 2)
    throw UserError(key + ": one number found, two (x, y) are needed");
  return {{values[0], values[1]}};
}

BodyParameters parse_body(Handler &prm)
{
  const ParameterSection section(prm, "Body");
  BodyParameters body;
  body.heterogeneous  = get_string(prm, "Material") == "heterogeneous";
  body.rve_file       = get_string(prm, "RVE file");
  body.stiffness_name = get_string(prm, "Stiffness from");
  body.stiffness      = get_double_list(prm, "Stiffness");
  body.density        = get_double(prm, "Density");
  body.size           = pair("Body/Size", get_double_list(prm, "Size"));
  const auto cells    = pair("Body/Cells", get_integer_list(prm, "Cells"));
  body.cells          = {
             {static_cast<unsigned int>(cells[0]), static_cast<unsigned int>(cells[1])}};
  body.initial_velocity =
    pair("Body/Initial velocity", get_double_list(prm, "Initial velocity"));
  body.acceleration = pair("Body/Acceleration", get_double_list(prm, "Acceleration"));
  if (body.stiffness.size() == 5)
    throw UserError(
      "Body/Stiffness: 5 numbers found; give D11, D12, D22, D33 or all six");
  if (body.heterogeneous && body.rve_file.empty())
    throw UserError(
      "Body/RVE file is empty, but a heterogeneous body takes its phases and "
      "morphology from there; run rve_homogenization and name its rve.h5");
  if (!body.rve_file.empty())
    require_input_file("Body/RVE file: ", body.rve_file, "run rve_homogenization first");
  return body;
}

TimeParameters parse_time(Handler &prm)
{
  const ParameterSection section(prm, "Time");
  TimeParameters time;
  time.end_time        = get_double(prm, "End time");
  time.time_step       = get_double_or_auto(prm, "Time step");
  time.safety          = get_double(prm, "Safety factor");
  time.beta2           = get_double(prm, "Beta2");
  time.beta            = get_double(prm, "Rayleigh beta");
  time.check_time_step = get_bool(prm, "Check time step");
  if (time.time_step > time.end_time)
    throw UserError("Time/Time step: " + to_text(time.time_step) +
                    " s is longer than End time, " + to_text(time.end_time) + " s");
  return time;
}

TopSetup parse_top(Handler &prm)
{
  TopSetup top;
  top.pressure = parse_load(prm, "Top", "Pressure");
  const ParameterSection section(prm, "Top");
  const std::string kind = get_string(prm, "Kind");
  top.kind               = kind == "pressure" ? TopSetup::Kind::pressure
                           : kind == "platen" ? TopSetup::Kind::platen
                                              : TopSetup::Kind::held;
  top.lateral_held       = get_bool(prm, "Lateral held");
  top.platen_mass        = get_double(prm, "Platen mass");
  const double hold_from = get_double_or_auto(prm, "Hold from");
  if (!std::isnan(hold_from))
    top.hold_from = hold_from;
  return top;
}

void parse_sides(Handler &prm, ContactParameters &parameters)
{
  const ParameterSection section(prm, "Sides");
  const auto held = [&](const std::string &key) {
    const std::string value              = get_string(prm, key);
    const std::array<bool, 2> components = {
      {value == "u_x" || value == "both", value == "u_y" || value == "both"}};
    return components;
  };
  parameters.sides.left_held  = held("Left");
  parameters.sides.right_held = held("Right");
  parameters.periodic         = get_bool(prm, "Periodic");
  if (parameters.periodic &&
      (get_string(prm, "Left") != "free" || get_string(prm, "Right") != "free"))
    throw UserError("Sides/Periodic is true, so Left and Right have to be free");
}

FrictionParameters parse_friction(Handler &prm)
{
  FrictionParameters friction;
  friction.flat_velocity = parse_load(prm, "Flat", "Velocity");
  {
    const ParameterSection section(prm, "Flat");
    friction.gap = get_double(prm, "Gap");
  }
  const ParameterSection section(prm, "Friction");
  friction.law_name = get_string(prm, "Law");
  friction.law.time =
    friction.law_name == "coulomb" ? 0. : get_double(prm, "Regularization time");
  if (friction.law_name == "slip rate")
    {
      friction.slip_length        = get_double(prm, "Length");
      friction.reference_velocity = get_double(prm, "Reference velocity");
      friction.law.node_law       = std::make_shared<SlipRateRegularization>(
        friction.slip_length, friction.reference_velocity);
    }
  friction.coefficient_by_phase = get_string(prm, "Coefficient from") == "phases";
  friction.coefficient          = get_double(prm, "Coefficient");
  friction.node_rule            = get_string(prm, "Node rule");
  return friction;
}

std::vector<ProbeParameters> parse_probes(Handler &prm)
{
  std::vector<ProbeParameters> probes;
  std::set<std::string> names;
  for (const std::string &name : get_word_list(prm, "Probes"))
    {
      if (!names.insert(name).second)
        throw UserError("Observation/Probes: '" + name + "' is named twice");
      const ParameterSection section(prm, name);
      ProbeParameters probe;
      probe.name          = name;
      const auto position = get_double_list(prm, "Position");
      if (position.empty())
        throw UserError(
          "Observation/" + name +
          "/Position is missing; give x and y of the probe from the lower left "
          "corner in m, in a subsection " +
          name);
      probe.position     = pair("Observation/" + name + "/Position", position);
      probe.nearest_node = get_bool(prm, "Nearest node");
      probes.push_back(probe);
    }
  return probes;
}

ObservationParameters parse_observation(Handler &prm)
{
  ObservationParameters observation;
  {
    const ParameterSection section(prm, "Observation");
    observation.history_interval      = get_integer(prm, "History interval");
    observation.energy_interval       = get_integer(prm, "Energy interval");
    observation.blocks                = get_integer(prm, "Blocks");
    observation.steady_from           = get_double_or_auto(prm, "Steady from");
    observation.reference_x           = get_double_or_auto(prm, "Reference x");
    observation.stop_at_limit_cycle   = get_bool(prm, "Stop at limit cycle");
    observation.limit_cycle_tolerance = get_double(prm, "Limit cycle tolerance");
    observation.limit_cycle_periods   = get_integer(prm, "Limit cycle periods");
    observation.limit_cycle_windows   = get_integer(prm, "Limit cycle windows");
    observation.probe_interval        = get_integer(prm, "Probe interval");
    observation.probes                = parse_probes(prm);
  }
  const ParameterSection section(prm, "Snapshots");
  observation.snapshots_from     = get_double(prm, "From");
  observation.snapshots_to       = get_double_or_auto(prm, "To");
  observation.snapshots_interval = get_double(prm, "Interval");
  return observation;
}
} // namespace

ContactParameters ContactParameters::parse(dealii::ParameterHandler &prm)
{
  ContactParameters parameters;
  const std::string analysis = get_string(prm, "Analysis");
  parameters.analysis        = analysis == "transient" ? ContactAnalysis::transient
                               : analysis == "modal"   ? ContactAnalysis::modal
                               : analysis == "static contact"
                                 ? ContactAnalysis::static_contact
                                 : ContactAnalysis::friction_homogenization;
  parameters.body            = parse_body(prm);
  parameters.time            = parse_time(prm);
  parameters.top             = parse_top(prm);
  parse_sides(prm, parameters);
  if (parameters.top.kind == TopSetup::Kind::platen &&
      (parameters.sides.left_held[1] || parameters.sides.right_held[1]))
    throw UserError(
      "Sides: u_y is held on a side, but the platen of Top/Kind moves its corner; hold "
      "u_x only, or set Top/Kind = pressure or held");
  parameters.friction    = parse_friction(prm);
  parameters.observation = parse_observation(prm);
  {
    const ParameterSection section(prm, "Checkpoints");
    parameters.checkpoints.interval = 60. * get_double(prm, "Interval");
    parameters.checkpoints.keep     = get_bool(prm, "Keep");
  }
  {
    const ParameterSection section(prm, "Modal");
    parameters.modal.n_modes   = get_integer(prm, "Number of modes");
    parameters.modal.bottom    = get_string(prm, "Bottom");
    parameters.modal.tolerance = get_double(prm, "Tolerance");
  }
  {
    const ParameterSection section(prm, "Static contact");
    parameters.static_contact.tolerance      = get_double(prm, "Tolerance");
    parameters.static_contact.max_iterations = get_integer(prm, "Iterations");
  }
  {
    const ParameterSection section(prm, "Friction homogenization");
    parameters.homogenization.heterogeneous_run = get_string(prm, "Heterogeneous run");
    parameters.homogenization.homogeneous_run   = get_string(prm, "Homogeneous run");
    parameters.homogenization.static_contact    = get_string(prm, "Static contact");
    parameters.homogenization.pressures         = get_string(prm, "Pressures from");
    parameters.homogenization.calibrate         = get_bool(prm, "Calibrate");
  }
  const ParameterSection section(prm, "Performance");
  parameters.wavefront       = get_integer(prm, "Wavefront");
  parameters.instruction_set = get_string(prm, "Instruction set");
  parameters.static_solver   = static_solver_kind(get_string(prm, "Static solver"));
  return parameters;
}
} // namespace mesoslip
