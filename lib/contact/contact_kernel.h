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
 * inverse mass. Components are along x (0), normal to the contact (1) and, in 3D, along
 * y (2).
 */
struct ContactArrays
{
  /** What is kept for each node. */
  enum Column : unsigned int
  {
    // Constant in time, the last two unless the regularization depends on the slip rate, the first
    // unless the flat has a profile.
    gap,      ///< to the flat after this step, of the undeformed node (m)
    softness, ///< of the spring between node and flat (m^2/N, in 3D m/N), 0: rigid
    friction_coefficient, ///< Coulomb's, at least 0
    decay,                ///< weight of the friction memory, see Relaxation
    lag,                  ///< weight of the target's change, see Relaxation
    // Displacement increments: of the step before, and predicted (m).
    increment_x, ///< along x
    increment_y, ///< normal to it
    // State in the step before, 0 when separated; results of this step.
    tangential_force, ///< friction on the body along x (N/m)
    target,           ///< Coulomb's force on the body along x (N/m)
    touching,         ///< 1 or 0
    normal_force,     ///< N/m, pressing on the node from below, not negative
    sticking,         ///< 1: touches without sliding
    // Counters of the running block of steps.
    stick_count,   ///< steps stuck
    slip_count,    ///< steps slipped
    landing_count, ///< steps in which contact began
    // Of a flat with a profile, springs along it or those that are not linear, read by the kernels for these alone.
    rise,            ///< of the flat below the node in this step (m)
    rise_before,     ///< in the step before (m)
    slackness,       ///< of the spring along the flat (m^2/N, in 3D m/N), 0: rigid
    stretch,         ///< of that spring along x (m)
    stretch_before,  ///< a step ago (m)
    pressing,        ///< normal force on a node whose spring is not linear (N/m), else -1
    decided,         ///< whether it sticks if it touches, 1 or 0; -1: this is to be found
    n_plane_columns, ///< those above are all of a 2D contact
    // As those without the word, along y.
    lateral_increment = n_plane_columns, ///< m
    lateral_force,                       ///< N
    lateral_target,                      ///< N
    lateral_stretch,                     ///< m
    lateral_stretch_before,              ///< m
    n_columns
  };

  /** Number of columns in so many dimensions. */
  static constexpr unsigned int n_columns_in(const int dim)
  {
    return dim == 2 ? n_plane_columns : n_columns;
  }

  std::size_t n;                 ///< padded number of nodes
  const double *force[3];        ///< internal minus body forces (N/m)
  const double *inverse_mass[3]; ///< m/kg, 0 where constrained
  double *u[3];                  ///< displacement (m), in and out
  double *w[3];                  ///< velocity of the scheme (m/s), in and out
  double *column[n_columns];     ///< see Column
  double *trial
    [3]; ///< gets the forces of the step (N, in 2D N/m), which is not made then; null: it is made
};

/** The time step's constants as the kernels use them. */
struct ContactStep
{
  double dt;                           ///< s
  double beta2;                        ///< of the time scheme, 0.5 to 1
  double flat_increment[2];            ///< of the flat during the step, along x and y (m)
  double flat_increment_before[2];     ///< of the flat during the step before (m)
  double flat_direction[2] = {1., 0.}; ///< along which it moves, of length one
};

/** Sums over the row after one step; forces and energies are per unit thickness. */
struct ContactSums
{
  double normal_force     = 0.; ///< N/m
  double tangential_force = 0.; ///< N/m, on the body, along flat_direction
  double sticking         = 0.; ///< number of nodes
  double slipping         = 0.; ///< number of nodes
  double friction_energy  = 0.; ///< dissipated in this step (J/m)
  double impact_energy = 0.; ///< that the normal forces take for good in this step (J/m)
  double stored_energy = 0.; ///< in the springs after this step (J/m)
  double lifting_work =
    0.; ///< of the normal forces, as the flat rises in this step (J/m)
};

/**
 * One step of the contact row: predicts without contact, resolves the contact by forward
 * increment Lagrange multipliers, which on a rigid flat with lumped mass is a problem of
 * its own at every node (eqs 2, 4 and 7), and steps the row in time.
 *
 * Between node and flat there may be a spring of the stiffness k. With its compression h = max(0,
 * -gap), 1/k its softness and c / m what a unit force moves the node in the step, the force is
 *
 *     f = k [ (1 - phi/2) h_(n+1) + phi/2 h_(n-1) ],   phi = 1 / (1 + (k c / m)^2 / 16),
 *
 * solved with the step, which stays as long as on the rigid flat. It stores k/4 (h_(n+1)^2 + h_n^2)
 * and takes k/4 (1 - phi) (h_(n+1) - h_(n-1))^2 >= 0 for good, which vanishes with a higher order than
 * the error of the scheme. The stiffer the spring, the nearer to the flat the node ends; without one it
 * ends there.
 *
 * In 3D friction is a vector: Coulomb's force is along the slip at its instant, a mean of those
 * of the step before and of this one as friction leaves it, or along that without friction where
 * both point away from each other. The vector relaxes towards it, and as much of it is left away
 * as would move the node along it further than the flat.
 *
 * Along the flat there may be a spring as well, between the node and where it slides: it is stretched by what
 * slips without sliding, holds the node as the one along the normal does, and carries friction where the node
 * slides.
 *
 * Over a profile the flat rises and falls below the nodes, by known amounts in this step and the one
 * before: contact is where they end on its new height, and its motion does work.
 *
 * Where forces reach neighbours, the step is tried until they agree, in the first trial of which is decided which nodes stick:
 * friction that is remembered may be less than what would make a node stick, so that one that decides anew with its neighbours
 * might never end. One for which the force that makes it stick then exceeds the limit slides with the limit.
 *
 * Work is formed with the central increment (u_(n+1) - u_(n-1)) / 2, for which the
 * discrete energy balance is exact.
 */
using ContactFunction = void (*)(const ContactArrays &arrays,
                                 const ContactStep &step,
                                 ContactSums &sums);

/** One for each instruction set, see contact_function(). */
namespace contact_kernels
{
#define MESOSLIP_DECLARE_ADVANCE(name)                                                 \
  namespace name                                                                       \
  {                                                                                    \
  void advance(const ContactArrays &, const ContactStep &, ContactSums &);             \
  void advance_in_space(const ContactArrays &, const ContactStep &, ContactSums &);    \
  void advance_in_full(const ContactArrays &, const ContactStep &, ContactSums &);     \
  void                                                                                 \
  advance_in_full_in_space(const ContactArrays &, const ContactStep &, ContactSums &); \
  }
MESOSLIP_FOR_EACH_VARIANT(MESOSLIP_DECLARE_ADVANCE)
#undef MESOSLIP_DECLARE_ADVANCE
} // namespace contact_kernels
} // namespace mesoslip

#endif
