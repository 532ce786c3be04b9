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
  using Interface = Part; ///< of what is timed

  /** @p part and @p timer have to outlive it. */
  Timed(Part &part, const char *name, Timer &timer)
    : part(part)
    , name(name)
    , timer(timer)
  {
  }

protected:
  Part &part;             ///< what is timed
  const char *const name; ///< of the section
  Timer &timer;           ///< gets the times
};

/** A boundary condition. */
template <int dim>
struct TimedSurface : Timed<SurfaceCondition<dim>>
{
  using Timed<SurfaceCondition<dim>>::Timed;

  /** One step of the boundary. */
  void advance(const SurfaceView<dim> &surface) override
  {
    const auto scope = this->timer.scope(this->name);
    this->part.advance(surface);
  }
};

/** Sending to and waiting for neighbours. */
struct TimedHalo : Timed<Halo>
{
  using Timed::Timed;

  /** Starts to send. */
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

  /** Every few rows: too often for a clock. */
  void progress() override
  {
    part.progress();
  }
};

/** An observer. */
struct TimedObserver : Timed<StepObserver>
{
  using Timed::Timed;

  /** Is not timed. */
  std::uint64_t next_step(const std::uint64_t n) const override
  {
    return part.next_step(n);
  }

  /** What is observed before a step. */
  void before_step(const std::uint64_t n) override
  {
    const auto scope = timer.scope(name);
    part.before_step(n);
  }

  /** What is observed after a step. */
  void after_step(const std::uint64_t n) override
  {
    const auto scope = timer.scope(name);
    part.after_step(n);
  }
};
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
    : timer(timer)
  {
  }

  /** @p part, timed as @p name. The result lives as long as both. */
  template <class TimedPart>
  typename TimedPart::Interface *timed(typename TimedPart::Interface &part,
                                       const char *name)
  {
    if (timer == nullptr)
      return &part;
    wrappers.push_back(std::make_shared<TimedPart>(part, name, *timer));
    return static_cast<TimedPart *>(wrappers.back().get());
  }

  Timer *const timer; ///< null if nothing is timed

private:
  std::vector<std::shared_ptr<void>> wrappers;
};
} // namespace mesoslip

#endif
