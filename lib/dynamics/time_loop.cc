#include "dynamics/time_loop.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
void
observed_step(ExplicitStepper &stepper, const std::vector<StepObserver *> &due)
{
  const std::uint64_t n = stepper.step_number();
  for (StepObserver *observer : due)
    observer->before_step(n);
  stepper.step();
  for (StepObserver *observer : due)
    observer->after_step(n);
}
} // namespace

std::uint64_t
run_time_loop(ExplicitStepper                                &stepper,
              const std::vector<StepObserver *>              &observers,
              const std::uint64_t                             n_end,
              const std::uint64_t                             control_interval,
              const std::function<bool(const std::uint64_t)> &keep_going)
{
  std::vector<StepObserver *> due;
  std::uint64_t               n = stepper.step_number();
  while (n < n_end)
    {
      const std::uint64_t control = std::min(n_end, next_multiple(n + 1, control_interval));
      while (n < control)
        {
          std::uint64_t next = control;
          for (const StepObserver *observer : observers)
            next = std::min(next, observer->next_step(n));
          if (next > n)
            stepper.advance(next - n);
          n = next;
          if (n == control)
            break;
          due.clear();
          for (StepObserver *observer : observers)
            if (observer->next_step(n) == n)
              due.push_back(observer);
          observed_step(stepper, due);
          ++n;
        }
      if (!keep_going(n))
        break;
    }
  return n;
}
} // namespace mesoslip
