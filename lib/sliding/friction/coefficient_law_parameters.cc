#include "sliding/friction/coefficient_law_parameters.h"

#include "base/digest.h"
#include "base/errors.h"
#include "base/object_exchange.h"
#include "contact/laws/friction_expression.h"
#include "parameters/keys.h"

#include <cmath>
#include <stdexcept>

namespace mesoslip
{
namespace
{
const std::vector<std::string> law_names = {"constant",
                                            "static and kinetic",
                                            "Stribeck",
                                            "linear slip weakening",
                                            "exponential slip weakening",
                                            "rate and state",
                                            "table",
                                            "expression"};

void bind_rate_and_state(Keys &keys, RateAndState::Constants &c)
{
  const auto section = keys.section("Rate and state");
  keys.bind("Evolution", c.aging, {"slip law", "aging law"},
            "How the state theta evolves: d theta/dt = 1 - V theta/L (aging law), or "
            "-(V theta/L) ln(V theta/L) (slip law)");
  keys.bind("Direct effect", c.a, Range::positive(),
            "a: friction rises by a ln(V_2/V_1) at once when the slip rate does from V_1 "
            "to V_2 [-]");
  keys.bind("Evolution effect", c.b, Range::non_negative(),
            "b: friction falls by b ln(V_2/V_1) afterwards; above a, steady friction "
            "falls with the slip rate [-]");
  keys.bind("Length", c.length, Range::positive(),
            "L: slip over which friction does so [m]");
  keys.bind("Velocity", c.velocity, Range::positive(),
            "V_0: slip rate at which steady friction is Friction/Coefficient [m/s]");
  double initial = std::numeric_limits<double>::quiet_NaN();
  keys.bind_or_auto("Initial state", initial, Range::positive(),
                    "theta of a node that comes into contact; auto: L/V_0 [s]");
  c.initial_state = std::isnan(initial) ? c.length / c.velocity : initial;
}

FrictionTable::Points table_on_all_ranks(const std::string &path)
{
  FrictionTable::Points points;
  on_root(MPI_COMM_WORLD, [&]() { points = read_friction_table(path); });
  for (auto *values : {&points.slip_rate, &points.pressure, &points.coefficient})
    broadcast_object(MPI_COMM_WORLD, *values);
  return points;
}

std::string healing_text(const Healing &healing)
{
  const char *const names[] = {"none", "separation", "sticking", "time"};
  return std::string(", healing = ") + names[static_cast<std::size_t>(healing.kind)] +
         (healing.kind == Healing::Kind::time ? " " + to_text(healing.time) + " s" : "");
}
} // namespace

void CoefficientLawParameters::bind(Keys &keys)
{
  keys.bind("Coefficient law", kind, law_names,
            "Friction coefficient mu, V being the slip rate and D the accumulated slip "
            "of a node: "
            "constant; mu_k + (mu_s - mu_k) exp(-V/V_c) (static and kinetic); mu_k + "
            "(mu_s - mu_k) "
            "exp(-(V/V_c)^n) + c V (Stribeck); mu_k + (mu_s - mu_k) (1 - D/D_c) down to "
            "mu_k (linear "
            "slip weakening); mu_k + (mu_s - mu_k) exp(-D/D_c) (exponential slip "
            "weakening); rate "
            "and state; a table; or an expression. Coefficient is mu_s, and f_0 of rate "
            "and state");
  keys.bind(
    "Kinetic coefficient", stribeck.kinetic, Range::non_negative(),
    "mu_k, of fast sliding or after much slip; above Coefficient friction rises [-]");
  keys.bind("Critical velocity", stribeck.critical_velocity, Range::positive(),
            "V_c, the slip rate within which mu goes from mu_s to mu_k [m/s]");
  keys.bind("Stribeck exponent", stribeck.exponent, Range::closed(1., 10.),
            "n of the Stribeck curve [-]");
  keys.bind("Viscous coefficient", stribeck.viscous, Range::non_negative(),
            "c of the Stribeck curve, of friction in proportion to the slip rate [s/m]");
  keys.bind("Critical slip", weakening.critical_slip, Range::positive(),
            "D_c, the slip over which mu goes from mu_s to mu_k [m]");
  keys.bind(
    "Healing", healing.kind, {"none", "separation", "sticking", "time"},
    "When a node forgets the slip D that it has accumulated: never; when it leaves the "
    "flat; when it sticks or leaves the flat; or exponentially in Healing time while it "
    "sticks or is off the flat");
  keys.bind("Healing time", healing.time, Range::positive(), "Of Healing = time [s]");
  bind_rate_and_state(keys, state);
  keys.bind_input(
    "Table", table_file,
    "CSV file with the columns 'slip rate [m/s]', 'coefficient [-]' and, if it depends "
    "on "
    "the pressure, 'pressure [Pa]': a row for each pair. Bilinear in between, constant "
    "beyond the table");
  keys.bind(
    "Coefficient expression", expression,
    "mu as an expression in the slip rate V [m/s], the accumulated slip D [m], the "
    "pressure p [Pa], the time t [s] and the place x and, in 3D, y [m], such as "
    "0.2 + 0.1*exp(-V/0.5)");
  keys.only_with("Coefficient law",
                 {"static and kinetic", "Stribeck", "linear slip weakening",
                  "exponential slip weakening"},
                 {"Kinetic coefficient"});
  keys.only_with("Coefficient law", {"static and kinetic", "Stribeck"},
                 {"Critical velocity"});
  keys.only_with("Coefficient law", {"Stribeck"},
                 {"Stribeck exponent", "Viscous coefficient"});
  keys.only_with("Coefficient law",
                 {"linear slip weakening", "exponential slip weakening"},
                 {"Critical slip"});
  keys.only_with("Coefficient law",
                 {"linear slip weakening", "exponential slip weakening", "expression"},
                 {"Healing"});
  keys.only_with("Healing", {"time"}, {"Healing time"});
  keys.only_with("Coefficient law", {"rate and state"}, {"Rate and state/"});
  keys.only_with("Coefficient law", {"table"}, {"Table"});
  keys.only_with("Coefficient law", {"expression"}, {"Coefficient expression"});
  keys.require(kind != Kind::table || !table_file.empty(), "Table",
               "it is empty; name the CSV file of Coefficient law = table");
}

std::shared_ptr<const CoefficientLaw>
CoefficientLawParameters::make(const double reference, const unsigned int dim)
{
  stribeck.at_rest = weakening.at_rest = state.reference = reference;
  weakening.kinetic                                      = stribeck.kinetic;
  weakening.healing                                      = healing;
  switch (kind)
    {
    case Kind::constant:
      return nullptr;
    case Kind::static_and_kinetic:
      stribeck.exponent = 1.;
      stribeck.viscous  = 0.;
      return std::make_shared<Stribeck>(stribeck);
    case Kind::stribeck:
      return std::make_shared<Stribeck>(stribeck);
    case Kind::linear_slip_weakening:
    case Kind::exponential_slip_weakening:
      weakening.exponential = kind == Kind::exponential_slip_weakening;
      return std::make_shared<SlipWeakening>(weakening);
    case Kind::rate_and_state:
      return std::make_shared<RateAndState>(state);
    case Kind::table:
      {
        const FrictionTable::Points points = table_on_all_ranks(table_file);
        Digest digest;
        for (const auto *values :
             {&points.slip_rate, &points.pressure, &points.coefficient})
          for (const double value : *values)
            digest.add(value);
        table_digest = digest.hex();
        return std::make_shared<FrictionTable>(points);
      }
    default:
      try
        {
          return std::make_shared<FrictionExpression>(expression, dim, healing);
        }
      catch (const std::invalid_argument &e)
        {
          throw UserError(std::string("Friction/Coefficient expression: ") + e.what() +
                          "; write for example 0.2 + 0.1*exp(-V/0.5)");
        }
    }
}

std::string CoefficientLawParameters::text() const
{
  const auto number = [](const std::string &name, const double value,
                         const std::string &unit) {
    return ", " + name + " = " + to_text(value) + unit;
  };
  std::string text = law_names[static_cast<std::size_t>(kind)];
  if (kind == Kind::static_and_kinetic || kind == Kind::stribeck)
    text += number("mu_k", stribeck.kinetic, "") +
            number("V_c", stribeck.critical_velocity, " m/s");
  if (kind == Kind::stribeck)
    text += number("n", stribeck.exponent, "") + number("c", stribeck.viscous, " s/m");
  if (is_slip_weakening())
    text += number("mu_k", stribeck.kinetic, "") +
            number("D_c", weakening.critical_slip, " m") + healing_text(healing);
  if (kind == Kind::rate_and_state)
    text += std::string(", ") + (state.aging ? "aging law" : "slip law") +
            number("a", state.a, "") + number("b", state.b, "") +
            number("L", state.length, " m") + number("V_0", state.velocity, " m/s") +
            number("theta_0", state.initial_state, " s");
  if (kind == Kind::table)
    text += ", numbers with the digest " + table_digest;
  if (kind == Kind::expression)
    text += ", " + expression + healing_text(healing);
  return text;
}
} // namespace mesoslip
