#include "observation/contact_shares.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace mesoslip
{
namespace
{
/** Indices [first, last) of the blocks that lie in the window; at least one. */
std::pair<std::size_t, std::size_t>
blocks_inside(const std::vector<ContactBlock> &blocks, const double from, const double to)
{
  std::size_t first = blocks.size(), last = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      const double slack = 1e-9 * (blocks[b].end - blocks[b].begin);
      if (blocks[b].begin >= from - slack && blocks[b].end <= to + slack)
        {
          first = std::min(first, b);
          last  = b + 1;
        }
    }
  if (first >= last)
    return {blocks.size() - 1, blocks.size()};
  return {first, last};
}

ContactDuration
duration_of(const double contact_time, const double landings, const double node_share)
{
  return {landings > 0. ? contact_time / landings : contact_time, landings, node_share};
}
} // namespace

ContactSummary summarize_contact(const std::vector<ContactBlock> &blocks,
                                 const double from,
                                 const double to,
                                 const std::vector<double> &weights)
{
  if (blocks.empty())
    throw std::invalid_argument("summarize_contact: no blocks");
  const std::size_t n = blocks.front().stick.size();
  if (!weights.empty() && weights.size() != n)
    throw std::invalid_argument("summarize_contact: one weight a node is needed");
  const auto [first, last] = blocks_inside(blocks, from, to);

  double steps = 0.;
  std::vector<double> stick(n, 0.), slip(n, 0.), landings(n, 0.);
  for (std::size_t b = first; b < last; ++b)
    {
      const ContactBlock &block = blocks[b];
      if (block.stick.size() != n || block.slip.size() != n || block.landings.size() != n)
        throw std::invalid_argument("summarize_contact: arrays of different lengths");
      steps += block.steps;
      for (std::size_t i = 0; i < n; ++i)
        {
          stick[i] += block.stick[i];
          slip[i] += block.slip[i];
          landings[i] += block.landings[i];
        }
    }
  if (!(steps > 0.))
    throw std::invalid_argument("summarize_contact: blocks without steps");

  ContactSummary summary;
  summary.begin = blocks[first].begin;
  summary.end   = blocks[last - 1].end;
  // Blocks follow each other, so that this is the time step.
  const double time_step = (summary.end - summary.begin) / steps;
  double total_weight = 0., contact_time = 0., episodes = 0., landed = 0.;
  for (std::size_t i = 0; i < n; ++i)
    {
      const double weight = weights.empty() ? 1. : weights[i];
      ContactShares shares;
      shares.slip       = slip[i] / steps;
      shares.stick      = stick[i] / steps;
      shares.separation = (steps - slip[i] - stick[i]) / steps;
      summary.node_shares.push_back(shares);
      summary.node_durations.push_back(duration_of(
        (slip[i] + stick[i]) * time_step, landings[i], landings[i] > 0. ? 1. : 0.));
      summary.shares.slip += weight * shares.slip;
      summary.shares.stick += weight * shares.stick;
      summary.shares.separation += weight * shares.separation;
      total_weight += weight;
      contact_time += (slip[i] + stick[i]) * time_step;
      episodes += landings[i];
      landed += landings[i] > 0. ? 1. : 0.;
    }
  summary.shares.slip /= total_weight;
  summary.shares.stick /= total_weight;
  summary.shares.separation /= total_weight;
  summary.duration = duration_of(contact_time, episodes, landed / static_cast<double>(n));
  return summary;
}

unsigned int nearest_node(const std::vector<double> &positions, const double x)
{
  if (positions.empty())
    throw std::invalid_argument("nearest_node: no nodes");
  unsigned int nearest = 0;
  for (unsigned int i = 1; i < positions.size(); ++i)
    if (std::abs(positions[i] - x) < std::abs(positions[nearest] - x))
      nearest = i;
  return nearest;
}
} // namespace mesoslip
