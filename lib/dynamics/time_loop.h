#ifndef mesoslip_dynamics_time_loop_h
#define mesoslip_dynamics_time_loop_h

#include "dynamics/step_observer.h"
#include "dynamics/stepper.h"

#include <functional>
#include <vector>

namespace mesoslip
{
class Timer;

/**
 * Advances @p stepper until step @p n_end, calling the observers around the steps that
 * they ask for and @p keep_going every @p control_interval steps (and at the end).
 * With a @p timer the steps are timed. Returns the number of the next step: less than @p
 * n_end when @p keep_going said false.
 */
std::uint64_t run_time_loop(Stepper<2> &stepper,
                            const std::vector<StepObserver *> &observers,
                            const std::uint64_t n_end,
                            const std::uint64_t control_interval,
                            const std::function<bool(const std::uint64_t)> &keep_going,
                            Timer *timer = nullptr);
} // namespace mesoslip

#endif
