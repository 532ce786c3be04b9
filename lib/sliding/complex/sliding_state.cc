#include "sliding/complex/sliding_state.h"

#include "base/errors.h"

namespace mesoslip
{
template <int dim>
SlidingState sliding_state(const ElasticBody<dim> &body,
                           const ContactParameters &parameters,
                           const DofMask &held,
                           const std::vector<double> &friction,
                           const StaticContactSolution *solution)
{
  SlidingState state;
  state.held               = held;
  const ContactSetup &flat = parameters.contact;
  for (unsigned int c = 0; c < 2; ++c)
    state.contact.velocity[c] = flat.flat_velocity.amplitude() * flat.flat_direction[c];
  const SurfaceNodes<dim> &bottom = body.surface(ElasticBody<dim>::bottom);
  for (std::size_t k = 0; k + (bottom.closed ? 1 : 0) < bottom.nodes.size(); ++k)
    {
      const NodeIndex &node = bottom.nodes[k];
      if (held.is_constrained(dim - 1, node))
        continue; // by a side: no contact node
      if (solution != nullptr && solution->state[k] == ContactState::separated)
        {
          ++state.n_separated;
          continue;
        }
      state.held.constrain(dim - 1, node);
      state.contact.nodes.push_back(node);
      state.contact.friction.push_back(friction[k]);
      state.contact.normal_force.push_back(
        solution == nullptr ? 0. : solution->normal_force[k]);
      state.place.push_back(k);
    }
  body.copy_duplicates(state.held);
  if (state.contact.nodes.empty())
    throw UserError("no contact node touches the flat in the static state of sliding");
  return state;
}

template SlidingState sliding_state(const ElasticBody<2> &,
                                    const ContactParameters &,
                                    const DofMask &,
                                    const std::vector<double> &,
                                    const StaticContactSolution *);
template SlidingState sliding_state(const ElasticBody<3> &,
                                    const ContactParameters &,
                                    const DofMask &,
                                    const std::vector<double> &,
                                    const StaticContactSolution *);
} // namespace mesoslip
