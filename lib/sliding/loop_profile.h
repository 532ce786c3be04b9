#ifndef mesoslip_sliding_loop_profile_h
#define mesoslip_sliding_loop_profile_h

#include "dynamics/stepper.h"
#include "dynamics/surface_condition.h"
#include "grid/halo.h"

#include <memory>
#include <vector>

namespace mesoslip
{
class Timer;

/**
 * Puts clocks around what the time loop calls: boundary conditions, exchange between ranks,
 * observers. Each call costs some 50 ns, two or more a step, so only on request; without
 * a timer everything is handed back as it is.
 */
class LoopProfile
{
public:
  /** @p timer may be null; otherwise it has to outlive the profile. */
  explicit LoopProfile(Timer *timer)
    : clock(timer)
  {
  }

  /** @p surface, timed as @p name. The result lives as long as both. */
  SurfaceCondition<2> *timed(SurfaceCondition<2> &surface, const char *name);

  /** The same for sending to and waiting for neighbours. */
  Halo *timed(Halo &halo, const char *name);

  /** The same for an observer. */
  StepObserver *timed(StepObserver &observer, const char *name);

  /** Null if nothing is timed. */
  Timer *timer() const
  {
    return clock;
  }

private:
  Timer *clock;
  std::vector<std::shared_ptr<void>> wrappers;
};
} // namespace mesoslip

#endif
