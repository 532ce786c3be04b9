#include "localization/snapshot_pass.h"

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
  Batch(const RunFile &run, const UniformGrid<2> &target, const SnapshotWork &what)
    : source(run.grid())
    , work(what)
    , constant(target.cells[0], 1, 3)
    , by_row(target.cells[1])
  {
    for (std::size_t p = 0; p < work.cells.size(); ++p)
      by_row[work.cells[p][1]].push_back(p);
    const std::size_t bytes = snapshot_size() * sizeof(double);
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
    const std::size_t n = snapshots.size() / snapshot_size();
    for (std::size_t b = 0; b < n; ++b)
      interpolations[b].set_displacement(snapshot(snapshots, b));
    means.clear();
    if (work.uniform != nullptr || work.mean_history)
      for (std::size_t b = 0; b < n; ++b)
        means.push_back(mean_strain(source, snapshot(snapshots, b)));
    if (work.mean_history)
      for (const auto &mean : means)
        histories.mean.insert(histories.mean.end(), mean.begin(), mean.end());
    for (unsigned int j = 0; j < by_row.size(); ++j)
      {
        if (work.local != nullptr || !by_row[j].empty())
          treat_local(n, j, histories);
        if (work.uniform != nullptr)
          treat_uniform(n, j);
      }
  }

private:
  const double *snapshot(const std::vector<double> &all, const std::size_t b) const
  {
    return all.data() + b * snapshot_size();
  }

  /** Numbers. */
  std::size_t snapshot_size() const
  {
    return 2 * source.n_nodes();
  }

  void
  treat_local(const std::size_t n, const unsigned int j, SnapshotHistories &histories)
  {
    for (std::size_t b = 0; b < n; ++b)
      {
        const ConstRow strain = interpolations[b].row(j);
        if (work.local != nullptr)
          work.local->add(j, strain);
        for (const std::size_t p : by_row[j])
          {
            const unsigned int i = work.cells[p][0];
            histories.cells[p].insert(histories.cells[p].end(),
                                      {strain.xx[i], strain.yy[i], strain.xy[i]});
          }
      }
  }

  void treat_uniform(const std::size_t n, const unsigned int j)
  {
    for (std::size_t b = 0; b < n; ++b)
      {
        for (unsigned int c = 0; c < 3; ++c)
          std::fill_n(constant.row(c, 0), constant.n_columns(), means[b][c]);
        work.uniform->add(j,
                          {constant.row(0, 0), constant.row(1, 0), constant.row(2, 0)});
      }
  }

  UniformGrid<2> source;
  const SnapshotWork &work;
  NodalField<double> constant;
  /** One for each snapshot. */
  std::vector<StrainInterpolation> interpolations;
  std::vector<std::array<double, 3>> means;
  /** Numbers of the cells wanted in each row. */
  std::vector<std::vector<std::size_t>> by_row;
};
} // namespace

SnapshotHistories pass_snapshots(const RunFile &run,
                                 const IndexRange &range,
                                 const UniformGrid<2> &target,
                                 const SnapshotWork &work,
                                 const SnapshotCallback &callback,
                                 Timer *timer)
{
  Batch batch(run, target, work);
  const std::size_t at_once = batch.size();
  SnapshotHistories histories;
  histories.cells.resize(work.cells.size());
  // HDF5 is used by one thread at a time: nobody else reads meanwhile.
  const auto start_reading = [&](const std::size_t first) {
    const std::size_t count = std::min(at_once, range.count - first);
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
      const std::size_t count = std::min(at_once, range.count - done);
      done += count;
      if (done < range.count)
        next = start_reading(done);
      const auto averaging = optional_scope(timer, "Averaging");
      batch.treat(snapshots, histories);
      if (callback)
        callback(done);
    }
  const auto times = run.snapshot_times();
  const auto begin = times.begin() + static_cast<std::ptrdiff_t>(range.first);
  histories.time =
    std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(range.count));
  return histories;
}
} // namespace mesoslip
