#include "sliding/transient/snapshots.h"

#include "base/errors.h"
#include "base/timer.h"
#include "exchange/datasets.h"

#include <algorithm>
#include <limits>

namespace mesoslip
{
namespace
{
const char snapshots_name[] = "/snapshots/displacement";
const char start_again[]    = "start again without --resume";
} // namespace

template <int dim>
Snapshots<dim>::Snapshots(const GivenBody<dim> &body,
                          const std::function<FieldRows()> &displacement,
                          const std::vector<std::uint64_t> &steps,
                          const double dt,
                          Timer &timer)
  : body(body)
  , displacement(displacement)
  , steps(steps)
  , dt(dt)
  , timer(timer)
{
}

template <int dim>
Hdf5File Snapshots<dim>::continued(const std::string &path, const std::uint64_t n_done)
{
  Hdf5File file = Hdf5File::resume(path, start_again);
  if (n_done > 0 && file.shape(snapshots_name, start_again)[0] < n_done)
    throw UserError(path + " has fewer than the " + std::to_string(n_done) +
                    " snapshots it had at the checkpoint; " + start_again);
  return file;
}

template <int dim>
Shape Snapshots<dim>::shape(const std::size_t n) const
{
  Shape all = body.vectors_shape();
  all.insert(all.begin(), n);
  return all;
}

template <int dim>
std::vector<double> Snapshots<dim>::times() const
{
  std::vector<double> all;
  for (std::size_t k = 0; k < written; ++k)
    all.push_back(static_cast<double>(steps[k]) * dt);
  return all;
}

template <int dim>
void Snapshots<dim>::reserve(Hdf5File &file) const
{
  if (are_wanted())
    file.reserve_rows(snapshots_name, shape(steps.size()));
}

template <int dim>
void Snapshots<dim>::open(const std::string &path,
                          const std::uint64_t n_done,
                          const MPI_Comm communicator)
{
  written = n_done;
  if (are_wanted())
    rows = std::make_unique<ParallelRows>(path, snapshots_name, communicator);
}

template <int dim>
std::uint64_t Snapshots<dim>::next_step(const std::uint64_t n) const
{
  const auto next = std::lower_bound(steps.begin(), steps.end(), n);
  return next == steps.end() ? std::numeric_limits<std::uint64_t>::max() : *next;
}

template <int dim>
void Snapshots<dim>::before_step(const std::uint64_t)
{
  const FieldRows own = displacement();
  const auto scope    = timer.scope("Writing snapshots");
  rows->write(written, own.first, own.values);
  ++written;
}

template <int dim>
void Snapshots<dim>::sync()
{
  if (rows)
    rows->sync();
}

template <int dim>
void Snapshots<dim>::close()
{
  rows.reset();
}

template <int dim>
void Snapshots<dim>::complete(Hdf5File &file) const
{
  if (!are_wanted())
    return;
  const std::vector<double> all = times();
  file.reserve_rows(snapshots_name, shape(written));
  write_dataset(file, "/snapshots/time", {all.size()}, all, "s");
  file.write_unit(snapshots_name, "m");
}

template <int dim>
void Snapshots<dim>::show(const std::string &path) const
{
  std::vector<XdmfField> shown;
  if (written > 0)
    shown = {{"displacement", snapshots_name, XdmfField::Values::nodes, {dim}}};
  body.show(path, shown, times());
}

template class Snapshots<2>;
template class Snapshots<3>;
} // namespace mesoslip
