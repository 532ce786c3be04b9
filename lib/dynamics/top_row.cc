#include "dynamics/top_row.h"

#include <algorithm>
#include <array>

namespace mesoslip
{
namespace
{
// Eight partial sums: the order is fixed, and the loop does not wait for one addition
// before it starts the next.
double sum_row(const double *values, const unsigned int n)
{
  std::array<double, 8> lanes = {};
  unsigned int i              = 0;
  for (; i + 8 <= n; i += 8)
    for (unsigned int l = 0; l < 8; ++l)
      lanes[l] += values[i + l];
  double sum = 0.;
  for (; i < n; ++i)
    sum += values[i];
  for (const double lane : lanes)
    sum += lane;
  return sum;
}
} // namespace

TopRow::TopRow(const TopSetup &setup,
               const StepParameters &step,
               const unsigned int n_columns)
  : setup(setup)
  , step(step)
  , n_distinct(setup.periodic ? n_columns - 1 : n_columns)
  , tributary(n_columns, setup.cell_width)
  , increment_x(n_columns, 0.)
  , increment_y(n_columns, 0.)
{
  if (!setup.periodic)
    tributary.front() = tributary.back() = 0.5 * setup.cell_width;
}

void TopRow::advance(const RowView &row)
{
  if (!started)
    initialize(row);

  const auto is_due = [&](const unsigned int interval) {
    return interval > 0 && row.step % interval == 0;
  };
  const bool sampled = is_due(setup.history_interval),
             handed  = is_due(setup.recent_interval);
  const double displacement =
    sampled || handed ? sum_row(row.uy, n_distinct) / n_distinct : 0.;

  work_this_step  = 0.;
  const bool held = setup.kind == TopSetup::Kind::held || row.time >= setup.hold_from;
  const Load load = held                                   ? hold(row)
                    : setup.kind == TopSetup::Kind::platen ? push_platen(row)
                                                           : push_nodes(row);
  total_work += work_this_step;
  const auto record = [&](TopHistory &history) {
    history.displacement.push_back(displacement);
    history.normal_force.push_back(load.normal);
    history.tangential_force.push_back(load.tangential);
    history.work.push_back(total_work);
  };
  if (sampled)
    record(samples);
  if (handed)
    record(recent);
}

void TopRow::initialize(const RowView &row)
{
  for (unsigned int i = 0; i < row.n_columns; ++i)
    {
      increment_x[i] = step.dt * row.wx[i];
      increment_y[i] = step.dt * row.wy[i];
    }
  moving_mass = setup.platen_mass;
  for (unsigned int i = 0; i < n_distinct; ++i)
    if (row.inverse_mass_y[i] > 0.)
      moving_mass += 1. / row.inverse_mass_y[i];
  started = true;
}

void TopRow::move_node(double &u, double &w, const double acceleration) const
{
  w += step.dt * acceleration;
  u += step.dt * w + (step.beta2 - 0.5) * step.dt * step.dt * acceleration;
}

TopRow::Load TopRow::push_nodes(const RowView &row)
{
  Load load;
  const double pressure = setup.pressure(row.time);
  for (unsigned int i = 0; i < row.n_columns; ++i)
    {
      const double force  = pressure * tributary[i];
      const double before = row.uy[i];
      move_node(row.uy[i], row.wy[i], -row.inverse_mass_y[i] * (force + row.fy[i]));
      const double increment = row.uy[i] - before;
      if (!setup.lateral_held)
        {
          const double left = row.ux[i];
          move_node(row.ux[i], row.wx[i], -row.inverse_mass_x[i] * row.fx[i]);
          increment_x[i] = row.ux[i] - left;
        }
      if (i < n_distinct)
        {
          work_this_step -= force * 0.5 * (increment + increment_y[i]);
          load.normal += force;
        }
      increment_y[i] = increment;
    }
  if (setup.lateral_held)
    load.tangential = -sum_row(row.fx, n_distinct);
  return load;
}

TopRow::Load TopRow::push_platen(const RowView &row)
{
  const double width = setup.cell_width * (row.n_columns - 1);

  Load load;
  load.normal               = setup.pressure(row.time) * width;
  load.tangential           = -sum_row(row.fx, n_distinct);
  const double acceleration = -(load.normal + sum_row(row.fy, n_distinct)) / moving_mass;

  double u = row.uy[0], w = row.wy[0];
  move_node(u, w, acceleration);
  const double increment = u - row.uy[0];
  work_this_step         = -load.normal * 0.5 * (increment + increment_y[0]);
  std::fill(increment_y.begin(), increment_y.end(), increment);
  platen_w = w;
  std::fill_n(row.uy, row.n_columns, u);
  std::fill_n(row.wy, row.n_columns, w);
  return load;
}

// Work of the force that stops the row at once. It acts during one step, along half the
// increment of the step before, and its acceleration -w / dt enters the energy for b >
// 1/2:
//     (m (-w / dt) + f) . increment / 2 + (b - 1/2) m w^2 / 2
void TopRow::stop(const RowView &row)
{
  const auto work = [&](const double m, const double w, const double increment,
                        const double f) {
    return 0.5 * ((f - m * w / step.dt) * increment + (step.beta2 - 0.5) * m * w * w);
  };
  const auto mass = [](const double inverse) { return inverse > 0. ? 1. / inverse : 0.; };
  for (unsigned int i = 0; i < n_distinct; ++i)
    work_this_step +=
      work(mass(row.inverse_mass_x[i]), row.wx[i], increment_x[i], row.fx[i]) +
      work(mass(row.inverse_mass_y[i]), row.wy[i], increment_y[i], row.fy[i]);
  work_this_step += work(setup.platen_mass, platen_w, increment_y[0], 0.);
}

TopRow::Load TopRow::hold(const RowView &row)
{
  if (!holding)
    stop(row);
  holding  = true;
  platen_w = 0.;
  std::fill_n(row.wx, row.n_columns, 0.);
  std::fill_n(row.wy, row.n_columns, 0.);

  Load load;
  load.normal     = -sum_row(row.fy, n_distinct);
  load.tangential = -sum_row(row.fx, n_distinct);
  return load;
}
} // namespace mesoslip
