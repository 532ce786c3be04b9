#include "simulation/runaway_report.h"

#include "io/errors.h"
#include "io/parameters.h"
#include "simulation/deformation_report.h"

#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
/** The first step up to @p n at which @p load is not a number; n + 1: there is none. */
std::uint64_t
first_not_finite(const LoadHistory &load, const double dt, const std::uint64_t n)
{
  std::uint64_t step = 0;
  while (step <= n && std::isfinite(load(step * dt)))
    ++step;
  return step;
}

/** Ends the run if @p load, given as an expression, stopped being a number. */
void require_finite(const LoadHistory &load,
                    const std::string &key,
                    const double dt,
                    const std::uint64_t n)
{
  const std::uint64_t step = first_not_finite(load, dt, n);
  if (step > n)
    return;
  throw NumericalFailure(
    key + " is " + (std::isnan(load(step * dt)) ? "not a number" : "infinite"), step,
    step * dt, "which spoiled the run; write an expression that is finite at all times");
}

std::string likely_cause(const Runaway &found, const TimeStepChoice &time)
{
  std::ostringstream text;
  text.precision(4);
  const double share = 100. * time.step.dt / time.critical;
  if (share > 100.)
    text << "the time step is " << share
         << " % of the critical one; use Time/Time step = auto or a smaller one";
  else if (!std::isfinite(found.energy))
    text << "loads that overflow (Top/Pressure, Flat/Velocity, Body/Initial velocity, "
            "Acceleration), as the time step is "
         << share << " % of the critical one";
  else
    text << "the time step is " << share
         << " % of the critical one, too close to it; reduce Time/Safety factor or Time "
            "step";
  return text.str();
}
} // namespace

void report_runaway(const Runaway &found,
                    const std::uint64_t n,
                    const TimeStepChoice &time,
                    const ContactParameters &parameters)
{
  require_finite(parameters.friction.flat_velocity, "Flat/Expression", time.step.dt, n);
  require_finite(parameters.top.pressure, "Top/Expression", time.step.dt, n);
  std::ostringstream what, place;
  what.precision(3);
  what << "the run blew up: its energy is ";
  if (std::isnan(found.energy))
    what << "not a number,";
  else
    what << found.energy << " J/m";
  what << " where at most " << found.put_in
       << " J/m were put in; likely cause: " << likely_cause(found, time) << "; found";
  place.precision(3);
  place << "node (" << found.column << ", " << found.row << ") with u_"
        << "xy"[found.component] << " = " << found.displacement << " m and a velocity of "
        << found.velocity << " m/s";
  throw NumericalFailure(what.str(), n, n * time.step.dt, place.str());
}

void require_upright_cells(const Deformation &found,
                           const std::uint64_t n,
                           const TimeStepChoice &time,
                           const ContactParameters &parameters,
                           const UniformMaterial &material)
{
  const std::string text = inverted_cell_text(found, parameters, material);
  if (text.empty())
    return;
  // Of an unstable run the time step is the cause, whatever the loads are.
  Runaway runaway;
  if (time.step.dt > time.critical)
    throw NumericalFailure(
      "the run blew up: " + text.substr(0, text.find("; likely cause")) +
        "; likely cause: " + likely_cause(runaway, time) + "; found",
      n, n * time.step.dt, "");
  throw NumericalFailure(text + "; found", n, n * time.step.dt, "");
}
} // namespace mesoslip
