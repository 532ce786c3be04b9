#ifndef mesoslip_contact_contact_kernel_h
#define mesoslip_contact_contact_kernel_h

#include "elasticity/kernel_variants.h"

#include <cstddef>

namespace mesoslip
{
/** Number of nodes per vector of the contact kernel; rows are padded to a multiple. */
constexpr std::size_t contact_lanes = 8;

/**
 * Data of the contact kernels, one value per node, 64-byte aligned and padded to a
 * multiple of contact_lanes. Padding has gap = infinity and zero inverse mass. Components
 * are along x (0), normal to the contact (1) and, in 3D, along y (2).
 */
struct ContactArrays
{
  /** Data stored for each node. */
  enum Column : unsigned int
  {
    // Constant in time; gap varies with a profile of the flat, decay and lag with a
    // regularization that depends on the slip rate.
    gap,      ///< gap of the undeformed node after this step (m)
    softness, ///< compliance of the contact spring (m^2/N, in 3D m/N), 0: rigid
    friction_coefficient, ///< Coulomb coefficient, at least 0
    decay,                ///< weight of the friction memory, see Relaxation
    lag,                  ///< weight of the change of the target, see Relaxation
    // Displacement increments of the previous step, then predicted ones (m).
    increment_x, ///< increment along x
    increment_y, ///< increment along the normal
    // State of the previous step, 0 if separated; then result of this step.
    tangential_force, ///< friction on the body along x (N/m)
    target,           ///< Coulomb force on the body along x (N/m)
    touching,         ///< 1 or 0
    normal_force,     ///< normal force on the node (N/m), at least 0
    sticking,         ///< 1: touches without sliding, else 0
    // Counters of the current block of steps.
    stick_count,   ///< steps in which the node stuck
    slip_count,    ///< steps in which the node slipped
    landing_count, ///< steps in which contact began
    // For flats with a profile, tangential springs or nonlinear springs; read only by the
    // kernels for these cases.
    rise,            ///< height of the flat below the node in this step (m)
    rise_before,     ///< height in the previous step (m)
    slackness,       ///< compliance of the tangential spring (m^2/N, in 3D m/N), 0: rigid
    stretch,         ///< stretch of the tangential spring along x (m)
    stretch_before,  ///< stretch in the previous step (m)
    pressing,        ///< normal force of a nonlinear spring (N/m), else -1
    decided,         ///< whether the node sticks if it touches, 1 or 0; -1: undecided
    n_plane_columns, ///< number of columns of a 2D contact
    // Along y; otherwise as the columns of the same name.
    lateral_increment = n_plane_columns, ///< m
    lateral_force,                       ///< N
    lateral_target,                      ///< N
    lateral_stretch,                     ///< m
    lateral_stretch_before,              ///< m
    n_columns
  };

  /** Number of columns in @p dim dimensions. */
  static constexpr unsigned int n_columns_in(const int dim)
  {
    return dim == 2 ? n_plane_columns : n_columns;
  }

  std::size_t n;                 ///< padded number of nodes
  const double *force[3];        ///< internal minus body forces (N/m)
  const double *inverse_mass[3]; ///< 1/kg (in 2D m/kg), 0 where constrained
  double *u[3];                  ///< displacement (m), in and out
  double *w[3];                  ///< velocity of the scheme (m/s), in and out
  double *column[n_columns];     ///< columns, see Column
  double *trial[3]; ///< output: forces of a trial step (N, in 2D N/m); null: no trial
};

/** Constants of the time step. */
struct ContactStep
{
  double dt;                           ///< s
  double beta2;                        ///< parameter of the time scheme, 0.5 to 1
  double flat_increment[2];            ///< increment of the flat along x and y (m)
  double flat_increment_before[2];     ///< increment of the flat in the previous step (m)
  double flat_direction[2] = {1., 0.}; ///< unit vector of the flat's motion
};

/** Sums over the row after one step; forces and energies per unit thickness in 2D. */
struct ContactSums
{
  double normal_force     = 0.; ///< N/m
  double tangential_force = 0.; ///< N/m, on the body, along flat_direction
  double sticking         = 0.; ///< number of sticking nodes
  double slipping         = 0.; ///< number of slipping nodes
  double friction_energy  = 0.; ///< dissipated by friction in this step (J/m)
  double impact_energy    = 0.; ///< dissipated by normal forces in this step (J/m)
  double stored_energy    = 0.; ///< stored in the springs after this step (J/m)
  double lifting_work     = 0.; ///< work of the normal forces on the rising flat (J/m)
};

/**
 * Contact step of the row: prediction without contact, contact forces by
 * forward-increment Lagrange multipliers (eqs 2, 4 and 7), time step of the row. On a
 * rigid flat with lumped mass, the multipliers are a separate problem for each node.
 *
 * A spring of stiffness k may be between node and flat. With its compression h = max(0,
 * -gap), compliance 1/k and displacement c / m of the node by a unit force within the
 * step, the force is
 *
 *     f = k [ (1 - phi/2) h_(n+1) + phi/2 h_(n-1) ],   phi = 1 / (1 + (k c / m)^2 / 16),
 *
 * solved together with the step; the stable time step is the same as on the rigid flat.
 * The spring stores k/4 (h_(n+1)^2 + h_n^2) and dissipates k/4 (1 - phi) (h_(n+1) -
 * h_(n-1))^2 >= 0, which vanishes with a higher order than the error of the scheme. The
 * stiffer the spring, the closer to the flat the node ends; without a spring it ends on
 * the flat.
 *
 * In 3D friction is a vector. The Coulomb force has the direction of the slip at the same
 * instant, the mean of the slip of the previous step and of the current slip with
 * friction; if this mean is opposed to the slip without friction, it has the direction of
 * the latter. The friction vector relaxes towards the Coulomb force. Its excess is
 * removed if it would move the node along the force further than the flat.
 *
 * Tangential springs may connect a node to its sliding point on the flat. Slip without
 * sliding stretches the spring, which holds the node like the normal spring does, and
 * which carries the friction while the point slides.
 *
 * With a profile, the height of the flat below the nodes changes by known amounts in this
 * step and the previous one. Nodes in contact end on the new height; the motion of the
 * flat does work.
 *
 * If forces affect neighbours (coupled contact), trial steps are repeated until the
 * forces agree. The first trial decides which nodes stick: remembered friction may be
 * smaller than the force that makes a node stick, so that deciding again in each trial
 * might not terminate. A node whose sticking force exceeds the limit slides with the
 * limit.
 *
 * Work is computed with the central increment (u_(n+1) - u_(n-1)) / 2, for which the
 * discrete energy balance is exact.
 */
using ContactFunction = void (*)(const ContactArrays &arrays,
                                 const ContactStep &step,
                                 ContactSums &sums);

/** Kernels of each instruction set, see contact_function(). */
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
