#include "sliding/transient/run_output.h"

#include "base/exchange.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"
#include "material/engineering_constants.h"
#include "program/run_context.h"
#include "sliding/analyses/phases_of_contact.h"
#include "sliding/transient/result_file.h"

#include <set>

namespace mesoslip
{
namespace
{
/** The file of a run that continues after @p n_snapshots; results written when the run
 * was stopped are removed. */
template <int dim>
Hdf5File continued_file(const std::string &path, const std::uint64_t n_snapshots)
{
  static const std::set<std::string> kept = {"mesh", "grid", "material", "snapshots",
                                             "contact_map"};
  Hdf5File file                           = Snapshots<dim>::continued(path, n_snapshots);
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
  : snapshots(body,
              displacement,
              snapshot_steps(body.parameters, time),
              time.step.dt,
              context.timer())
  , context(context)
  , body(body)
  , time(time)
  , path(context.file("dynamics.h5"))
{
}

template <int dim>
bool RunOutput<dim>::writes_files() const
{
  return !context.options().summary_only;
}

template <int dim>
void RunOutput<dim>::begin(const std::uint64_t step,
                           const std::uint64_t n_done,
                           ContactMapOutput<dim> *map)
{
  if (!writes_files())
    return;
  all_write = map != nullptr || snapshots.are_wanted();
  on_root(context.communicator(), [&]() {
    file.emplace(n_done > 0 || (map != nullptr && step > 0)
                   ? continued_file<dim>(path, n_done)
                   : body.create_file(path, dynamics_format));
    snapshots.reserve(*file);
    if (map != nullptr)
      map->reserve(*file, time.n_steps);
    file->flush();
    if (!all_write)
      return;
    file->leave();
    file.reset();
  });
  snapshots.open(path, n_done, context.communicator());
  if (map == nullptr)
    return;
  for (const std::string &name : map->datasets())
    rows[name] = std::make_unique<ParallelRows>(path, name, context.communicator());
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
void RunOutput<dim>::sync()
{
  if (!rows.empty())
    rows.begin()->second->sync(); // all datasets of the file
  else
    snapshots.sync();
  on_root(context.communicator(), [&]() {
    if (file)
      file->sync();
  });
}

template <int dim>
void RunOutput<dim>::end()
{
  if (!all_write)
    return;
  snapshots.close();
  rows.clear();
  all_write = false;
  on_root(context.communicator(),
          [&]() { file.emplace(Hdf5File::resume(path, "start again")); });
}

template <int dim>
void RunOutput<dim>::write(const TransientResult &result,
                           const ContactMapOutput<dim> *map)
{
  if (!writes_files())
    return;
  if (map != nullptr)
    map->complete(*file, result.steps_done, time.step.dt);
  write_result(*file, result, context);
  body.write_contact(*file);
  if (body.facts().heterogeneous)
    write_phases();
  snapshots.complete(*file);
  snapshots.show(path);
  file->close();
  file.reset();
}

template class RunOutput<2>;
template class RunOutput<3>;
} // namespace mesoslip
