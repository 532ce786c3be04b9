#ifndef mesoslip_simulation_time_step_choice_h
#define mesoslip_simulation_time_step_choice_h

#include "elasticity/explicit_stepper.h"
#include "elasticity/uniform_material.h"
#include "simulation/contact_parameters.h"

#include <cstdint>
#include <string>

namespace mesoslip
{
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

/** Whether a given time step is stable, as cheaply as can be told. @throws UserError */
void check_time_step(const ContactParameters &parameters,
                     const UniformMaterial &material);
} // namespace mesoslip

#endif
