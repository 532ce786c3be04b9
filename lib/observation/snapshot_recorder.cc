#include "observation/snapshot_recorder.h"

#include "grid/row_partition.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
SnapshotRecorder::SnapshotRecorder(const double from,
                                   const double to,
                                   const double interval,
                                   const double dt,
                                   const NodalField<double> &u,
                                   const NodeRows &rows,
                                   const MPI_Comm communicator,
                                   const Writer &writer)
  : dt(dt)
  , u(u)
  , rows(rows)
  , communicator(communicator)
  , writer(writer)
{
  // There is nothing between two steps.
  const double spacing = std::max(interval, dt);
  const auto n = static_cast<std::uint64_t>(std::floor((to - from) / spacing + 1e-6));
  for (std::uint64_t k = 0; k <= n && to >= from; ++k)
    {
      const auto step =
        static_cast<std::uint64_t>(std::llround((from + k * spacing) / dt));
      if (steps.empty() || step > steps.back())
        steps.push_back(step);
    }
}

std::uint64_t SnapshotRecorder::next_step(const std::uint64_t n) const
{
  const auto next = std::lower_bound(steps.begin(), steps.end(), n);
  return next == steps.end() ? std::numeric_limits<std::uint64_t>::max() : *next;
}

void SnapshotRecorder::before_step(const std::uint64_t)
{
  const NodalField<double> whole = gather_rows(u, rows, communicator);
  int rank                       = 0;
  MPI_Comm_rank(communicator, &rank);
  if (rank == 0)
    writer(whole);
}

std::vector<double> SnapshotRecorder::times() const
{
  std::vector<double> all;
  for (const std::uint64_t step : steps)
    all.push_back(step * dt);
  return all;
}
} // namespace mesoslip
