#ifndef mesoslip_dynamics_stability_monitor_h
#define mesoslip_dynamics_stability_monitor_h

#include "base/exchange.h"
#include "dynamics/energy_audit.h"
#include "dynamics/stepper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <mpi.h>
#include <string>
#include <vector>

namespace mesoslip
{
/** Description of a diverged run; the same on all ranks. */
struct Runaway
{
  double energy =
    0.; ///< kinetic and elastic energy (J/m); infinite or NaN if a value is not finite
  double put_in = 0.; ///< largest available energy so far (J/m)

  /** Column of the fastest node, or of the first node with a value that is not finite. */
  unsigned int column    = 0;
  unsigned int row       = 0;  ///< row of the node
  unsigned int component = 0;  ///< 0: x, 1: y
  double displacement    = 0.; ///< m
  double velocity        = 0.; ///< velocity component (m/s)
};

/**
 * Stops a diverged run. Below the critical time step the energy E = w.M w / 2 + u.K u / 2
 * stays within a small multiple of the supplied energy (start, work of top, flat and body
 * force, minus friction and impact): with W = omega dt the discrete energy H of
 * EnergyAudit is at least (1 - b W^2 / 2) times its kinetic part. Above it E grows
 * without bound while H stays bounded. E beyond a million times the supply, i.e.
 * amplitudes a thousand times too large, and values that are not finite count as
 * divergence.
 *
 * Checks after 64, 128, ... 1024 steps, then every 1024 steps (well below 1 % of the
 * time), and before every step that a guarded observer records.
 */
class StabilityMonitor : public StepObserver
{
public:
  /**
   * @p stepper and @p boundary_work as for EnergyAudit. @p stop is called on all ranks
   * with the finding and the step number; it must throw.
   */
  StabilityMonitor(Stepper &stepper,
                   const std::function<BoundaryWork()> &boundary_work,
                   const std::function<void(const Runaway &, std::uint64_t)> &stop)
    : stepper(stepper)
    , boundary_work(boundary_work)
    , stop(stop)
  {
  }

  /** Checks the state before each step that @p observer records. */
  void guard(const StepObserver &observer)
  {
    guarded.push_back(&observer);
  }

  std::uint64_t next_step(const std::uint64_t n) const override
  {
    std::uint64_t next = next_regular_step(n);
    for (const StepObserver *observer : guarded)
      next = std::min(next, observer->next_step(n));
    return next;
  }

  /** Next regular step, without guarded observers. */
  static std::uint64_t next_regular_step(const std::uint64_t n)
  {
    if (n == 0)
      return 0;
    for (std::uint64_t early = shortest_interval; early < longest_interval; early *= 2)
      if (early >= n)
        return early;
    return next_multiple(n, longest_interval);
  }

  void before_step(const std::uint64_t n) override
  {
    check(n);
  }

  /** Checks u_n, w_n. Collective. */
  void check(const std::uint64_t n)
  {
    const Sums found = sums();
    if (!started)
      start = found.energy - found.gravity_work;
    started = true;
    // Running maximum: in a blow-up the boundary may extract more energy than was ever
    // supplied.
    supply = std::max({supply, start, start + found.put_in + found.gravity_work});
    if (std::isfinite(found.put_in) && std::isfinite(found.energy) &&
        found.energy <= too_much * supply)
      return;
    Runaway runaway = locate();
    runaway.energy  = found.energy;
    runaway.put_in  = supply;
    stop(runaway, n);
  }

  /** Saves or restores the supplied energy so far (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &start &supply &started;
  }

private:
  static constexpr std::uint64_t longest_interval = 1024, shortest_interval = 64;
  static constexpr double too_much = 1e6;
  // Relative to the works of the boundary, which nearly cancel if the flat is very fast.
  static constexpr double round_off = 1e-9;

  struct Sums
  {
    double energy = 0., gravity_work = 0., put_in = 0.;
  };

  Sums sums() const
  {
    const NodeRows &rows        = stepper.rows;
    const NodalField<double> &u = stepper.u, &w = stepper.w;
    const BoundaryWork work     = boundary_work();
    std::array<double, 3> local = {{0., 0., 0.}};
    std::vector<double> mass(u.n_columns());
    local[2] = work.pressed + work.external - work.friction - work.impact +
               round_off * (std::fabs(work.external) + std::fabs(work.friction));
    local[0] = stepper.elastic_energy();
    for (unsigned int j = rows.begin; j < rows.end; ++j)
      {
        stepper.mass_row(j, mass.data());
        for (unsigned int c = 0; c < u.n_components(); ++c)
          {
            const double *ur = u.row(c, rows.local(j)), *wr = w.row(c, rows.local(j));
            double kinetic = 0., moved = 0.;
            for (unsigned int i = 0; i < stepper.n_distinct; ++i)
              {
                kinetic += mass[i] * wr[i] * wr[i];
                moved += mass[i] * ur[i];
              }
            local[0] += 0.5 * kinetic;
            local[1] += stepper.parameters.acceleration[c] * moved;
          }
      }
    MPI_Allreduce(MPI_IN_PLACE, local.data(), 3, MPI_DOUBLE, MPI_SUM,
                  stepper.communicator);
    return {local[0], local[1], local[2]};
  }

  // The same on all ranks: the result of the rank with the fastest node; NaN counts as
  // fastest.
  Runaway locate() const
  {
    const NodeRows &rows        = stepper.rows;
    const NodalField<double> &u = stepper.u, &w = stepper.w;
    Runaway worst;
    double fastest = -1.;
    for (unsigned int j = rows.begin; j < rows.end; ++j)
      for (unsigned int c = 0; c < u.n_components(); ++c)
        for (unsigned int i = 0; i < u.n_columns(); ++i)
          {
            const double x = u.row(c, rows.local(j))[i], v = w.row(c, rows.local(j))[i];
            const double speed = std::isfinite(x) && std::isfinite(v)
                                   ? std::fabs(v)
                                   : std::numeric_limits<double>::infinity();
            if (speed > fastest)
              {
                fastest = speed;
                worst   = {0., 0., i, j, c, x, v};
              }
          }
    struct
    {
      double value;
      int rank;
    } mine = {fastest, 0}, best;
    MPI_Comm_rank(stepper.communicator, &mine.rank);
    MPI_Allreduce(&mine, &best, 1, MPI_DOUBLE_INT, MPI_MAXLOC, stepper.communicator);
    return mpi::broadcast(worst, best.rank, stepper.communicator);
  }


  Stepper &stepper;
  const std::function<BoundaryWork()> boundary_work;
  const std::function<void(const Runaway &, std::uint64_t)> stop;
  std::vector<const StepObserver *> guarded;
  double start  = 0.; ///< initial energy (J/m)
  double supply = 0.; ///< largest supplied energy (J/m)
  bool started  = false;
};

/**
 * Monitors the strains of a run in the regular steps of StabilityMonitor, and keeps the
 * largest.
 */
class DeformationWatch : public StepObserver
{
public:
  /**
   * Keeps a reference to @p stepper. @p found is called on all ranks with each result and
   * the step number; it may throw.
   */
  DeformationWatch(const Stepper &stepper,
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

  /** Computes the deformation of u_n. Collective. */
  void look(const std::uint64_t n)
  {
    const Deformation deformation = stepper.deformation();
    largest.add(deformation);
    found(deformation, n);
  }

  /** Largest strains so far. */
  const LargestStrain &so_far() const
  {
    return largest;
  }

  /** Saves or restores the largest values (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &largest;
  }

private:
  const Stepper &stepper;
  const std::function<void(const Deformation &, std::uint64_t)> found;
  LargestStrain largest;
};
} // namespace mesoslip

#endif
