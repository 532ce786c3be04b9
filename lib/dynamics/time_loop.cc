#include "dynamics/stepper.h"

#include "base/flush_denormals.h"
#include "base/timer.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Time without boundaries and neighbours is listed as the elastic body. */
void timed_steps(Stepper &stepper, const std::uint64_t n_steps, Timer *timer)
{
  const auto scope = optional_scope(timer, "Steps", "Elastic body");
  stepper.advance(n_steps);
}
} // namespace

std::uint64_t run_time_loop(Stepper &stepper,
                            const std::vector<StepObserver *> &observers,
                            const std::uint64_t n_end,
                            const std::uint64_t control_interval,
                            const std::function<bool(const std::uint64_t)> &keep_going,
                            Timer *timer)
{
  // Ahead of a wave front, numbers decay to subnormal ones, which make a step two to five
  // times slower.
  const FlushDenormals flush;
  std::vector<StepObserver *> due;
  std::uint64_t n = stepper.step_number();
  while (n < n_end)
    {
      const std::uint64_t control =
        std::min(n_end, next_multiple(n + 1, control_interval));
      while (n < control)
        {
          std::uint64_t next = control;
          for (const StepObserver *observer : observers)
            next = std::min(next, observer->next_step(n));
          if (next > n)
            timed_steps(stepper, next - n, timer);
          n = next;
          if (n == control)
            break;
          due.clear();
          for (StepObserver *observer : observers)
            if (observer->next_step(n) == n)
              due.push_back(observer);
          for (StepObserver *observer : due)
            observer->before_step(n);
          timed_steps(stepper, 1, timer);
          for (StepObserver *observer : due)
            observer->after_step(n);
          ++n;
        }
      if (!keep_going(n))
        break;
    }
  return n;
}
} // namespace mesoslip
