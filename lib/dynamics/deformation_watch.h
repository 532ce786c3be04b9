#ifndef mesoslip_dynamics_deformation_watch_h
#define mesoslip_dynamics_deformation_watch_h

#include "dynamics/stability_monitor.h"
#include "dynamics/step_observer.h"

#include <algorithm>
#include <functional>

namespace mesoslip
{
/**
 * Looks at the strains of a run in the regular steps of the StabilityMonitor, and keeps
 * the largest.
 */
class DeformationWatch : public StepObserver
{
public:
  /** @p stepper is referenced. @p found is called on all ranks with what each look finds
   *  and the number of the step; it may throw. */
  DeformationWatch(const Stepper<2> &stepper,
                   const std::function<void(const Deformation &, std::uint64_t)> &found)
    : stepper(stepper)
    , found(found)
  {
  }

  std::uint64_t next_step(const std::uint64_t n) const override
  {
    return StabilityMonitor::next_regular_step(n);
  }

  void before_step(const std::uint64_t n) override
  {
    look(n);
  }

  /** Looks at u_n. Collective. */
  void look(const std::uint64_t n)
  {
    const Deformation deformation = stepper.deformation();
    largest                       = std::max(largest, deformation.strain.value);
    found(deformation, n);
  }

  /** Largest norm of the strain of all looks so far [-]. */
  double largest_strain() const
  {
    return largest;
  }

  /** Saves or restores the largest strain (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &largest;
  }

private:
  const Stepper<2> &stepper;
  const std::function<void(const Deformation &, std::uint64_t)> found;
  double largest = 0.;
};
} // namespace mesoslip

#endif
