#include "contact/contact_row.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
bool is_due(const std::uint64_t step, const unsigned int interval)
{
  return interval > 0 && step % interval == 0;
}

// Whether a node can have stuck, slipped and landed in so many of the steps.
bool are_counts(const double stick,
                const double slip,
                const double landings,
                const std::uint64_t steps)
{
  const auto is_count = [](const double x) { return x >= 0. && x == std::floor(x); };
  return is_count(stick) && is_count(slip) && is_count(landings) &&
         std::max(stick + slip, landings) <= static_cast<double>(steps);
}
} // namespace

ContactRow::ContactRow(const ContactSetup &setup, const StepParameters &step)
  : setup(setup)
  , step(step)
  , n_nodes(setup.friction_coefficient.size())
  , n_distinct(setup.periodic ? n_nodes - 1 : n_nodes)
  , values(n_nodes, n_columns_stored)
  , u_before_x(setup.monitored_nodes.size())
  , u_before_y(u_before_x)
  , w_before_x(u_before_x)
  , w_before_y(u_before_x)
  , steps_per_block(setup.steps_per_block)
{
  const double infinity = std::numeric_limits<double>::infinity();
  std::fill_n(column(gap), values.stride(), infinity);
  std::fill_n(column(gap), n_distinct, setup.gap);
  std::copy(setup.friction_coefficient.begin(), setup.friction_coefficient.end(),
            column(friction_coefficient));
  const Relaxation relaxation(step.dt, setup.law.time);
  std::fill_n(column(decay), values.stride(), relaxation.decay);
  std::fill_n(column(lag), values.stride(), relaxation.lag);
  samples.nodes.resize(setup.monitored_nodes.size());
  recent.nodes.resize(setup.monitored_nodes.size());
}

ContactArrays ContactRow::arrays(const RowView &row)
{
  ContactArrays a;
  a.n = (n_nodes + contact_lanes - 1) / contact_lanes * contact_lanes;

  a.internal_x           = row.fx;
  a.internal_y           = row.fy;
  a.inverse_mass_x       = row.inverse_mass_x;
  a.inverse_mass_y       = row.inverse_mass_y;
  a.u_x                  = row.ux;
  a.u_y                  = row.uy;
  a.w_x                  = row.wx;
  a.w_y                  = row.wy;
  a.gap                  = column(gap);
  a.friction_coefficient = column(friction_coefficient);
  a.decay                = column(decay);
  a.lag                  = column(lag);
  a.increment_x          = column(increment_x);
  a.increment_y          = column(increment_y);
  a.tangential_force     = column(tangential);
  a.target               = column(target);
  a.touching             = column(touching);
  a.normal_force         = column(normal);
  a.sticking             = column(sticking);
  a.stick_count          = column(stick_count);
  a.slip_count           = column(slip_count);
  a.landing_count        = column(landing_count);
  return a;
}

void ContactRow::advance(const RowView &row)
{
  const double flat_velocity = setup.flat_velocity(row.time);
  if (!started)
    initialize_increments(row);
  if (setup.law.node_law)
    setup.law.node_law->update(
      {n_nodes, row.wx, flat_velocity}, step.dt,
      {column(friction_coefficient), column(decay), column(lag)});

  const bool sampled = is_due(row.step, setup.history_interval);
  const bool handed  = is_due(row.step, setup.recent_interval);
  if (sampled || handed)
    remember(row);

  ContactSums sums;
  advance_nodes(arrays(row), {step.dt, step.beta2, flat_velocity * step.dt}, sums);

  if (setup.periodic)
    for (double *component : {row.ux, row.uy, row.wx, row.wy})
      component[n_nodes - 1] = component[0];

  total.friction += sums.friction_energy;
  total.impact += sums.impact_energy;
  total.flat += sums.tangential_force * flat_velocity * step.dt;
  count_step();
  if (sampled)
    record(row, sums, samples);
  if (handed)
    record(row, sums, recent);
}

ContactHistory ContactRow::take_recent()
{
  ContactHistory taken;
  taken.nodes.resize(recent.nodes.size());
  std::swap(taken, recent);
  return taken;
}

void ContactRow::remember(const RowView &row)
{
  for (std::size_t k = 0; k < setup.monitored_nodes.size(); ++k)
    {
      const unsigned int i = setup.monitored_nodes[k];
      u_before_x[k]        = row.ux[i];
      u_before_y[k]        = row.uy[i];
      w_before_x[k]        = row.wx[i];
      w_before_y[k]        = row.wy[i];
    }
}

bool ContactRow::is_consistent() const
{
  const ContactHistory &s = samples;
  const auto complete     = [&](const MonitoredNode &node) {
    return equally_long(s.step, node.ux, node.uy, node.vx, node.vy, node.normal_force) &&
           equally_long(s.step, node.tangential_force);
  };
  const auto of_all_nodes = [&](const NodeCounts &counts) {
    if (counts.stick.size() != n_nodes ||
        !equally_long(counts.stick, counts.slip, counts.landings))
      return false;
    for (std::size_t i = 0; i < n_nodes; ++i)
      if (!are_counts(counts.stick[i], counts.slip[i], counts.landings[i],
                      counts.n_steps))
        return false;
    return true;
  };
  for (std::size_t i = 0; i < n_nodes; ++i)
    if (!are_counts(column(stick_count)[i], column(slip_count)[i],
                    column(landing_count)[i], block.n_steps))
      return false;
  std::uint64_t next_step = 0;
  const auto follows      = [&](const NodeCounts &counts) {
    const bool right =
      counts.first_step == next_step && counts.n_steps <= counted_steps();
    next_step += counts.n_steps;
    return right;
  };
  return std::all_of(complete_blocks.begin(), complete_blocks.end(), follows) &&
         follows(block) && s.nodes.size() == setup.monitored_nodes.size() &&
         equally_long(s.step, s.time, s.normal_force, s.tangential_force, s.sticking) &&
         equally_long(s.step, s.slipping, s.separated, s.friction_energy,
                      s.impact_energy) &&
         equally_long(s.step, s.flat_work) &&
         std::all_of(s.nodes.begin(), s.nodes.end(), complete) &&
         std::all_of(complete_blocks.begin(), complete_blocks.end(), of_all_nodes);
}

// The work of the first step needs the increment before it.
void ContactRow::initialize_increments(const RowView &row)
{
  for (unsigned int i = 0; i < n_nodes; ++i)
    {
      column(increment_x)[i] = step.dt * row.wx[i];
      column(increment_y)[i] = step.dt * row.wy[i];
    }
  started = true;
}

void ContactRow::record(const RowView &row,
                        const ContactSums &sums,
                        ContactHistory &history) const
{
  history.step.push_back(row.step);
  history.time.push_back(row.time);
  history.normal_force.push_back(sums.normal_force);
  history.tangential_force.push_back(sums.tangential_force);
  history.sticking.push_back(sums.sticking);
  history.slipping.push_back(sums.slipping);
  history.separated.push_back(n_distinct - sums.sticking - sums.slipping);
  history.friction_energy.push_back(total.friction);
  history.impact_energy.push_back(total.impact);
  history.flat_work.push_back(total.flat);

  // v_n = w_n + b dt a_n = (1 - b) w_n + b w_(n+1)
  const double b = step.beta2;
  for (std::size_t k = 0; k < setup.monitored_nodes.size(); ++k)
    {
      const unsigned int i = setup.monitored_nodes[k];
      MonitoredNode &node  = history.nodes[k];
      node.ux.push_back(u_before_x[k]);
      node.uy.push_back(u_before_y[k]);
      node.vx.push_back((1. - b) * w_before_x[k] + b * row.wx[i]);
      node.vy.push_back((1. - b) * w_before_y[k] + b * row.wy[i]);
      node.normal_force.push_back(column(normal)[i]);
      node.tangential_force.push_back(column(tangential)[i]);
    }
}

void ContactRow::count_step()
{
  ++block.n_steps;
  if (steps_per_block > 0 && block.n_steps == steps_per_block)
    finish();
}

void ContactRow::finish()
{
  if (block.n_steps == 0)
    return;
  const auto take = [&](const Column c) {
    const std::vector<float> counts(column(c), column(c) + n_nodes);
    std::fill_n(column(c), values.stride(), 0.);
    return counts;
  };
  block.stick    = take(stick_count);
  block.slip     = take(slip_count);
  block.landings = take(landing_count);
  complete_blocks.push_back(block);
  block            = NodeCounts();
  block.first_step = complete_blocks.back().first_step + complete_blocks.back().n_steps;
}
} // namespace mesoslip
