#include "sliding/transient/transient_run.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
unsigned int TransientRun::reference_node(const ContactParameters &parameters,
                                          const UniformGrid<2> &grid)
{
  const double wanted = parameters.observation.reference_x;
  const double x      = std::isnan(wanted) ? 0.5 * grid.extent(0) : wanted;
  return std::lround(std::clamp(x, 0., grid.extent(0)) / grid.spacing[0]);
}

SlidingSetup TransientRun::sliding_setup(const ContactParameters &parameters,
                                         const BodyDescription &body,
                                         const TimeStepChoice &time)
{
  SlidingSetup setup                 = static_cast<const SlidingSetup &>(parameters);
  setup.step                         = time.step;
  setup.contact.friction_coefficient = body.node_friction;
  setup.steps_per_block =
    std::max<std::uint64_t>(1, time.n_steps / parameters.observation.blocks);
  // The reference node and four more along the contact, for the judgement of the limit
  // cycle.
  setup.monitored_nodes = {reference_node(parameters, body.grid)};
  for (const unsigned int sixth : {1, 2, 4, 5})
    setup.monitored_nodes.push_back(sixth * body.grid.cells[0] / 6);
  return setup;
}

LimitCycleCriterion
TransientRun::limit_cycle_criterion(const ContactParameters &parameters,
                                    const UniformGrid<2> &grid)
{
  const ObservationParameters &o = parameters.observation;
  return {o.limit_cycle_periods, o.limit_cycle_windows, o.limit_cycle_tolerance,
          std::fabs(parameters.top.pressure.amplitude() * grid.extent(0) *
                    parameters.contact.flat_velocity.amplitude())};
}

std::vector<ProbeRecorder::Point> TransientRun::probe_points() const
{
  std::vector<ProbeRecorder::Point> points;
  for (const ProbeParameters &probe : parameters.observation.probes)
    {
      ProbeRecorder::Point point{probe.name, probe.position};
      if (probe.nearest_node)
        for (unsigned int d = 0; d < 2; ++d)
          point.position[d] =
            std::round(point.position[d] / description.grid.spacing[d]) *
            description.grid.spacing[d];
      points.push_back(point);
    }
  return points;
}

void TransientRun::set_initial_velocity()
{
  const NodeRows &rows  = body.rows;
  NodalField<double> &w = body.w;
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
