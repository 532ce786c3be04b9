#ifndef mesoslip_sliding_run_plan_h
#define mesoslip_sliding_run_plan_h

#include "dynamics/stability_monitor.h"
#include "dynamics/stepper.h"
#include "elasticity/uniform_material.h"
#include "material/plausibility.h"
#include "parameters/load_history.h"
#include "program/output_folder.h"
#include "sliding/body_size.h"
#include "sliding/contact_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace mesoslip
{
/** Extremes of a load over a run, from a thousand samples. */
struct LoadRange
{
  double smallest = 0.;   ///< in the unit of the load
  double largest  = 0.;   ///< in the unit of the load
  bool finite     = true; ///< whether all samples are finite

  /** Largest absolute value. */
  double largest_size() const
  {
    return std::max(std::fabs(smallest), std::fabs(largest));
  }
};

/** The range of @p load from 0 to @p end (s). */
LoadRange load_range(const LoadHistory &load, const double end);

/** Description of a cell in messages: "cell 12 around x = 1 mm, y = 2 mm". */
using PlaceText = std::function<std::string(const CellExtreme &)>;

/** PlaceText for a mesh or a box of @p dim dimensions. */
PlaceText cell_text(const unsigned int dim);

/** PlaceText for a grid: "cell (12, 0) around x = 1.25 mm, y = 0.05 mm". */
PlaceText cell_text(const UniformGrid<2> &grid);

/** "beta = 4.4 ns, alpha = 100 1/s"; with a list of values where they are by phase. */
std::string damping_text(const StepParameters &step);

/** Time step with its critical value. */
struct TimeStepChoice
{
  StepParameters step;        ///< time step and parameters of the scheme
  double critical       = 0.; ///< s
  std::uint64_t n_steps = 0;  ///< number of steps to the end time

  /** Steps between two samples for the statistics, see statistics_interval(). */
  unsigned int statistics_interval = 1;

  /** Steps between two samples: @p asked for, or for 0 (auto) the interval of the
   * statistics. */
  unsigned int interval(const unsigned int asked) const
  {
    return asked > 0 ? asked : statistics_interval;
  }

  /** Takes the time step of a second body in a run of this length (s), if it is
   * shorter. */
  void shorten(const TimeStepChoice &other, const double end_time);

  /** "dt = 13.2 ns, 95 % of the critical 13.9 ns; beta2 = 0.5, beta = 4.4 ns". */
  std::string text() const;
};

/** Checks that the stiffest cell has a finite frequency, and so a time step.
 * @throws UserError */
void require_frequency(const UniformMaterial &material);

/**
 * Steps of @p dt seconds between two samples for spectra and statistics: six samples
 * while a wave crosses the body along its shorter side, in @p crossing seconds, which
 * resolves vibrations three times as fast; at least one sample every ten steps.
 */
unsigned int statistics_interval(const double crossing, const double dt);

/** Chooses the time step for a body with this highest circular frequency (1/s).
 * @throws UserError if a given time step is above the critical one */
TimeStepChoice choose_time_step(const ContactParameters &parameters,
                                const double highest_frequency);

/** Steps and quantities of the contact map that @p parameters ask for. */
ContactMapSetup contact_map_setup(const ContactParameters &parameters, const double dt);

/** Memory per node of statics or modes (bytes, as measured): with ML, or with the
 * multigrid of grids. */
double static_node_memory(const ContactParameters &parameters,
                          const unsigned int dim,
                          const bool ml);

/** Memory of the fields on one rank (bytes), to be checked before they are created. */
double field_memory(const ContactParameters &parameters, const UniformGrid<2> &grid);

/**
 * "Time/Rayleigh beta = ... makes (@p shortened) 20 times shorter than without damping; is
 * it in s?" where the critical time step of a single cell would be more than ten times
 * longer without it; otherwise empty.
 */
std::string damping_warning(const ContactParameters &parameters,
                            const BodyScales &scales,
                            const std::string &shortened);

/** "A wave takes 0.008 ms from the flat to the top, the run 1 ms". */
std::string crossing_text(const ContactParameters &parameters, const BodyScales &scales);

/**
 * Warnings on values that look like another unit, for a transient run of about
 * @p n_steps: times, loads (also as expressions), velocities, friction law, damping and
 * intervals; and on sliding without damping of grid-scale waves.
 */
std::vector<std::string> implausible_run(const ContactParameters &parameters,
                                         const BodyScales &scales,
                                         const double n_steps);

/** Largest norm of strain, and rotation (rad), for which small-strain theory holds. */
constexpr double largest_small_strain = 0.05;

/** A warning with the likely cause if strain or rotation exceeds largest_small_strain;
 * else empty. */
std::string large_strain_warning(const Deformation &found,
                                 const ContactParameters &parameters,
                                 const BodyScales &scales,
                                 const PlaceText &place,
                                 const std::string &when);

/** "cell (12, 0) around x = 1.25 mm, y = 0.05 mm is turned inside out ..."; else
 * empty. */
std::string inverted_cell_text(const Deformation &found, const PlaceText &place);

/** The load that causes the largest strain on its own, in words. */
std::string likely_cause(const ContactParameters &parameters, const BodyScales &body);

/** Text on a friction law that may explain an energy that is not a number; else empty. */
std::string undefined_friction(const ContactParameters &parameters, const double energy);

/**
 * Ends a run that has diverged before step @p n. @p has_rows: nodes are numbered by
 * column and row.
 * @throws NumericalFailure with energy, likely cause, step, time and node.
 */
[[noreturn]] void report_runaway(const Runaway &found,
                                 const std::uint64_t n,
                                 const TimeStepChoice &time,
                                 const ContactParameters &parameters,
                                 const bool has_rows);

/**
 * Ends a run in which a cell is inverted before step @p n.
 * @throws NumericalFailure with likely cause, step, time and cell.
 */
void require_upright_cells(const Deformation &found,
                           const std::uint64_t n,
                           const TimeStepChoice &time,
                           const ContactParameters &parameters,
                           const BodyScales &scales,
                           const PlaceText &place);
} // namespace mesoslip

#endif
