#ifndef mesoslip_dynamics_deformation_watch_h
#define mesoslip_dynamics_deformation_watch_h

#include "dynamics/deformation.h"
#include "dynamics/stability_monitor.h"
#include "dynamics/step_observer.h"

#include <cmath>
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
  /** @p u is referenced. @p found is called on all ranks with what each look finds and
   *  the number of the step; it may throw. */
  DeformationWatch(const UniformGrid<2> &grid,
                   const NodeRows &rows,
                   NodalField<double> &u,
                   const std::function<void(const Deformation &, std::uint64_t)> &found,
                   const MPI_Comm communicator);

  std::uint64_t next_step(const std::uint64_t n) const override
  {
    return StabilityMonitor::next_regular_step(n);
  }

  void before_step(const std::uint64_t n) override
  {
    look(n);
  }

  void after_step(const std::uint64_t) override
  {
  }

  /** Looks at u_n. Collective. */
  void look(const std::uint64_t n);

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
  const UniformGrid<2> grid;
  const NodeRows rows;
  NodalField<double> &u;
  const std::function<void(const Deformation &, std::uint64_t)> found;
  const MPI_Comm communicator;
  double largest = 0.;
};
} // namespace mesoslip

#endif
