#include "sliding/transient/dynamics_output.h"

#include "base/exchange.h"
#include "exchange/datasets.h"
#include "grid/row_partition.h"
#include "program/run_context.h"
#include "sliding/transient/result_file.h"


namespace mesoslip
{
DynamicsOutput::DynamicsOutput(RunContext &context,
                               const ContactParameters &parameters,
                               const BodyDescription &body,
                               const TimeStepChoice &time)
  : RunOutput<2>(context, parameters, time)
  , body(body)
{
}

void DynamicsOutput::begin(const Stepper &of_stepper,
                           const std::uint64_t n_done,
                           ContactMapOutput<2> *map)
{
  if (!has_snapshots() && map == nullptr)
    return;
  stepper                  = &of_stepper;
  n_written                = n_done;
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

void DynamicsOutput::before_step(const std::uint64_t)
{
  const NodalField<double> whole =
    gather_rows(stepper->u, stepper->rows, stepper->communicator);
  if (context.root())
    {
      const auto scope = context.timer().scope("Writing snapshots");
      file->write_snapshot(n_written, whole);
    }
  ++n_written;
}

void DynamicsOutput::sync()
{
  on_root(context.communicator(), [&]() {
    if (file)
      file->sync();
  });
}

void DynamicsOutput::write(const TransientResult &run, const ContactMapOutput<2> *map)
{
  if (!file)
    file.emplace(DynamicsFile::create(context.file("dynamics.h5"), body));
  if (has_snapshots())
    {
      file->reserve_snapshots(n_written);
      file->complete_snapshots(snapshot_times());
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
