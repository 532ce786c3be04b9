#include "localization/snapshot_pass.h"

#include "base/timer.h"
#include "localization/strain_interpolation.h"

#include <algorithm>
#include <future>

namespace mesoslip
{
namespace
{
/** Bytes of snapshots of a batch, of which two are in memory, and the most snapshots that
 *  help. */
constexpr std::size_t batch_bytes = 32 << 20;
constexpr std::size_t max_batch   = 4;

/** The rows of a batch of snapshots. */
class Batch
{
public:
  Batch(const DynamicsFile &run, const UniformGrid<2> &target, const SnapshotWork &what)
    : source(run.grid)
    , snapshot_size(2 * source.n_nodes())
    , work(what)
    , constant(target.cells[0], 1, 3)
    , by_row(target.cells[1])
  {
    for (std::size_t p = 0; p < work.cells.size(); ++p)
      by_row[work.cells[p][1]].push_back(p);
    const std::size_t bytes = snapshot_size * sizeof(double);
    const auto most         = std::clamp<std::size_t>(batch_bytes / bytes, 1, max_batch);
    for (std::size_t b = 0; b < most; ++b)
      interpolations.emplace_back(source, target);
  }

  /** Snapshots at most. */
  std::size_t size() const
  {
    return interpolations.size();
  }

  void treat(const std::vector<double> &snapshots, SnapshotHistories &histories)
  {
    const std::size_t n = snapshots.size() / snapshot_size;
    std::vector<std::array<double, 3>> means;
    for (std::size_t b = 0; b < n; ++b)
      {
        const double *u = snapshots.data() + b * snapshot_size;
        interpolations[b].set_displacement(u);
        if (work.uniform != nullptr || work.mean_history)
          means.push_back(mean_strain(source, u));
        if (work.mean_history)
          histories.mean.insert(histories.mean.end(), means[b].begin(), means[b].end());
      }
    for (unsigned int j = 0; j < by_row.size(); ++j)
      {
        if (work.local != nullptr || !by_row[j].empty())
          for (std::size_t b = 0; b < n; ++b)
            treat_local(interpolations[b].row(j), j, histories);
        if (work.uniform != nullptr)
          for (std::size_t b = 0; b < n; ++b)
            treat_uniform(means[b], j);
      }
  }

private:
  void
  treat_local(const StrainRow &strain, const unsigned int j, SnapshotHistories &histories)
  {
    if (work.local != nullptr)
      work.local->add(j, strain);
    for (const std::size_t p : by_row[j])
      for (const double *component : strain)
        histories.cells[p].push_back(component[work.cells[p][0]]);
  }

  void treat_uniform(const std::array<double, 3> &mean, const unsigned int j)
  {
    for (unsigned int c = 0; c < 3; ++c)
      std::fill_n(constant.row(c, 0), constant.n_columns(), mean[c]);
    work.uniform->add(j, {{constant.row(0, 0), constant.row(1, 0), constant.row(2, 0)}});
  }

  const UniformGrid<2> source;
  const std::size_t snapshot_size; ///< numbers
  const SnapshotWork &work;
  NodalField<double> constant;
  std::vector<StrainInterpolation> interpolations; ///< one for each snapshot
  std::vector<std::vector<std::size_t>>
    by_row; ///< numbers of the cells wanted in each row
};
} // namespace

SnapshotHistories pass_snapshots(const DynamicsFile &run,
                                 const IndexRange &range,
                                 const UniformGrid<2> &target,
                                 const SnapshotWork &work,
                                 const std::function<void(const std::size_t)> &tell_done,
                                 Timer *timer)
{
  Batch batch(run, target, work);
  SnapshotHistories histories;
  histories.cells.resize(work.cells.size());
  // HDF5 is used by one thread at a time: nobody else reads meanwhile.
  const auto start_reading = [&](const std::size_t first) {
    const std::size_t count = std::min(batch.size(), range.count - first);
    return std::async(std::launch::async, [&run, &range, first, count]() {
      return run.snapshots(range.first + first, count);
    });
  };
  auto next = start_reading(0);
  for (std::size_t done = 0; done < range.count;)
    {
      auto waiting         = optional_scope(timer, "Waiting for snapshots");
      const auto snapshots = next.get();
      waiting.reset();
      done += std::min(batch.size(), range.count - done);
      if (done < range.count)
        next = start_reading(done);
      const auto averaging = optional_scope(timer, "Averaging");
      batch.treat(snapshots, histories);
      tell_done(done);
    }
  const auto times = run.snapshot_times();
  const auto begin = times.begin() + static_cast<std::ptrdiff_t>(range.first);
  histories.time.assign(begin, begin + static_cast<std::ptrdiff_t>(range.count));
  return histories;
}
} // namespace mesoslip
