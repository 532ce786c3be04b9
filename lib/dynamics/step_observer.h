#ifndef mesoslip_dynamics_step_observer_h
#define mesoslip_dynamics_step_observer_h

#include <cstdint>

namespace mesoslip
{
/**
 * Something that looks at the whole body now and then. Between two steps that somebody
 * wants to see, the stepper is free to advance many steps at a time.
 */
class StepObserver
{
public:
  virtual ~StepObserver() = default;

  /** The first step >= @p n around which this observer wants to be called. */
  virtual std::uint64_t next_step(const std::uint64_t n) const = 0;

  /** The fields hold u_n and w_n. */
  virtual void before_step(const std::uint64_t n) = 0;

  /** The fields hold u_(n+1) and w_(n+1). */
  virtual void after_step(const std::uint64_t)
  {
  }
};

/** The first multiple of @p interval that is >= @p n. */
inline std::uint64_t next_multiple(const std::uint64_t n, const std::uint64_t interval)
{
  return (n + interval - 1) / interval * interval;
}
} // namespace mesoslip

#endif
