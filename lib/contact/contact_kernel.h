#ifndef mesoslip_contact_contact_kernel_h
#define mesoslip_contact_contact_kernel_h

#include "elasticity/kernel_variants.h"

#include <cstddef>

namespace mesoslip
{
/** Number of nodes that the contact kernel treats at a time; rows are padded to it. */
constexpr std::size_t contact_lanes = 8;

/**
 * Pointers to everything the contact kernels read and write, one value a node, 64-byte
 * aligned and padded to a multiple of contact_lanes. Padding has gap = infinity and no
 * inverse mass.
 */
struct ContactArrays
{
  std::size_t n; ///< padded number of nodes

  // The row of the body: internal minus body forces (N/m), inverse masses (m/kg), state.
  const double *internal_x;     ///< along the contact
  const double *internal_y;     ///< normal to it
  const double *inverse_mass_x; ///< 0 where held
  const double *inverse_mass_y; ///< 0 where held
  double *u_x;                  ///< displacement (m), in and out
  double *u_y;                  ///< displacement (m), in and out
  double *w_x;                  ///< velocity of the scheme (m/s), in and out
  double *w_y;                  ///< velocity of the scheme (m/s), in and out

  // Constant in time.
  const double *gap;                  ///< initial distance to the flat (m)
  const double *friction_coefficient; ///< Coulomb, at least 0

  // Constant in time unless the regularization depends on the slip rate; see Relaxation.
  const double *decay; ///< weight of the friction memory
  const double *lag;   ///< weight of the target's change

  // Displacement increments: of the step before, and predicted (m).
  double *increment_x; ///< along the contact
  double *increment_y; ///< normal to it

  // State: friction and its target in the step before, 0 when separated; whether the node
  // touched then.
  double *tangential_force; ///< on the body (N/m)
  double *target;           ///< Coulomb's force, on the body (N/m)
  double *touching;         ///< 1 or 0

  // Results: N/m, pressing on the node from below; 1 or 0.
  double *normal_force; ///< N/m, not negative
  double *sticking;     ///< 1: touches without sliding

  // Counters of the running block of steps.
  double *stick_count;   ///< steps stuck
  double *slip_count;    ///< steps slipped
  double *landing_count; ///< steps in which contact began
};

/** The time step's constants as the kernels use them. */
struct ContactStep
{
  double dt;             ///< s
  double beta2;          ///< of the time scheme, 0.5 to 1
  double flat_increment; ///< displacement of the flat during the step (m)
};

/** Sums over the row after one step; forces and energies are per unit thickness. */
struct ContactSums
{
  double normal_force     = 0.; ///< N/m
  double tangential_force = 0.; ///< N/m, on the body
  double sticking         = 0.; ///< number of nodes
  double slipping         = 0.; ///< number of nodes
  double friction_energy  = 0.; ///< dissipated in this step (J/m)
  double impact_energy    = 0.; ///< taken from the body by the normal forces (J/m)
};

/**
 * One step of the contact row: predicts without contact, resolves the contact by forward
 * increment Lagrange multipliers, which on a rigid flat with lumped mass is a problem of
 * its own at every node (eqs 2, 4 and 7), and steps the row in time.
 *
 * Work is formed with the central increment (u_(n+1) - u_(n-1)) / 2, for which the
 * discrete energy balance is exact.
 */
using ContactFunction = void (*)(const ContactArrays &arrays,
                                 const ContactStep &step,
                                 ContactSums &sums);

/** One for each instruction set, see contact_function.h. */
namespace contact_kernels
{
#define MESOSLIP_DECLARE_ADVANCE(name)                                     \
  namespace name                                                           \
  {                                                                        \
  void advance(const ContactArrays &, const ContactStep &, ContactSums &); \
  }
MESOSLIP_FOR_EACH_VARIANT(MESOSLIP_DECLARE_ADVANCE)
#undef MESOSLIP_DECLARE_ADVANCE
} // namespace contact_kernels
} // namespace mesoslip

#endif
