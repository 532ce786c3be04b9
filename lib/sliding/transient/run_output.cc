#include "sliding/transient/run_output.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"
#include "material/engineering_constants.h"
#include "program/run_context.h"
#include "sliding/analyses/phases_of_contact.h"
#include "sliding/transient/result_file.h"

#include <algorithm>
#include <limits>
#include <set>

namespace mesoslip
{
namespace
{
const char snapshots_name[] = "/snapshots/displacement";
const char start_again[]    = "start again without --resume";

/** The file of a run that goes on after @p n_snapshots, without what was observed when it was stopped. */
Hdf5File continued_file(const std::string &path, const std::uint64_t n_snapshots)
{
  static const std::set<std::string> kept = {"mesh", "grid", "material", "snapshots",
                                             "contact_map"};
  Hdf5File file                           = Hdf5File::resume(path, start_again);
  if (n_snapshots > 0 && file.shape(snapshots_name, start_again)[0] < n_snapshots)
    throw UserError(path + " has fewer than the " + std::to_string(n_snapshots) +
                    " snapshots it had at the checkpoint; " + start_again);
  for (const std::string &name : file.list("/"))
    if (kept.count(name) == 0)
      file.remove("/" + name);
  return file;
}
} // namespace

template <int dim>
RunOutput<dim>::RunOutput(RunContext &context,
                          const GivenBody<dim> &body,
                          const TimeStepChoice &time,
                          const std::function<FieldRows()> &displacement)
  : context(context)
  , body(body)
  , time(time)
  , displacement(displacement)
  , steps(snapshot_steps(body.parameters, time))
  , path(context.file("dynamics.h5"))
{
}

template <int dim>
void RunOutput<dim>::begin(const std::uint64_t step,
                           const std::uint64_t n_done,
                           ContactMapOutput<dim> *map)
{
  n_written = n_done;
  std::vector<std::string> names;
  if (has_snapshots())
    names.emplace_back(snapshots_name);
  if (map != nullptr)
    for (const std::string &name : map->datasets())
      names.push_back(name);
  on_root(context.communicator(), [&]() {
    file.emplace(n_done > 0 || (map != nullptr && step > 0)
                   ? continued_file(path, n_done)
                   : body.create_file(path, dynamics_format));
    if (has_snapshots())
      file->reserve_rows(snapshots_name, snapshots_shape(steps.size()));
    if (map != nullptr)
      map->reserve(*file, time.n_steps);
    file->flush();
    if (names.empty())
      return;
    file->leave();
    file.reset();
  });
  for (const std::string &name : names)
    rows[name] = std::make_unique<ParallelRows>(path, name, context.communicator());
  if (map != nullptr)
    map->begin(step, [this](const std::string &name, const std::size_t first,
                            const std::vector<double> &values) {
      rows.at(name)->write_rows(first, values);
    });
}

template <int dim>
void RunOutput<dim>::write_phases()
{
  const ContactParts parts = body.contact_parts();
  PhasesOfContact phases;
  phases.names           = parts.names;
  phases.share           = parts.shares;
  phases.volume_fraction = body.facts().volume_fractions;
  for (const Phase<dim> &phase : body.facts().phases)
    {
      phases.youngs_modulus.push_back(
        closest_isotropic<dim>(phase.stiffness).young_modulus);
      if (body.parameters.friction.coefficient_by_phase)
        phases.friction.push_back(phase.friction_coefficient);
    }
  write_phases_of_contact(*file, phases);
}

template <int dim>
Shape RunOutput<dim>::snapshots_shape(const std::size_t n) const
{
  Shape shape = body.vectors_shape();
  shape.insert(shape.begin(), n);
  return shape;
}

template <int dim>
std::vector<double> RunOutput<dim>::snapshot_times() const
{
  std::vector<double> times;
  for (std::size_t k = 0; k < n_written; ++k)
    times.push_back(static_cast<double>(steps[k]) * time.step.dt);
  return times;
}

template <int dim>
std::uint64_t RunOutput<dim>::next_step(const std::uint64_t n) const
{
  const auto next = std::lower_bound(steps.begin(), steps.end(), n);
  return next == steps.end() ? std::numeric_limits<std::uint64_t>::max() : *next;
}

template <int dim>
void RunOutput<dim>::before_step(const std::uint64_t)
{
  const FieldRows own = displacement();
  const auto scope    = context.timer().scope("Writing snapshots");
  rows.at(snapshots_name)->write(n_written, own.first, own.values);
  ++n_written;
}

template <int dim>
void RunOutput<dim>::sync()
{
  if (!rows.empty())
    rows.begin()->second->sync();
  else
    on_root(context.communicator(), [&]() {
      if (file)
        file->sync();
    });
}

template <int dim>
void RunOutput<dim>::end()
{
  if (rows.empty())
    return;
  rows.clear();
  on_root(context.communicator(),
          [&]() { file.emplace(Hdf5File::resume(path, "start again")); });
}

template <int dim>
void RunOutput<dim>::write(const TransientResult &result,
                           const ContactMapOutput<dim> *map)
{
  if (map != nullptr)
    map->complete(*file, result.steps_done, time.step.dt);
  write_result(*file, result, context);
  body.write_contact(*file);
  if (body.facts().heterogeneous)
    write_phases();
  const std::vector<double> times = snapshot_times();
  if (has_snapshots())
    {
      file->reserve_rows(snapshots_name, snapshots_shape(n_written));
      write_dataset(*file, "/snapshots/time", {times.size()}, times, "s");
      file->write_unit(snapshots_name, "m");
    }
  std::vector<XdmfField> shown;
  if (!times.empty())
    shown = {{"displacement", snapshots_name, XdmfField::Values::nodes, {dim}}};
  body.show(path, shown, times);
  file->close();
  file.reset();
}

template class RunOutput<2>;
template class RunOutput<3>;
} // namespace mesoslip
