#include "sliding/loop_profile.h"

#include "base/timer.h"

namespace mesoslip
{
namespace
{
/** Something of the loop, its name and the clock. */
template <class Part>
struct Timed
{
  Part &part;
  const char *name;
  Timer &timer;
};

struct TimedSurface : SurfaceCondition<2>, Timed<SurfaceCondition<2>>
{
  explicit TimedSurface(const Timed &timed)
    : Timed(timed)
  {
  }

  void advance(const SurfaceView<2> &surface) override
  {
    const auto scope = timer.scope(name);
    part.advance(surface);
  }
};

struct TimedHalo : Halo, Timed<Halo>
{
  explicit TimedHalo(const Timed &timed)
    : Timed(timed)
  {
  }

  void send(const Side side, const RowBlock &own) override
  {
    const auto scope = timer.scope(name);
    part.send(side, own);
  }

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

struct TimedObserver : StepObserver, Timed<StepObserver>
{
  explicit TimedObserver(const Timed &timed)
    : Timed(timed)
  {
  }

  std::uint64_t next_step(const std::uint64_t n) const override
  {
    return part.next_step(n);
  }

  void before_step(const std::uint64_t n) override
  {
    const auto scope = timer.scope(name);
    part.before_step(n);
  }

  void after_step(const std::uint64_t n) override
  {
    const auto scope = timer.scope(name);
    part.after_step(n);
  }
};

/** @p part itself or, with a @p timer, a TimedPart around it, kept in @p wrappers. */
template <class TimedPart, class Part>
Part *wrap(Part &part,
           const char *name,
           Timer *timer,
           std::vector<std::shared_ptr<void>> &wrappers)
{
  if (timer == nullptr)
    return &part;
  const auto timed = std::make_shared<TimedPart>(Timed<Part>{part, name, *timer});
  wrappers.push_back(timed);
  return timed.get();
}
} // namespace

SurfaceCondition<2> *LoopProfile::timed(SurfaceCondition<2> &surface, const char *name)
{
  return wrap<TimedSurface>(surface, name, clock, wrappers);
}

Halo *LoopProfile::timed(Halo &halo, const char *name)
{
  return wrap<TimedHalo>(halo, name, clock, wrappers);
}

StepObserver *LoopProfile::timed(StepObserver &observer, const char *name)
{
  return wrap<TimedObserver>(observer, name, clock, wrappers);
}
} // namespace mesoslip
