#include "observation/contact_shares.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace mesoslip
{
namespace
{
/** The earliest of the blocks that begin at @p from (s) or later, else the last one. */
std::size_t
first_block(const std::vector<NodeCounts> &blocks, const double dt, const double from)
{
  const auto inside = [&](const NodeCounts &block) {
    return block.first_step * dt >= from - 1e-9 * block.n_steps * dt;
  };
  const auto found = std::find_if(blocks.begin(), blocks.end() - 1, inside);
  return static_cast<std::size_t>(found - blocks.begin());
}
} // namespace

ContactSummary summarize_contact(const std::vector<NodeCounts> &blocks,
                                 const std::size_t n,
                                 const double dt,
                                 const double from)
{
  Assert(!blocks.empty(), dealii::ExcMessage("There is no block."));
  const std::size_t first = first_block(blocks, dt, from);
  double steps            = 0.;
  std::vector<double> stick(n, 0.), slip(n, 0.), landings(n, 0.);
  for (std::size_t b = first; b < blocks.size(); ++b)
    {
      steps += static_cast<double>(blocks[b].n_steps);
      for (std::size_t i = 0; i < n; ++i)
        {
          stick[i] += blocks[b].stick[i];
          slip[i] += blocks[b].slip[i];
          landings[i] += blocks[b].landings[i];
        }
    }

  ContactSummary summary;
  const double end       = (blocks.back().first_step + blocks.back().n_steps) * dt;
  const double time_step = (end - blocks[first].first_step * dt) / steps;
  const double n_nodes   = static_cast<double>(n);
  double contact_time = 0., episodes = 0., landed = 0.;
  for (std::size_t i = 0; i < n; ++i)
    {
      const ContactShares shares = {slip[i] / steps, stick[i] / steps,
                                    (steps - slip[i] - stick[i]) / steps};
      summary.node_shares.push_back(shares);
      summary.shares.slip += shares.slip;
      summary.shares.stick += shares.stick;
      summary.shares.separation += shares.separation;
      contact_time += (slip[i] + stick[i]) * time_step;
      episodes += landings[i];
      landed += landings[i] > 0. ? 1. : 0.;
    }
  for (double *share :
       {&summary.shares.slip, &summary.shares.stick, &summary.shares.separation})
    *share /= n_nodes;
  summary.duration = {episodes > 0. ? contact_time / episodes : contact_time,
                      landed / n_nodes};
  return summary;
}

std::string regime_label(const ContactShares &shares)
{
  const double threshold = 0.01;
  const bool slips       = shares.slip >= threshold;
  const bool sticks      = shares.stick >= threshold;
  const bool separates   = shares.separation >= threshold;
  if (slips && sticks)
    return separates ? "stick-slip-separation" : "stick-slip";
  if (slips && separates)
    return shares.slip >= shares.separation
             ? "slip-separation, regime 1 (mostly slipping)"
             : "slip-separation, regime 2 (mostly separated)";
  if (sticks && separates)
    return "stick-separation";
  return slips ? "permanent slip" : sticks ? "permanent stick" : "permanent separation";
}
} // namespace mesoslip
