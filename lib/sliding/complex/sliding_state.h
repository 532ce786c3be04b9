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
  DofMask held;                   ///< constraints by sides, top and flat
  std::vector<Platen> platens;    ///< platens of top and sides; their nodes are in `held`
  SlidingNodesAtRest contact;     ///< nodes pressed on the flat
  std::vector<std::size_t> place; ///< index of each such node in ElasticBody::surface()
  std::vector<double> area;       ///< tributary area of each such node (m^2, in 2D m)
  std::size_t n_separated = 0;    ///< contact nodes without contact in this state
  double steepest_fall    = 0.;   ///< largest instantaneous -p d mu/d V (Pa s/m); 0: none
  double state_time       = 0.;   ///< see SlidingLaw::state_time
};

/** Solves the static contact with the sliding flat for given coefficients of the contact
 * nodes, in the order of the body. Collective. */
using StaticContact = std::function<StaticContactSolution(const std::vector<double> &)>;

/**
 * @p held are the constraints of sides and top, @p friction the coefficients of the
 * contact nodes in the order of the body. A law of the coefficient multiplies them by
 * its value over its reference, at the speed of the flat, the place, and the pressure of
 * the node in the static state. If the law depends on pressure, @p solve is called until
 * the coefficients converge. Separated nodes are free. Without @p solve, under a held
 * top, all nodes touch.
 * @throws UserError if no node touches, or for a law that steady sliding does not
 * support; NotConverged
 */
template <int dim>
SlidingState sliding_state(const ElasticBody<dim> &body,
                           const ContactParameters &parameters,
                           const DofMask &held,
                           const std::vector<double> &friction,
                           const StaticContact &solve);
} // namespace mesoslip

#endif
