#ifndef mesoslip_eigenvalues_complex_pencil_contact_h
#define mesoslip_eigenvalues_complex_pencil_contact_h

#include "eigenvalues/complex/contact_motion.h"

namespace mesoslip
{
/** Stiffness matrix of the contact springs (N/m, in 2D Pa), by unknowns. */
template <int dim>
RealMatrix springs_of(const ContactMotion<dim> &motion,
                      const SlidingNodesAtRest &contact);

/**
 * Adds friction forces, their targets and the drag to @p pencil. @p reactions are the
 * normal reactions of the nodes by unknowns, for K, C_d and K_s.
 */
template <int dim>
void add_contact(const ContactMotion<dim> &motion,
                 const std::array<RealMatrix, 3> &reactions,
                 const SlidingNodesAtRest &contact,
                 SlidingPencil &pencil);
} // namespace mesoslip

#endif
