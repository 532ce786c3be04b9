#ifndef mesoslip_sliding_transient_run_plan_h
#define mesoslip_sliding_transient_run_plan_h

#include "elasticity/uniform_material.h"
#include "parameters/load_history.h"
#include "program/output_folder.h"
#include "sliding/contact_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace mesoslip
{
/** Extremes of a load over a run, from a thousand samples of it. */
struct LoadRange
{
  double smallest = 0.;   ///< in the unit of the load
  double largest  = 0.;   ///< in the unit of the load
  bool finite     = true; ///< whether all samples are

  /** The larger of both without sign. */
  double largest_size() const
  {
    return std::max(std::fabs(smallest), std::fabs(largest));
  }
};

/** The range of @p load from 0 to @p end (s). */
LoadRange load_range(const LoadHistory &load, const double end);

/** Whether the top takes tangential forces; otherwise they are those of the contact. */
inline bool transmits_tangential_force(const TopSetup &top)
{
  return top.kind != TopSetup::Kind::pressure || top.lateral_held;
}

/** What loads are compared with. */
struct BodyScales
{
  /** Of the stiffest and the fastest class of @p material. */
  explicit BodyScales(const UniformMaterial &material);

  double stiffness  = 0.; ///< D22 (Pa)
  double wave_speed = 0.; ///< of pressure waves along y (m/s)
  double density    = 0.; ///< mean (kg/m^3)
};

/** Time step and what it was chosen from. */
struct TimeStepChoice
{
  StepParameters step;        ///< time step and parameters of the scheme
  double critical       = 0.; ///< s
  std::uint64_t n_steps = 0;  ///< to the end time

  /** Steps between two samples for the statistics, see statistics_interval(). */
  unsigned int statistics_interval = 1;

  /** "dt = 13.2 ns, 95 % of the critical 13.9 ns; beta2 = 0.5, beta = 4.4 ns". */
  std::string text() const;
};

/** That the stiffest cell has a frequency, and so a time step. @throws UserError */
void require_frequency(const UniformMaterial &material);

/**
 * Steps of @p dt seconds between two samples of what spectra and statistics rest on: six
 * samples while a wave crosses the body along its shorter side, so that they carry
 * vibrations three times as fast, but at least one every ten steps.
 */
unsigned int statistics_interval(const UniformMaterial &material, const double dt);

/** @throws UserError when a given time step is above the critical one. */
TimeStepChoice choose_time_step(const ContactParameters &parameters,
                                const UniformMaterial &material);

/**
 * Snapshots that a transient run of @p n_steps takes, at most one a step.
 * @throws UserError when they begin after the end
 */
double n_snapshots(const ContactParameters &parameters, const double n_steps);

/** Memory of the fields, to be checked before they are created. */
ResourceNeed field_memory(const ContactAnalysis analysis, const UniformGrid<2> &grid);

/**
 * Steps of a transient run, estimated from above: with the bound of a single cell for the
 * time step, or the time step given. @throws UserError if that is not stable
 */
double largest_number_of_steps(const ContactParameters &parameters,
                               const UniformMaterial &material);

/** Time (s) in which a pressure wave crosses the height of the body, in its fastest
 * material. */
double crossing_time(const UniformMaterial &material);

/**
 * "Time/Rayleigh beta = ... makes <shortened> 20 times shorter than without damping; is
 * it in s?" where the critical time step of a single cell would be more than ten times
 * longer without it; otherwise empty.
 */
std::string damping_warning(const ContactParameters &parameters,
                            const UniformMaterial &material,
                            const std::string &shortened);

/** Memory of the histories, which are kept until the end of a transient run. */
ResourceNeed history_memory(const ContactParameters &parameters,
                            const UniformMaterial &material,
                            const double n_steps);

/** Disk space of dynamics.h5 and the checkpoints of a transient run, when it is largest.
 */
ResourceNeed dynamics_file_size(const ContactParameters &parameters,
                                const UniformMaterial &material,
                                const double n_steps);
} // namespace mesoslip

#endif
