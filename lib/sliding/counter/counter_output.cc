#include "sliding/counter/counter_output.h"

#include "base/exchange.h"
#include "exchange/grid_file.h"
#include "exchange/run_description.h"
#include "sliding/transient/result_file.h"

namespace mesoslip
{
template <int dim>
CounterOutput<dim>::CounterOutput(const std::string &path,
                                  const GivenBody<dim> &body,
                                  const CounterMotion<dim> &motion,
                                  const std::vector<std::uint64_t> &steps,
                                  const double dt,
                                  Timer &timer)
  : snapshots(body, motion.displacement, steps, dt, timer)
  , path(path)
  , body(body)
  , communicator(motion.communicator)
{
}

template <int dim>
void CounterOutput<dim>::begin(const std::uint64_t n_done)
{
  on_root(communicator, [&]() {
    Hdf5File file = n_done > 0 ? Snapshots<dim>::continued(path, n_done)
                               : body.create_file(path, dynamics_format);
    snapshots.reserve(file);
    file.flush();
    file.leave();
  });
  snapshots.open(path, n_done, communicator);
}

template <int dim>
void CounterOutput<dim>::end()
{
  snapshots.close();
}

template <int dim>
void CounterOutput<dim>::write(const RunConditions &conditions,
                               const std::vector<ProbeHistory> &probes)
{
  Hdf5File file = Hdf5File::resume(path, "start again");
  snapshots.complete(file);
  write_run_conditions(file, conditions_below(conditions));
  write_probes(file, probes, dim);
  snapshots.show(path);
  file.close();
}

template class CounterOutput<2>;
template class CounterOutput<3>;
} // namespace mesoslip
