#ifndef mesoslip_contact_contact_kernel_h
#define mesoslip_contact_contact_kernel_h

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
  const double *internal_x;
  const double *internal_y;
  const double *inverse_mass_x; ///< 0 where held
  const double *inverse_mass_y;
  double       *u_x;
  double       *u_y;
  double       *w_x;
  double       *w_y;

  // Constant in time.
  const double *gap; ///< initial distance to the flat (m)
  const double *friction_coefficient;

  // Constant in time unless the regularization depends on the slip rate.
  const double *decay; ///< exp(-dt / delta)

  // Displacement increments: of the step before, and predicted (m).
  double *increment_x;
  double *increment_y;

  // State: friction memory (N/m) and whether the node touched in the step before (1 or 0).
  double *tangential_force;
  double *touching;

  // Results: N/m, pressing on the node from below; 1 or 0.
  double *normal_force;
  double *sticking;

  // Counters of the running block of steps.
  double *stick_count;
  double *slip_count;
  double *landing_count;
};

/** The time step's constants as the kernels use them. */
struct ContactStep
{
  double dt;
  double beta2;
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
namespace x86_64
{
void advance(const ContactArrays &, const ContactStep &, ContactSums &);
}
namespace x86_64_v3
{
void advance(const ContactArrays &, const ContactStep &, ContactSums &);
}
namespace x86_64_v4
{
void advance(const ContactArrays &, const ContactStep &, ContactSums &);
}
} // namespace contact_kernels
} // namespace mesoslip

#endif
