#include "localization/snapshot_pass.h"

#include "base/exchange.h"
#include "base/timer.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** A row of cells of equal strain. */
template <int dim>
class UniformRow
{
public:
  UniformRow(const std::size_t n_in_row, const VoigtVector<dim> &strain)
    : values(n_in_row, n_in_row, n_voigt<dim>)
  {
    for (unsigned int c = 0; c < n_voigt<dim>; ++c)
      std::fill_n(values.array(c, 0), n_in_row, strain[c]);
  }

  CellRow row() const
  {
    return {values.array(0, 0), values.stride()};
  }

private:
  CellRows values;
};

/** Processes the current batch of snapshots. */
template <int dim>
class SnapshotPass
{
public:
  SnapshotPass(StrainSource<dim> &of_run,
               const VolumeShare<dim> &of_rank,
               const SnapshotWork<dim> &what)
    : source(of_run)
    , share(of_rank)
    , work(what)
    , n_rows((share.n_cells + share.n_in_row - 1) / share.n_in_row)
    , followed_in_row(n_rows)
  {
    histories.cells.resize(work.followed.size());
    for (std::size_t p = 0; p < work.followed.size(); ++p)
      {
        const std::size_t k = share.place_of(work.followed[p]);
        if (k != share.elsewhere)
          followed_in_row[k / share.n_in_row].push_back(p);
      }
  }

  void treat(const std::size_t n)
  {
    for (std::size_t b = 0; b < n && work.mean; ++b)
      {
        const VoigtVector<dim> &mean = source.mean(b);
        histories.mean.insert(histories.mean.end(), mean.data(),
                              mean.data() + mean.size());
      }
    for (std::size_t j = 0; j < n_rows; ++j)
      if (work.local != nullptr || !followed_in_row[j].empty())
        for (std::size_t b = 0; b < n; ++b)
          treat_row(j, source.row(b, j));
    if (work.uniform != nullptr)
      add_uniform(*work.uniform, n,
                  [this](const std::size_t b) { return source.mean(b); });
    for (std::size_t p = 0; work.points != nullptr && p < work.points->size(); ++p)
      add_uniform((*work.points)[p], n,
                  [this, p](const std::size_t b) { return source.at_point(b, p); });
  }

  /** Histories of @p n_snapshots, on all ranks. */
  SnapshotHistories result(const std::size_t n_snapshots, const MPI_Comm ranks)
  {
    std::vector<double> all;
    const std::size_t size = n_snapshots * n_voigt<dim>;
    for (std::vector<double> &cell : histories.cells)
      {
        cell.resize(size); // zeros for cells of other ranks
        all.insert(all.end(), cell.begin(), cell.end());
      }
    sum_over_ranks(all, ranks);
    for (std::size_t p = 0; p < histories.cells.size(); ++p)
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(p * size), size,
                  histories.cells[p].begin());
    return std::move(histories);
  }

private:
  void treat_row(const std::size_t j, const CellRow &strain)
  {
    if (work.local != nullptr)
      work.local->add(j, strain);
    for (const std::size_t p : followed_in_row[j])
      for (unsigned int c = 0; c < n_voigt<dim>; ++c)
        histories.cells[p].push_back(
          strain(c, share.place_of(work.followed[p]) % share.n_in_row));
  }

  /** Adds the strain @p of (b) in all cells, of each of @p n snapshots. */
  template <typename Strain>
  void
  add_uniform(StressStatistics<dim> &statistics, const std::size_t n, const Strain &of)
  {
    std::vector<UniformRow<dim>> rows;
    for (std::size_t b = 0; b < n; ++b)
      rows.emplace_back(share.n_in_row, of(b));
    for (std::size_t j = 0; j < n_rows; ++j)
      for (const UniformRow<dim> &strain : rows)
        statistics.add(j, strain.row());
  }

  StrainSource<dim> &source;
  const VolumeShare<dim> &share;
  const SnapshotWork<dim> &work;
  const std::size_t n_rows;
  SnapshotHistories histories;
  std::vector<std::vector<std::size_t>> followed_in_row; ///< numbers among work.followed
};
} // namespace

template <int dim>
SnapshotHistories pass_snapshots(StrainSource<dim> &source,
                                 const VolumeShare<dim> &share,
                                 const SnapshotWork<dim> &work,
                                 const std::size_t n_snapshots,
                                 const LocalizationMonitor &monitor,
                                 const MPI_Comm ranks)
{
  SnapshotPass<dim> pass(source, share, work);
  for (std::size_t done = 0; done < n_snapshots;)
    {
      auto waiting        = optional_scope(monitor.timer, "Waiting for snapshots");
      const std::size_t n = source.next();
      waiting.reset();
      const auto averaging = optional_scope(monitor.timer, "Averaging");
      pass.treat(n);
      done += n;
      if (monitor.update)
        monitor.update(done);
    }
  return pass.result(n_snapshots, ranks);
}

template SnapshotHistories pass_snapshots(StrainSource<2> &,
                                          const VolumeShare<2> &,
                                          const SnapshotWork<2> &,
                                          const std::size_t,
                                          const LocalizationMonitor &,
                                          const MPI_Comm);
template SnapshotHistories pass_snapshots(StrainSource<3> &,
                                          const VolumeShare<3> &,
                                          const SnapshotWork<3> &,
                                          const std::size_t,
                                          const LocalizationMonitor &,
                                          const MPI_Comm);
} // namespace mesoslip
