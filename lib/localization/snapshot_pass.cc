#include "localization/snapshot_pass.h"

#include "base/timer.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>

namespace mesoslip
{
namespace
{
/**
 * Mean strain (engineering shear) of @p n bilinear cells between two rows of n + 1 nodes
 * whose displacements are stored as x, y, x, y, ...; the factors are 1/2 over the sides of
 * a cell (1/m).
 */
MESOSLIP_CLONES
void strain_row(const double *lower,
                const double *upper,
                const std::size_t n,
                const double x_factor,
                const double y_factor,
                double *__restrict__ xx,
                double *__restrict__ yy,
                double *__restrict__ xy)
{
  for (std::size_t i = 0; i < n; ++i)
    {
      const double *a = lower + 2 * i, *b = upper + 2 * i;
      xx[i] = x_factor * ((a[2] - a[0]) + (b[2] - b[0]));
      yy[i] = y_factor * ((b[1] - a[1]) + (b[3] - a[3]));
      xy[i] = y_factor * ((b[0] - a[0]) + (b[2] - a[2])) +
              x_factor * ((a[3] - a[1]) + (b[3] - b[1]));
    }
}

/** target += weight source */
MESOSLIP_CLONES
void add_scaled_row(const double *__restrict__ source,
                    const std::size_t n,
                    const double weight,
                    double *__restrict__ target)
{
  for (std::size_t i = 0; i < n; ++i)
    target[i] += weight * source[i];
}

/** target[i] = weight[2 i] source[first[i]] + weight[2 i + 1] source[first[i] + 1] */
MESOSLIP_CLONES
void gather_pairs_row(const double *__restrict__ source,
                      const unsigned int *__restrict__ first,
                      const double *__restrict__ weight,
                      const std::size_t n,
                      double *__restrict__ target)
{
  for (std::size_t i = 0; i < n; ++i)
    target[i] =
      weight[2 * i] * source[first[i]] + weight[2 * i + 1] * source[first[i] + 1];
}

/** Sum of a nodal quantity times the lengths that belong to n + 1 nodes in line. */
template <typename Value>
double integrate(const unsigned int n, const double h, const Value &value)
{
  double sum = 0.5 * (value(0) + value(n));
  for (unsigned int i = 1; i < n; ++i)
    sum += value(i);
  return h * sum;
}

constexpr unsigned int no_row = std::numeric_limits<unsigned int>::max();

StrainRow row_of(const NodalField<double> &arrays, const unsigned int j)
{
  return {{arrays.row(0, j), arrays.row(1, j), arrays.row(2, j)}};
}

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

AxisWeights::AxisWeights(const unsigned int n_source_cells, const unsigned int n_target)
  : n_source(n_source_cells)
{
  const bool whole = n_source % n_target == 0;
  width            = whole ? n_source / n_target : std::min(n_source, 2u);
  first.resize(n_target);
  weight.resize(std::size_t(n_target) * width);
  for (std::size_t i = 0; i < n_target; ++i)
    if (whole || n_source == 1)
      {
        first[i] = whole ? i * width : 0;
        std::fill_n(weight.begin() + std::ptrdiff_t(i) * width, width, 1. / width);
      }
    else
      {
        // Position of the centre among the source's cell centres.
        const double position = (i + 0.5) * n_source / n_target - 0.5;
        const double below    = std::clamp(std::floor(position), 0., n_source - 2.);
        first[i]              = static_cast<unsigned int>(below);
        weight[2 * i + 1]     = position - below;
        weight[2 * i]         = 1. - weight[2 * i + 1];
      }
}

std::array<double, 3> mean_strain(const UniformGrid<2> &grid, const double *u)
{
  const unsigned int nx = grid.cells[0], ny = grid.cells[1];
  // Differences between opposite sides of component c.
  const auto across = [&](const unsigned int c) {
    return integrate(ny, grid.spacing[1], [&](const std::size_t j) {
      const double *row = u + 2 * j * (nx + 1);
      return row[2 * nx + c] - row[c];
    });
  };
  const auto upward = [&](const unsigned int c) {
    const double *top = u + 2 * std::size_t(ny) * (nx + 1);
    return integrate(nx, grid.spacing[0],
                     [&](const std::size_t i) { return top[2 * i + c] - u[2 * i + c]; });
  };
  const double area = grid.extent(0) * grid.extent(1);
  return {{across(0) / area, upward(1) / area, (upward(0) + across(1)) / area}};
}

StrainInterpolation::StrainInterpolation(const UniformGrid<2> &source_grid,
                                         const UniformGrid<2> &target_grid)
  : source(source_grid)
  , target(target_grid)
  , x(source.cells[0], target.cells[0])
  , y(source.cells[1], target.cells[1])
  , scratch(source.cells[0], x.is_identity() ? 0 : 1, 3)
  , kept(target.cells[0], y.width, 3)
  , result(target.cells[0], 1, 3)
  , kept_row(y.width, no_row)
{
}

void StrainInterpolation::set_displacement(const double *u)
{
  displacement = u;
  std::fill(kept_row.begin(), kept_row.end(), no_row);
}

/** Row @p j of the source in the columns of the target. */
StrainRow StrainInterpolation::source_row(const unsigned int j)
{
  const unsigned int place = j % y.width;
  if (kept_row[place] == j)
    return row_of(kept, place);
  kept_row[place]            = j;
  const bool same_columns    = x.is_identity();
  NodalField<double> &strain = same_columns ? kept : scratch;
  const unsigned int in      = same_columns ? place : 0;
  const std::size_t n        = source.cells[0];
  const double *lower        = displacement + 2UL * j * (n + 1);
  strain_row(lower, lower + 2 * (n + 1), n, 0.5 / source.spacing[0],
             0.5 / source.spacing[1], strain.row(0, in), strain.row(1, in),
             strain.row(2, in));
  for (unsigned int c = 0; c < 3 && !same_columns; ++c)
    combine_columns(scratch.row(c, 0), kept.row(c, place));
  return row_of(kept, place);
}

StrainRow StrainInterpolation::row(const unsigned int j)
{
  if (y.width == 1)
    return source_row(y.first[j]);
  const std::size_t n = target.cells[0];
  for (unsigned int c = 0; c < 3; ++c)
    std::fill_n(result.row(c, 0), n, 0.);
  for (unsigned int k = 0; k < y.width; ++k)
    {
      const double weight  = y.weight[std::size_t(j) * y.width + k];
      const StrainRow part = source_row(y.first[j] + k);
      for (unsigned int c = 0; c < 3; ++c)
        add_scaled_row(part[c], n, weight, result.row(c, 0));
    }
  return row_of(result, 0);
}

void StrainInterpolation::combine_columns(const double *values, double *combined) const
{
  const std::size_t n = target.cells[0];
  if (x.width == 2)
    return gather_pairs_row(values, x.first.data(), x.weight.data(), n, combined);
  for (std::size_t i = 0; i < n; ++i)
    {
      const double *weight = x.weight.data() + i * x.width;
      double sum           = 0.;
      for (unsigned int k = 0; k < x.width; ++k)
        sum += weight[k] * values[x.first[i] + k];
      combined[i] = sum;
    }
}

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
