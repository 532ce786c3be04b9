#ifndef mesoslip_sliding_complex_sliding_state_h
#define mesoslip_sliding_complex_sliding_state_h

#include "contact/static_contact_solver.h"
#include "eigenvalues/complex/sliding_pencil.h"
#include "eigenvalues/free_dofs.h"
#include "sliding/contact_parameters.h"

#include <functional>
#include <vector>

namespace mesoslip
{
/** The static state of sliding about which a body vibrates. */
struct SlidingState
{
  DofMask held;                   ///< by sides, top and the flat
  std::vector<Platen> platens;    ///< of top and sides; their nodes are held
  SlidingNodesAtRest contact;     ///< nodes that are pressed on the flat
  std::vector<std::size_t> place; ///< of each of them in ElasticBody::surface()
  std::vector<double> area;       ///< tributary of each of them (m^2, in 2D m)
  std::size_t n_separated = 0;    ///< contact nodes that do not touch in this state
  double steepest_fall    = 0.;   ///< largest -p d mu/d V at once (Pa s/m); 0: none
  double state_time       = 0.;   ///< SlidingLaw::state_time
};

/** The static contact with the sliding flat for these coefficients of the contact nodes in the
 * order of the body. Collective. */
using StaticContact = std::function<StaticContactSolution(const std::vector<double> &)>;

/**
 * @p held is what sides and top hold, @p friction the coefficients of the contact nodes in the order
 * of the body, which a law of the coefficient multiplies by its own one over its reference: that
 * at the speed of the flat, the place, and the pressure of the node in the static state. Where the
 * pressure takes part, @p solve is called until the coefficients do not change. Nodes that are
 * separated are free. Without @p solve, under a top that is held, all nodes
 * touch. @throws UserError if no node does, or for a law that is not known in steady sliding;
 * NotConverged
 */
template <int dim>
SlidingState sliding_state(const ElasticBody<dim> &body,
                           const ContactParameters &parameters,
                           const DofMask &held,
                           const std::vector<double> &friction,
                           const StaticContact &solve);
} // namespace mesoslip

#endif
