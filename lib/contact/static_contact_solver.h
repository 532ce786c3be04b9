#ifndef mesoslip_contact_static_contact_solver_h
#define mesoslip_contact_static_contact_solver_h

#include "body/elastic_body.h"

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/** State of a contact node in equilibrium. */
enum class ContactState : unsigned char
{
  separated,
  stick,
  slip,
  held ///< constrained by a side, hence no contact node
};

/** Name of a state: "separated", "stick", "slip", "held". */
inline std::string to_string(const ContactState state)
{
  const char *const names[] = {"separated", "stick", "slip", "held"};
  return names[static_cast<unsigned int>(state)];
}

/**
 * Static problem of a body whose bottom is pressed on a rigid flat, normal to the last
 * axis.
 */
struct StaticContactProblem
{
  /** Constraints of sides and top, without contact. */
  DofMask constrained;

  /** Values of constrained degrees of freedom (m), and initial guess of all others. */
  NodalField<double> displacement;

  /** External forces (N/m). */
  NodalField<double> force;

  /** Coulomb coefficient of each bottom node, in the order of ElasticBody::surface(). */
  std::vector<double> friction_coefficient;

  /** Gap of each bottom node (m); empty: all of them touch the flat. */
  std::vector<double> gap = {};

  /**
   * Normal springs between these nodes and the flat (N/m, in 2D Pa); empty: rigid flat.
   */
  std::vector<double> stiffness = {};

  /** Tangential springs through which nodes stick to a flat at rest (N/m, in 2D Pa). */
  std::vector<double> tangential_stiffness = {};

  /**
   * Direction (+1, -1) along flat_direction in which the flat slides below the body: all
   * contact nodes slip. 0: the flat rests; nodes stick, or slip against their own
   * displacement from reference.
   */
  int sliding = 0;

  /** Unit vector along x and y; x in 2D. */
  std::array<double, 2> flat_direction = {{1., 0.}};

  /**
   * On a flat at rest: tangential displacement at which each node sticks without friction
   * (m), dim - 1 components per node. It is the position after the last load increment
   * plus the stretch of the tangential spring by friction at that time. It moves with the
   * flat unless a side constrains the component; constrained components carry no
   * friction. Empty: zero.
   */
  std::vector<double> reference = {};

  /** Initial guess of the states; empty: all nodes touch the flat. */
  std::vector<ContactState> state = {};

  /**
   * Initial guess of the friction, as StaticContactSolution::tangential_force; may be
   * empty.
   */
  std::vector<double> friction = {};
};

/** Options of the iteration. */
struct StaticContactOptions
{
  /** Tolerance of residual forces and friction forces, relative to the contact force. */
  double tolerance = 1e-8;

  unsigned int max_iterations = 500; ///< limit for contact states and friction

  /**
   * Called before each iteration with the number of iterations so far; may throw to stop.
   */
  std::function<void(unsigned int)> before_iteration;
};

/** Solution of a static contact problem. */
struct StaticContactSolution
{
  NodalField<double> displacement;  ///< m
  std::vector<double> normal_force; ///< N/m per node, positive when pressed
  /** Force on the body per node (N, in 2D N/m); dim - 1 components per node. */
  std::vector<double> tangential_force;

  std::vector<ContactState> state; ///< state of each node

  unsigned int iterations        = 0;  ///< iterations for contact states and friction
  unsigned int state_changes     = 0;  ///< iterations in which a node changed its state
  unsigned int solver_iterations = 0;  ///< iterations of all linear solves
  double residual                = 0.; ///< residual relative to the contact force
  double friction_change         = 0.; ///< last change relative to the contact force
};

/**
 * Unilateral contact with Coulomb friction by an active-set iteration. Contact nodes are
 * constrained along the normal, sticking nodes also along the flat. Slipping nodes carry
 * mu times the normal reaction of the previous iteration, with Anderson acceleration; if
 * the direction of friction varies on a flat at rest, it is found by Newton's method.
 * States follow the signs of reactions and penetrations until nothing changes. If this
 * fails, CondensedContact is tried where applicable.
 *
 * @throws NotConverged; NumericalFailure if it is certain that there is no equilibrium
 */
template <int dim>
StaticContactSolution solve_static_contact(const ElasticBody<dim> &body,
                                           StaticContactProblem problem,
                                           const StaticContactOptions &options);
} // namespace mesoslip

#endif
