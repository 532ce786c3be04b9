#include "sliding/transient/transient_setup.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
unsigned int reference_node(const ContactParameters &parameters,
                            const UniformGrid<2> &grid)
{
  const double wanted = parameters.observation.reference_x;
  const double x      = std::isnan(wanted) ? 0.5 * grid.extent(0) : wanted;
  return std::lround(std::clamp(x, 0., grid.extent(0)) / grid.spacing[0]);
}

SlidingSetup sliding_setup(const ContactParameters &parameters,
                           const Scene &scene,
                           const TimeStepChoice &time)
{
  const ObservationParameters &observation = parameters.observation;
  SlidingSetup setup;
  setup.step                         = time.step;
  setup.sides                        = parameters.sides;
  setup.contact.law                  = parameters.friction.law;
  setup.contact.friction_coefficient = scene.node_friction;
  setup.contact.flat_velocity        = parameters.friction.flat_velocity;
  setup.contact.gap                  = parameters.friction.gap;
  setup.top                          = parameters.top;
  setup.sweep                        = sweep_options(parameters);
  setup.periodic                     = parameters.periodic;
  setup.history_interval             = observation.history_interval;
  setup.energy_interval              = observation.energy_interval;
  setup.steps_per_block = std::max<std::uint64_t>(1, time.n_steps / observation.blocks);
  // The reference node and four more along the contact, for the judgement of the limit
  // cycle.
  setup.monitored_nodes = {reference_node(parameters, scene.grid)};
  for (const unsigned int sixth : {1, 2, 4, 5})
    setup.monitored_nodes.push_back(sixth * scene.grid.cells[0] / 6);
  return setup;
}

bool transmits_tangential_force(const TopSetup &top)
{
  return top.kind != TopSetup::Kind::pressure || top.lateral_held;
}

SweepOptions sweep_options(const ContactParameters &parameters)
{
  SweepOptions options;
  options.steps_at_once = parameters.wavefront;
  options.isa           = instruction_set(parameters.instruction_set);
  return options;
}

LimitCycleCriterion limit_cycle_criterion(const ContactParameters &parameters,
                                          const UniformGrid<2> &grid)
{
  LimitCycleCriterion c;
  c.periods         = parameters.observation.limit_cycle_periods;
  c.windows         = parameters.observation.limit_cycle_windows;
  c.tolerance       = parameters.observation.limit_cycle_tolerance;
  c.reference_power = std::fabs(parameters.top.pressure.amplitude() * grid.extent(0) *
                                parameters.friction.flat_velocity.amplitude());
  return c;
}

std::vector<ProbeRecorder::Point> probe_points(const ObservationParameters &observation,
                                               const UniformGrid<2> &grid)
{
  std::vector<ProbeRecorder::Point> points;
  for (const ProbeParameters &probe : observation.probes)
    {
      ProbeRecorder::Point point{probe.name, probe.position};
      if (probe.nearest_node)
        for (unsigned int d = 0; d < 2; ++d)
          point.position[d] =
            std::round(point.position[d] / grid.spacing[d]) * grid.spacing[d];
      points.push_back(point);
    }
  return points;
}

void set_initial_velocity(const ContactParameters &parameters,
                          const NodeRows &rows,
                          NodalField<double> &w)
{
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < rows.n_local(); ++j)
      std::fill_n(w.row(c, j), w.n_columns(), parameters.body.initial_velocity[c]);
  const auto hold = [&](const std::array<bool, 2> &held, const unsigned int column) {
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = 0; held[c] && j < rows.n_local(); ++j)
        w.row(c, j)[column] = 0.;
  };
  hold(parameters.sides.left_held, 0);
  hold(parameters.sides.right_held, w.n_columns() - 1);
  // What the top holds does not move from the start.
  const TopSetup::Kind kind = parameters.top.kind;
  const bool held_x         = transmits_tangential_force(parameters.top);
  if (rows.end == rows.n_global)
    for (unsigned int c = 0; c < 2; ++c)
      if (c == 0 ? held_x : kind == TopSetup::Kind::held)
        std::fill_n(w.row(c, rows.local(rows.n_global - 1)), w.n_columns(), 0.);
}
} // namespace mesoslip
