#ifndef mesoslip_dynamics_step_parameters_h
#define mesoslip_dynamics_step_parameters_h

#include <array>

namespace mesoslip
{
/** Constants of the beta2 scheme and of the bulk. */
struct StepParameters
{
  /** Time step (s). */
  double dt = 0.;

  /** 1/2: leapfrog, order two; up to 1: numerically damped. */
  double beta2 = 0.5;

  /** Stiffness-proportional damping C = beta K (s); zero costs nothing. */
  double beta = 0.;

  /** Body acceleration (m/s^2); zero costs nothing. */
  std::array<double, 2> acceleration = {};
};

/** Components of the leftmost and rightmost column whose acceleration is kept at zero. */
struct SideConstraints
{
  std::array<bool, 2> left_held  = {}; ///< x and y of the leftmost column
  std::array<bool, 2> right_held = {}; ///< x and y of the rightmost column
};
} // namespace mesoslip

#endif
