#include "sliding/transient/run_draft.h"

#include "exchange/datasets.h"
#include "sliding/transient/result_file.h"
#include "sliding/transient/run_needs.h"

#include <cmath>

namespace mesoslip
{
namespace
{
void write_snapshots(Hdf5File &file,
                     const std::vector<double> &times,
                     const Shape &points)
{
  const std::string name = "/snapshots/displacement";
  Shape shape            = points;
  shape.insert(shape.begin(), times.size());
  file.reserve_rows(name, shape);
  file.write_unit(name, "m");
  write_dataset(file, "/snapshots/time", {times.size()}, times, "s");
}

/** Guess of the start of the steady part: the middle of the run, as without a limit
 * cycle. With a limit cycle it may be earlier, which snapshots that end before the
 * middle require. */
double guessed_steady_from(const ContactParameters &parameters,
                           const std::vector<double> &snapshots)
{
  const double given  = parameters.observation.steady_from,
               middle = 0.5 * parameters.time.end_time;
  if (!std::isnan(given))
    return given;
  return snapshots.empty() || snapshots.back() >= middle ? middle : snapshots.front();
}
} // namespace

void write_static_draft(Hdf5File &file,
                        const ContactParameters &parameters,
                        const Shape &points,
                        const bool is_below)
{
  const RunConditions conditions = parameters.stated_conditions();
  write_run_conditions(file, is_below ? conditions_below(conditions) : conditions);
  write_snapshots(file, {0.}, points);
}

void write_transient_draft(Hdf5File &file,
                           const ContactParameters &parameters,
                           const TimeStepChoice &time,
                           const Shape &points,
                           const bool is_below)
{
  const double dt = time.step.dt;
  std::vector<double> snapshots;
  for (const std::uint64_t step : snapshot_steps(parameters, time))
    snapshots.push_back(static_cast<double>(step) * dt);
  const RunConditions conditions =
    conditions_of_result(parameters, dt, guessed_steady_from(parameters, snapshots),
                         static_cast<double>(time.n_steps) * dt, false);
  write_run_conditions(file, is_below ? conditions_below(conditions) : conditions);
  if (!snapshots.empty())
    write_snapshots(file, snapshots, points);
}

void add_draft_probe(Hdf5File &file,
                     const std::string &name,
                     const std::vector<double> &position,
                     const unsigned int interval,
                     const TimeStepChoice &time)
{
  const std::string group = "/probes/" + name;
  std::vector<double> times;
  for (std::uint64_t n = 0; n < time.n_steps; n += interval)
    times.push_back(static_cast<double>(n) * time.step.dt);
  write_series(file, group, {{"time", "s", &times}});
  const std::size_t n_components = position.size() * (position.size() + 1) / 2;
  for (const auto &[quantity, unit] : {std::pair{"strain", "-"}, {"stress", "Pa"}})
    {
      const std::string dataset = group + "/" + quantity;
      file.reserve_rows(dataset, {times.size(), n_components}, times.size());
      file.write_unit(dataset, unit);
    }
  file.write_attribute(group, "position", position);
}
} // namespace mesoslip
