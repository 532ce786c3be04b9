#include "sliding/transient/dynamics_output.h"

#include "base/exchange.h"
#include "exchange/datasets.h"
#include "grid/row_partition.h"
#include "program/run_context.h"
#include "sliding/transient/result_file.h"
#include "sliding/transient/run_needs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
DynamicsOutput::DynamicsOutput(RunContext &context,
                               const ContactParameters &parameters,
                               const BodyDescription &body,
                               const TimeStepChoice &time)
  : context(context)
  , body(body)
  , time(time)
  , steps(snapshot_steps(parameters, time))
{
}

void DynamicsOutput::begin(const Stepper &of_stepper,
                           const std::uint64_t n_done,
                           ContactMapOutput<2> *map)
{
  if (!has_snapshots() && map == nullptr)
    return;
  stepper                  = &of_stepper;
  n_snapshots              = n_done;
  const std::uint64_t step = stepper->step_number();
  on_root(context.communicator(), [&]() {
    const std::string path = context.file("dynamics.h5");
    file.emplace(n_done == 0 && (map == nullptr || step == 0)
                   ? DynamicsFile::create(path, body)
                   : DynamicsFile::resume(path, n_done));
    if (has_snapshots())
      file->reserve_snapshots(steps.size());
    if (map != nullptr)
      map->reserve(*file, time.n_steps);
    file->flush();
  });
  if (map != nullptr)
    map->begin(step, [this](const std::string &name, const std::size_t first,
                            const std::vector<double> &rows) {
      on_root(context.communicator(), [&]() { file->write_row(name, first, rows); });
    });
}

std::uint64_t DynamicsOutput::next_step(const std::uint64_t n) const
{
  const auto next = std::lower_bound(steps.begin(), steps.end(), n);
  return next == steps.end() ? std::numeric_limits<std::uint64_t>::max() : *next;
}

void DynamicsOutput::before_step(const std::uint64_t)
{
  const NodalField<double> whole =
    gather_rows(stepper->u, stepper->rows, stepper->communicator);
  if (!context.root())
    return;
  const auto scope = context.timer().scope("Writing snapshots");
  file->write_snapshot(n_snapshots++, whole);
}

std::uint64_t DynamicsOutput::save_snapshots()
{
  if (file)
    file->sync();
  return n_snapshots;
}

void DynamicsOutput::write(const TransientResult &run, const ContactMapOutput<2> *map)
{
  if (!file)
    file.emplace(DynamicsFile::create(context.file("dynamics.h5"), body));
  if (has_snapshots())
    {
      std::vector<double> times;
      for (std::size_t k = 0; k < n_snapshots; ++k)
        times.push_back(steps[k] * time.step.dt);
      file->reserve_snapshots(n_snapshots);
      file->complete_snapshots(times);
    }
  if (map != nullptr)
    map->complete(*file, run.steps_done, time.step.dt);
  write_result(*file, run, context);
  std::vector<double> x;
  for (unsigned int i = 0; i <= body.grid.cells[0]; ++i)
    x.push_back(i * body.grid.spacing[0]);
  // Of a node that is written twice each has half.
  std::vector<double> area = run.body.area;
  if (run.parameters.periodic)
    for (double *end : {&area.front(), &area.back()})
      *end *= 0.5;
  write_series(*file, "/contact", {{"x", "m", &x}, {"area", "m", &area}});
  file->close();
  file.reset();
}
} // namespace mesoslip
