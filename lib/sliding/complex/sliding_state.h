#ifndef mesoslip_sliding_complex_sliding_state_h
#define mesoslip_sliding_complex_sliding_state_h

#include "contact/static_contact_solver.h"
#include "eigenvalues/complex/sliding_pencil.h"
#include "sliding/contact_parameters.h"

#include <vector>

namespace mesoslip
{
/** The static state of sliding about which a body vibrates. */
struct SlidingState
{
  DofMask held;                   ///< by sides, top and the flat
  SlidingNodesAtRest contact;     ///< nodes that are pressed on the flat
  std::vector<std::size_t> place; ///< of each of them in ElasticBody::surface()
  std::size_t n_separated = 0;    ///< contact nodes that do not touch in this state
};

/**
 * @p held is what sides and top hold, @p solution the static contact with the sliding flat, @p
 * friction the coefficients of the contact nodes in the order of the body. Nodes that are
 * separated are free. Without a solution, under a top that is held, all nodes
 * touch. @throws UserError if no node does
 */
template <int dim>
SlidingState sliding_state(const ElasticBody<dim> &body,
                           const ContactParameters &parameters,
                           const DofMask &held,
                           const std::vector<double> &friction,
                           const StaticContactSolution *solution);
} // namespace mesoslip

#endif
