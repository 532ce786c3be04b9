#include "dynamics/stability_monitor.h"

#include "base/exchange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
constexpr std::uint64_t longest_interval = 1024, shortest_interval = 64;
constexpr double too_much = 1e6;
// Of the boundary's works, which nearly cancel when the flat is very fast.
constexpr double round_off = 1e-9;
} // namespace

std::uint64_t StabilityMonitor::next_regular_step(const std::uint64_t n)
{
  if (n == 0)
    return 0;
  for (std::uint64_t early = shortest_interval; early < longest_interval; early *= 2)
    if (early >= n)
      return early;
  return next_multiple(n, longest_interval);
}

std::uint64_t StabilityMonitor::next_step(const std::uint64_t n) const
{
  std::uint64_t next = next_regular_step(n);
  for (const StepObserver *observer : guarded)
    next = std::min(next, observer->next_step(n));
  return next;
}

void StabilityMonitor::check(const std::uint64_t n)
{
  const Sums found = sums();
  if (!started)
    start = found.energy - found.gravity_work;
  started = true;
  // Running: in a blow-up the boundary may take away more than there ever was.
  supply = std::max({supply, start, start + found.put_in + found.gravity_work});
  if (std::isfinite(found.put_in) && std::isfinite(found.energy) &&
      found.energy <= too_much * supply)
    return;
  Runaway runaway = locate();
  runaway.energy  = found.energy;
  runaway.put_in  = supply;
  stop(runaway, n);
}

StabilityMonitor::Sums StabilityMonitor::sums() const
{
  const NodeRows &rows        = stepper.rows;
  const NodalField<double> &u = stepper.u, &w = stepper.w;
  const BoundaryWork work     = boundary_work();
  std::array<double, 3> local = {{0., 0., 0.}};
  std::vector<double> mass(u.n_columns());
  local[2] = work.external - work.friction - work.impact +
             round_off * (std::fabs(work.external) + std::fabs(work.friction));
  local[0] = stepper.elastic_energy();
  for (unsigned int j = rows.begin; j < rows.end; ++j)
    {
      stepper.mass_row(j, mass.data());
      for (unsigned int c = 0; c < 2; ++c)
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
  MPI_Allreduce(MPI_IN_PLACE, local.data(), 3, MPI_DOUBLE, MPI_SUM, stepper.communicator);
  return {local[0], local[1], local[2]};
}

// The same on all ranks: that of the rank with the fastest node, NaN being fastest.
Runaway StabilityMonitor::locate() const
{
  const NodeRows &rows        = stepper.rows;
  const NodalField<double> &u = stepper.u, &w = stepper.w;
  Runaway worst;
  double fastest = -1.;
  for (unsigned int j = rows.begin; j < rows.end; ++j)
    for (unsigned int c = 0; c < 2; ++c)
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
  broadcast_object(stepper.communicator, worst, best.rank);
  return worst;
}
} // namespace mesoslip
