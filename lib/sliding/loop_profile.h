#ifndef mesoslip_sliding_loop_profile_h
#define mesoslip_sliding_loop_profile_h

#include "base/timer.h"
#include "dynamics/stepper.h"
#include "dynamics/surface_condition.h"
#include "grid/halo.h"

#include <memory>
#include <vector>

namespace mesoslip
{
/** A @p Part of the time loop with its clock; derived classes time each call. */
template <class Part>
class Timed : public Part
{
public:
  using Interface = Part; ///< interface that is timed

  /** @p part and @p timer must outlive it. */
  Timed(Part &part, const char *name, Timer &timer)
    : part(part)
    , name(name)
    , timer(timer)
  {
  }

protected:
  Part &part;             ///< wrapped object
  const char *const name; ///< timer section
  Timer &timer;           ///< collects the times
};

/** A boundary condition with a clock. */
template <int dim>
struct TimedSurface : Timed<SurfaceCondition<dim>>
{
  using Timed<SurfaceCondition<dim>>::Timed;

  /** Advances the boundary by one step. */
  void advance(const SurfaceView<dim> &surface) override
  {
    const auto scope = this->timer.scope(this->name);
    this->part.advance(surface);
  }
};

/** Halo exchange with a clock. */
struct TimedHalo : Timed<Halo>
{
  using Timed::Timed;

  /** Starts sending. */
  void send(const Side side, const RowBlock &own) override
  {
    const auto scope = timer.scope(name);
    part.send(side, own);
  }

  /** Waits for the neighbour. */
  void receive(const Side side, const RowBlock &ghosts) override
  {
    const auto scope = timer.scope(name);
    part.receive(side, ghosts);
  }

  /** Not timed: it is called every few rows. */
  void progress() override
  {
    part.progress();
  }
};

/** An observer with a clock. */
struct TimedObserver : Timed<StepObserver>
{
  using Timed::Timed;

  /** Not timed. */
  std::uint64_t next_step(const std::uint64_t n) const override
  {
    return part.next_step(n);
  }

  /** Calls the observer before a step. */
  void before_step(const std::uint64_t n) override
  {
    const auto scope = timer.scope(name);
    part.before_step(n);
  }

  /** Calls the observer after a step. */
  void after_step(const std::uint64_t n) override
  {
    const auto scope = timer.scope(name);
    part.after_step(n);
  }
};
/**
 * Wraps boundary conditions, halo exchange and observers of the time loop with clocks.
 * Each call costs some 50 ns, two or more a step, so only on request; without a timer
 * every part is returned as it is.
 */
class LoopProfile
{
public:
  /** @p timer may be null; otherwise it has to outlive the profile. */
  explicit LoopProfile(Timer *timer)
    : timer(timer)
  {
  }

  /** @p part, timed as @p name. The result is valid as long as @p part and this
   * profile. */
  template <class TimedPart>
  typename TimedPart::Interface *timed(typename TimedPart::Interface &part,
                                       const char *name)
  {
    if (timer == nullptr)
      return &part;
    wrappers.push_back(std::make_shared<TimedPart>(part, name, *timer));
    return static_cast<TimedPart *>(wrappers.back().get());
  }

  Timer *const timer; ///< null: timing is off

private:
  std::vector<std::shared_ptr<void>> wrappers;
};
} // namespace mesoslip

#endif
