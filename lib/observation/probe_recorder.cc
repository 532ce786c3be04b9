#include "observation/probe_recorder.h"

#include "base/object_exchange.h"

namespace mesoslip
{
ProbeRecorder::ProbeRecorder(const Stepper &stepper,
                             const unsigned int n_components,
                             const std::uint64_t interval)
  : stepper(stepper)
  , n_components(n_components)
  , interval(interval)
{
}

void ProbeRecorder::add(const ProbeHistory &probe, const bool is_owned)
{
  histories.push_back(probe);
  owned.push_back(is_owned ? 1 : 0);
  w_before.push_back({});
}

void ProbeRecorder::before_step(const std::uint64_t n)
{
  if (n % interval != 0 || histories.empty())
    return;
  update_ghosts(stepper.u);
  update_ghosts(stepper.w);
  for (std::size_t k = 0; k < histories.size(); ++k)
    if (owned[k] != 0)
      {
        ProbeHistory &history = histories[k];
        const Vector value    = interpolate(stepper.u, k);
        history.time.push_back(static_cast<double>(n) * stepper.parameters.dt);
        history.displacement.insert(history.displacement.end(), value.begin(),
                                    value.begin() + n_components);
        sample_strain(k, history);
        w_before[k] = interpolate(stepper.w, k);
      }
}

// v_n = (1 - b) w_n + b w_(n+1); the contact forces of step n are known after it.
void ProbeRecorder::after_step(const std::uint64_t n)
{
  if (n % interval != 0 || histories.empty())
    return;
  update_ghosts(stepper.w);
  const double beta2 = stepper.parameters.beta2;
  for (std::size_t k = 0; k < histories.size(); ++k)
    if (owned[k] != 0)
      {
        const Vector w_after = interpolate(stepper.w, k);
        for (unsigned int c = 0; c < n_components; ++c)
          histories[k].velocity.push_back((1. - beta2) * w_before[k][c] +
                                          beta2 * w_after[c]);
        sample_contact(k, histories[k]);
      }
}

std::vector<ProbeHistory> ProbeRecorder::gather() const
{
  int rank = 0;
  MPI_Comm_rank(stepper.communicator, &rank);
  std::vector<ProbeHistory> all = histories;
  for (std::size_t k = 0; k < all.size(); ++k)
    {
      int owner = owned[k] != 0 ? rank : -1;
      MPI_Allreduce(MPI_IN_PLACE, &owner, 1, MPI_INT, MPI_MAX, stepper.communicator);
      bring_object_to_root(stepper.communicator, all[k], owner);
    }
  if (rank != 0)
    all.clear();
  return all;
}
} // namespace mesoslip
