#include "sliding/transient/limit_cycle_watch.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
bool is_finite(const CycleSample &sample)
{
  return std::isfinite(sample.friction_energy + sample.normal_force +
                       sample.tangential_force + sample.kinetic_energy +
                       sample.elastic_energy) &&
         std::all_of(sample.displacement.begin(), sample.displacement.end(),
                     [](const double u) { return std::isfinite(u); });
}
} // namespace

LimitCycleWatch::LimitCycleWatch(const LimitCycleCriterion &criterion,
                                 const unsigned int n_nodes,
                                 const unsigned int energy_interval,
                                 const MPI_Comm communicator)
  : n_nodes(n_nodes)
  , energy_interval(energy_interval)
  , communicator(communicator)
  , cycle_detector(criterion)
{
}

void LimitCycleWatch::gather_energies(const EnergyHistory &local)
{
  const auto sum = [&](const std::vector<double> &part, std::vector<double> &all) {
    const std::size_t known = all.size();
    all.insert(all.end(), part.begin() + static_cast<std::ptrdiff_t>(known), part.end());
    MPI_Allreduce(MPI_IN_PLACE, all.data() + known, static_cast<int>(all.size() - known),
                  MPI_DOUBLE, MPI_SUM, communicator);
  };
  sum(local.kinetic, kinetic_energy);
  sum(local.elastic, elastic_energy);
}

void LimitCycleWatch::take(const ContactHistory &contact,
                           const std::size_t k,
                           CycleSample &sample) const
{
  sample.displacement.clear();
  for (const MonitoredNode &node : contact.nodes)
    sample.displacement.push_back(node.ux[k]);
  sample.time             = contact.time[k];
  sample.friction_energy  = contact.friction_energy[k];
  sample.normal_force     = contact.normal_force[k];
  sample.tangential_force = contact.tangential_force[k];
  sample.sticking         = contact.sticking[k] / n_nodes;
  sample.slipping         = contact.slipping[k] / n_nodes;
  if (!kinetic_energy.empty()) // the last one known at that step
    {
      const std::size_t e   = contact.step[k] / energy_interval;
      sample.kinetic_energy = kinetic_energy[e];
      sample.elastic_energy = elastic_energy[e];
    }
}

bool LimitCycleWatch::update(const ContactHistory &contact, const EnergyAudit *energy)
{
  if (energy != nullptr)
    gather_energies(energy->local_history());
  CycleSample next;
  for (std::size_t k = 0; k < contact.step.size(); ++k)
    if (contact.step[k] >= next_step)
      {
        take(contact, k, next);
        if (!is_finite(next))
          return false;
        cycle_detector.add(next);
        next_step = contact.step[k] + 1;
      }
  return true;
}
} // namespace mesoslip
