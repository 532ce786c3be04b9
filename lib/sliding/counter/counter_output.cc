#include "sliding/counter/counter_output.h"

#include "base/errors.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"

#include <algorithm>
#include <limits>

namespace mesoslip
{
namespace
{
const char dataset[]    = "/snapshots/displacement";
const char begin_anew[] = "start again without --resume";
} // namespace

template <int dim>
CounterOutput<dim>::CounterOutput(const std::string &path,
                                  const GivenBody<dim> &body,
                                  const std::function<FieldRows()> &displacement,
                                  const std::vector<std::uint64_t> &steps,
                                  const double dt)
  : path(path)
  , body(body)
  , displacement(displacement)
  , steps(steps)
  , dt(dt)
{
}

template <int dim>
Shape CounterOutput<dim>::shape(const std::size_t n) const
{
  Shape all = body.vectors_shape();
  all.insert(all.begin(), n);
  return all;
}

template <int dim>
void CounterOutput<dim>::begin(const std::uint64_t n_done)
{
  n_written       = n_done;
  const auto open = [&]() {
    return n_done > 0 ? Hdf5File::resume(path, begin_anew)
                      : body.create_file(path, dynamics_format);
  };
  Hdf5File file = open();
  if (n_done > 0 && file.shape(dataset, begin_anew)[0] < n_done)
    throw UserError(path + " has fewer than the " + std::to_string(n_done) +
                    " snapshots it had at the checkpoint; " + begin_anew);
  file.reserve_rows(dataset, shape(steps.size()));
  file.flush();
  file.leave();
  rows = std::make_unique<ParallelRows>(path, dataset, MPI_COMM_SELF);
}

template <int dim>
std::uint64_t CounterOutput<dim>::next_step(const std::uint64_t n) const
{
  const auto next = std::lower_bound(steps.begin(), steps.end(), n);
  return next == steps.end() ? std::numeric_limits<std::uint64_t>::max() : *next;
}

template <int dim>
void CounterOutput<dim>::before_step(const std::uint64_t)
{
  const FieldRows all = displacement();
  rows->write(n_written, all.first, all.values);
  ++n_written;
}

template <int dim>
void CounterOutput<dim>::sync()
{
  rows->sync();
}

template <int dim>
void CounterOutput<dim>::end()
{
  rows.reset();
  Hdf5File file = Hdf5File::resume(path, begin_anew);
  std::vector<double> times;
  for (std::size_t k = 0; k < n_written; ++k)
    times.push_back(static_cast<double>(steps[k]) * dt);
  file.reserve_rows(dataset, shape(n_written));
  write_dataset(file, "/snapshots/time", {times.size()}, times, "s");
  file.write_unit(dataset, "m");
  body.show(path, {{"displacement", dataset, XdmfField::Values::nodes, {dim}}}, times);
  file.close();
}

template class CounterOutput<2>;
template class CounterOutput<3>;
} // namespace mesoslip
