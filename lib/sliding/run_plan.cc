#include "sliding/run_plan.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "dynamics/critical_time_step.h"
#include "material/shear_impedance.h"
#include "sliding/analyses/modal_cases.h"
#include "sliding/complex/complex_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/** Lower bound of the critical time step by the frequency of a single cell, which is
 * cheap to compute. */
double lower_bound(const BodyScales &scales, const StepParameters &step)
{
  return critical_time_step(scales.highest_frequency, step.beta2, step.beta);
}

/** Ends the run if the expression of @p load is not finite up to step @p n. */
void require_finite(const LoadHistory &load,
                    const std::string &key,
                    const double dt,
                    const std::uint64_t n)
{
  for (std::uint64_t step = 0; step <= n; ++step)
    if (const double value = load(step * dt); !std::isfinite(value))
      throw NumericalFailure(
        key + " is " + (std::isnan(value) ? "not a number" : "infinite"), step, step * dt,
        "which spoiled the run; write an expression that is finite at all times");
}

std::string likely_instability(const double energy, const TimeStepChoice &time)
{
  const double share = 100. * time.step.dt / time.critical;
  const std::string step =
    "the time step is " + quantity_text(share, "%") + " of the critical one";
  if (share > 100.)
    return step + "; use Time/Time step = auto or a smaller one";
  if (!std::isfinite(energy))
    return "loads that overflow (Supports, Flat/Velocity, Body), as " + step;
  return step + ", too close to it; reduce Time/Safety factor or Time step";
}
} // namespace

std::string damping_text(const StepParameters &step)
{
  const auto texts = [](const std::vector<double> &of_phases, const double factor,
                        const std::string &unit) {
    std::string text;
    for (const double value : of_phases)
      text += (text.empty() ? "" : ", ") + quantity_text(factor * value, unit);
    return text + (of_phases.size() > 1 ? " by phase" : "");
  };
  const auto values = [](const std::vector<double> &of_phases, const double of_all) {
    return of_phases.empty() ? std::vector<double>{of_all} : of_phases;
  };
  return "beta = " + texts(values(step.beta_of_phases, step.beta), 1e9, "ns") +
         (step.alpha > 0.
            ? ", alpha = " + texts(values(step.alpha_of_phases, step.alpha), 1., "1/s")
            : "");
}

std::string TimeStepChoice::text() const
{
  const auto nanoseconds = [](const double t) { return quantity_text(1e9 * t, "ns"); };
  return "Time step " + nanoseconds(step.dt) + ", " +
         quantity_text(100. * step.dt / critical, "%") + " of the critical " +
         nanoseconds(critical) + "; beta2 = " + quantity_text(step.beta2, "") + ", " +
         damping_text(step) + "; " + std::to_string(n_steps) + " steps";
}

void require_frequency(const UniformMaterial &material)
{
  const double omega = element_frequency_bound(material);
  // The square of omega is multiplied and divided by lengths and times, so its range is
  // limited.
  if (!(omega > 1e-100 && omega < 1e100))
    throw UserError("Body: stiffness, density and cells of " +
                    to_text(material.grid().spacing[0]) + " x " +
                    to_text(material.grid().spacing[1]) +
                    " m give a cell no frequency of vibration that can be computed with; "
                    "are Size in m, "
                    "Stiffness in Pa and Density in kg/m^3?");
}

unsigned int statistics_interval(const double crossing, const double dt)
{
  return static_cast<unsigned int>(std::clamp(crossing / (6. * dt), 1., 10.));
}

/** @p x rounded down to ten digits: equal on any number of ranks, which compute it up to
 * round-off. */
static double rounded_down(const double x)
{
  const double unit = std::pow(10., std::floor(std::log10(x)) - 9.);
  return std::floor(x / unit) * unit;
}

TimeStepChoice choose_time_step(const ContactParameters &parameters,
                                const double highest_frequency)
{
  TimeStepChoice choice;
  StepParameters &step = choice.step = parameters.step;
  choice.critical = critical_time_step(highest_frequency, step.beta2, step.beta);
  if (std::isnan(step.dt))
    step.dt = rounded_down(parameters.time.safety * choice.critical);
  if (parameters.time.check_time_step && step.dt > choice.critical)
    throw UserError(brief_text(
      6, "Time/Time step: ", step.dt, " s is above the critical ", choice.critical,
      " s, the run would be unstable; use auto or a smaller one"));
  choice.n_steps =
    static_cast<std::uint64_t>(std::ceil(parameters.time.end_time / step.dt - 1e-9));
  return choice;
}

void TimeStepChoice::shorten(const TimeStepChoice &other, const double end_time)
{
  critical = std::min(critical, other.critical);
  step.dt  = std::min(step.dt, other.step.dt);
  n_steps  = static_cast<std::uint64_t>(std::ceil(end_time / step.dt - 1e-9));
}

ContactMapSetup contact_map_setup(const ContactParameters &parameters, const double dt)
{
  const ContactMapParameters &map = parameters.map;
  ContactMapSetup setup;
  if (!(map.interval > 0.))
    return setup;
  // Limited to 1e18 steps to avoid overflow.
  const auto steps = [&](const double t) {
    return static_cast<std::uint64_t>(std::llround(std::min(t / dt, 1e18)));
  };
  setup.interval = std::max<std::uint64_t>(1, steps(map.interval));
  setup.first    = steps(map.from);
  setup.end      = std::isnan(map.to) ? steps(1e18 * dt) : steps(map.to) + 1;
  if (const auto &law = parameters.contact.law.coefficient_law; law && law->state())
    setup.law_state = *law->state();
  const auto names = map_field_names();
  for (std::size_t k = 0; k < names.size(); ++k)
    if (std::find(map.fields.begin(), map.fields.end(), names[k]) != map.fields.end())
      setup.quantities.push_back(static_cast<MapQuantity>(k));
  return setup;
}

LoadRange load_range(const LoadHistory &load, const double end)
{
  constexpr unsigned int n = 1000;
  LoadRange range;
  range.smallest = range.largest = load(0.);
  for (unsigned int k = 0; k <= n; ++k)
    {
      const double value = load(end * k / n);
      range.finite       = range.finite && std::isfinite(value);
      range.smallest     = std::min(range.smallest, value);
      range.largest      = std::max(range.largest, value);
    }
  return range;
}

BodyScales::BodyScales(const UniformMaterial &material)
  : height(material.grid().extent(1))
  , extent({{material.grid().extent(0), 0.}})
  , area(material.grid().extent(0))
  , mass(material.total_mass())
  , density(mass / (area * height))
  , shear_impedance(std::numeric_limits<double>::infinity())
  , highest_frequency(element_frequency_bound(material))
{
  for (const ElasticPhase<2> &c : material.phases())
    {
      stiffness  = std::max(stiffness, c.stiffness(1, 1));
      wave_speed = std::max(wave_speed, std::sqrt(c.stiffness(1, 1) / c.density));
      shear_impedance =
        std::min(shear_impedance, mesoslip::shear_impedance<2>(c.stiffness, c.density));
    }
}

static std::string around_text(const CellExtreme &cell, const unsigned int dim)
{
  std::string text = " around ";
  for (unsigned int d = 0; d < dim; ++d)
    text += std::string(d > 0 ? ", " : "") + "xyz"[d] + " = " +
            quantity_text(1e3 * cell.middle[d], "mm");
  return text;
}

PlaceText cell_text(const unsigned int dim)
{
  return [dim](const CellExtreme &cell) {
    return "cell " + std::to_string(cell.cell) + around_text(cell, dim);
  };
}

PlaceText cell_text(const UniformGrid<2> &grid)
{
  return [n_x = std::uint64_t{grid.cells[0]}](const CellExtreme &cell) {
    return "cell (" + std::to_string(cell.cell % n_x) + ", " +
           std::to_string(cell.cell / n_x) + ")" + around_text(cell, 2);
  };
}

std::string damping_warning(const ContactParameters &parameters,
                            const BodyScales &scales,
                            const std::string &shortened)
{
  StepParameters undamped = parameters.step;
  undamped.beta           = 0.;
  const double shortening =
    lower_bound(scales, undamped) / lower_bound(scales, parameters.step);
  if (shortening <= 10.)
    return "";
  return brief_text(3, "Time/Rayleigh beta = ", parameters.step.beta, " s makes ",
                    shortened, " ", shortening,
                    " times shorter than without damping; times are in s");
}

double static_node_memory(const ContactParameters &parameters,
                          const unsigned int dim,
                          const bool ml)
{
  if (parameters.analysis != ContactAnalysis::modal)
    return !ml ? (dim == 2 ? 720. : 850.) : dim == 2 ? 4700. : 20000.;
  const double bytes_of_a_mode = 50. * dim;
  return (!ml        ? (dim == 2 ? 750. : 1050.)
          : dim == 2 ? 3500.
                     : 16400.) +
         bytes_of_a_mode * parameters.modal.n_modes;
}

double field_memory(const ContactParameters &parameters, const UniformGrid<2> &grid)
{
  // In floating point, as the number of nodes may exceed the integer range. Measured: the
  // power iteration for the largest frequency, or the run with energies.
  constexpr double bytes_of_steps = 160.;
  const double nodes              = (grid.cells[0] + 1.) * (grid.cells[1] + 1.);
  if (parameters.analysis == ContactAnalysis::complex_modes)
    return complex_modes_memory(2. * nodes, 2);
  if (parameters.analysis == ContactAnalysis::transient)
    return bytes_of_steps * nodes;
  return nodes * static_node_memory(parameters, 2,
                                    parameters.static_solver == StaticSolverKind::ml);
}

std::string large_strain_warning(const Deformation &found,
                                 const ContactParameters &parameters,
                                 const BodyScales &scales,
                                 const PlaceText &place,
                                 const std::string &when)
{
  const bool strained = !(found.strain.value <= largest_small_strain);
  if (!strained && found.rotation.value <= largest_small_strain)
    return "";
  const std::string limit = quantity_text(100. * largest_small_strain, "%");
  return (strained ? "the strain is " + quantity_text(100. * found.strain.value, "%")
                   : "the rotation is " + quantity_text(found.rotation.value, "rad")) +
         when + " in " + place(strained ? found.strain : found.rotation) +
         ", where the theory is that of small strains and rotations, up to " + limit +
         " or so: results from there on cannot be trusted; likely cause: " +
         likely_cause(parameters, scales);
}

std::string crossing_text(const ContactParameters &parameters, const BodyScales &scales)
{
  return brief_text(4, "a wave takes ", 1e3 * scales.crossing(),
                    " ms from the flat to the top, the run ",
                    1e3 * parameters.time.end_time, " ms");
}

std::string undefined_friction(const ContactParameters &p, const double energy)
{
  return std::isnan(energy) &&
             p.friction.coefficient_law.kind == CoefficientLawParameters::Kind::expression
           ? "Friction/Coefficient expression where it is negative or no number; or "
           : "";
}

std::string inverted_cell_text(const Deformation &found, const PlaceText &place)
{
  return found.jacobian.value > 0.
           ? ""
           : place(found.jacobian) + " is turned inside out (strains up to " +
               quantity_text(100. * found.strain.value, "%") + ")";
}

void report_runaway(const Runaway &found,
                    const std::uint64_t n,
                    const TimeStepChoice &time,
                    const ContactParameters &parameters,
                    const bool has_rows)
{
  require_finite(parameters.contact.flat_velocity, "Flat/Expression", time.step.dt, n);
  for (const SideSupport *side : parameters.suspended())
    {
      require_finite(side->pressure, side->key("Expression"), time.step.dt, n);
      for (const LoadHistory &motion : side->suspension.motion)
        require_finite(motion, side->key("Motion"), time.step.dt, n);
    }
  const char *joule = parameters.mesh.mesh.dim == 2 ? " J/m" : " J";
  throw NumericalFailure(
    brief_text(
      3, "the run blew up: its energy is ",
      std::isnan(found.energy) ? "not a number," : brief_text(3, found.energy, joule),
      " where at most ", found.put_in, joule,
      " were put in; likely cause: ", undefined_friction(parameters, found.energy),
      likely_instability(found.energy, time), "; found"),
    n, n * time.step.dt,
    (has_rows ? brief_text(9, "node (", found.column, ", ", found.row, ")") : "a node") +
      brief_text(3, " with u_", "xyz"[found.component], " = ", found.displacement,
                 " m and a velocity of ", found.velocity, " m/s"));
}

void require_upright_cells(const Deformation &found,
                           const std::uint64_t n,
                           const TimeStepChoice &time,
                           const ContactParameters &parameters,
                           const BodyScales &scales,
                           const PlaceText &place)
{
  const std::string text = inverted_cell_text(found, place);
  if (text.empty())
    return;
  // In an unstable run the time step is the cause for any loads.
  const bool unstable = time.step.dt > time.critical;
  throw NumericalFailure(
    (unstable ? "the run blew up: " : "") + text + "; likely cause: " +
      (unstable ? likely_instability(0., time) : likely_cause(parameters, scales)) +
      "; found",
    n, n * time.step.dt, "");
}
} // namespace mesoslip
