#include "contact/contact_recorder.h"

#include "base/exchange.h"
#include "dynamics/shared_nodes.h"

#include <type_traits>
#include <utility>

namespace mesoslip
{
namespace
{
constexpr unsigned int no_node = SharedNodes::none;
} // namespace

void sum_over_ranks(ContactHistory &samples, const MPI_Comm communicator)
{
  for (auto *values :
       {&samples.normal_force, &samples.tangential_force, &samples.sticking,
        &samples.slipping, &samples.separated, &samples.friction_energy,
        &samples.impact_energy, &samples.load_work})
    sum_over_ranks(*values, communicator);
  for (MonitoredNode &node : samples.nodes)
    for (auto *values : {&node.ux, &node.uy, &node.vx, &node.vy, &node.normal_force,
                         &node.tangential_force, &node.gap, &node.across.u,
                         &node.across.v, &node.across.force})
      sum_over_ranks(*values, communicator);
}

void turn_along_flat(ContactHistory &samples, const std::array<double, 2> &direction)
{
  const auto [c, s] = direction;
  if (s == 0.)
    return;
  for (MonitoredNode &node : samples.nodes)
    for (auto [along, across] :
         {std::pair(&node.ux, &node.across.u), std::pair(&node.vx, &node.across.v),
          std::pair(&node.tangential_force, &node.across.force)})
      for (std::size_t k = 0; k < along->size(); ++k)
        {
          const double x = (*along)[k], y = (*across)[k];
          (*along)[k]  = c * x + s * y;
          (*across)[k] = c * y - s * x;
        }
}

std::vector<NodeCounts> gather_nodes(const std::vector<NodeCounts> &blocks,
                                     const std::vector<unsigned int> &places,
                                     const std::size_t n_nodes,
                                     const bool with_loads,
                                     const MPI_Comm communicator)
{
  std::vector<NodeCounts> whole;
  const auto all_places = mpi::gather(places, communicator);
  for (const NodeCounts &block : blocks)
    {
      whole.push_back({block.first_step, block.n_steps, {}, {}, {}, {}});
      const auto gather_values = [&](const auto &values) {
        using Values = std::decay_t<decltype(values)>;
        const Values own(values.begin(), values.begin() + places.size());
        const auto of_ranks = mpi::gather(own, communicator);
        Values all(n_nodes);
        for (std::size_t rank = 0; rank < of_ranks.size(); ++rank)
          for (std::size_t i = 0; i < of_ranks[rank].size(); ++i)
            all[all_places[rank][i]] = of_ranks[rank][i];
        return all;
      };
      for (auto counts : {&NodeCounts::stick, &NodeCounts::slip, &NodeCounts::landings})
        whole.back().*counts = gather_values(block.*counts);
      if (with_loads)
        for (auto sums : {&NodeLoads::normal_force, &NodeLoads::friction_energy})
          whole.back().loads.*sums = gather_values(block.loads.*sums);
    }
  return whole;
}

template <int dim>
ContactRecorder<dim>::ContactRecorder(const unsigned int interval,
                                      const std::vector<unsigned int> &nodes,
                                      const StepParameters &step)
  : interval(interval)
  , nodes(nodes)
  , beta2(step.beta2)
  , motion_before(nodes.size())
{
  samples.nodes.resize(nodes.size());
}

template <int dim>
ContactHistory ContactRecorder<dim>::take()
{
  ContactHistory taken;
  taken.nodes.resize(nodes.size());
  std::swap(taken, samples);
  return taken;
}

template <int dim>
void ContactRecorder<dim>::before(const SurfaceView<dim> &surface)
{
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (unsigned int c = 0; c < dim && nodes[k] != no_node; ++c)
      {
        motion_before[k].u[c] = surface.u[c][nodes[k]];
        motion_before[k].w[c] = surface.w[c][nodes[k]];
      }
}

template <int dim>
void ContactRecorder<dim>::after(const SurfaceView<dim> &surface,
                                 ContactSurface<dim> &contact)
{
  const ContactSums &sums  = contact.sums();
  const BoundaryWork &work = contact.work();
  samples.step.push_back(surface.step);
  samples.time.push_back(surface.time);
  samples.normal_force.push_back(sums.normal_force);
  samples.tangential_force.push_back(sums.tangential_force);
  samples.sticking.push_back(sums.sticking);
  samples.slipping.push_back(sums.slipping);
  samples.separated.push_back(contact.n_distinct_nodes() - sums.sticking - sums.slipping);
  samples.friction_energy.push_back(work.friction);
  samples.impact_energy.push_back(work.impact);
  samples.load_work.push_back(work.load);

  constexpr unsigned int normal = dim - 1;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    {
      const unsigned int i = nodes[k];
      const bool here      = i != no_node;
      const Motion &before = motion_before[k];
      MonitoredNode &node  = samples.nodes[k];
      // v_n = w_n + b dt a_n = (1 - b) w_n + b w_(n+1)
      const auto velocity = [&](const unsigned int c) {
        return here ? (1. - beta2) * before.w[c] + beta2 * surface.w[c][i] : 0.;
      };
      const auto force = [&](const double *of_nodes) { return here ? of_nodes[i] : 0.; };
      node.ux.push_back(before.u[0]);
      node.uy.push_back(before.u[normal]);
      node.vx.push_back(velocity(0));
      node.vy.push_back(velocity(normal));
      node.normal_force.push_back(force(contact.normal_force()));
      node.tangential_force.push_back(force(contact.tangential_force()));
      node.gap.push_back(here ? contact.gap_before(surface, i) : 0.);
      if constexpr (dim == 3)
        {
          node.across.u.push_back(before.u[1]);
          node.across.v.push_back(velocity(1));
          node.across.force.push_back(force(contact.lateral_force()));
        }
    }
}

template <int dim>
void NodeStatistics<dim>::after(const SurfaceView<dim> &, ContactSurface<dim> &contact)
{
  ++n_steps;
  if (n_steps == steps_per_block)
    finish(contact);
}

template <int dim>
void NodeStatistics<dim>::finish(ContactSurface<dim> &contact)
{
  if (n_steps == 0)
    return;
  NodeCounts block = contact.take_counts();
  if (!complete_blocks.empty())
    block.first_step = complete_blocks.back().first_step + complete_blocks.back().n_steps;
  block.n_steps = std::exchange(n_steps, 0);
  if (node_loads != nullptr)
    block.loads = node_loads->loads();
  complete_blocks.push_back(std::move(block));
}

template class ContactRecorder<2>;
template class ContactRecorder<3>;
template class NodeStatistics<2>;
template class NodeStatistics<3>;
} // namespace mesoslip
