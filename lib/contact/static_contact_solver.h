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
  held ///< by a side; no contact node
};

/** "separated", "stick", "slip", "held". */
inline std::string to_string(const ContactState state)
{
  const char *const names[] = {"separated", "stick", "slip", "held"};
  return names[static_cast<unsigned int>(state)];
}

/** A body at rest whose bottom is pressed on a rigid flat, normal to the last axis. */
struct StaticContactProblem
{
  /** What sides and top constrain; nothing of the contact. */
  DofMask constrained;

  /** Values of the constrained degrees of freedom (m) and the first guess of all others. */
  NodalField<double> displacement;

  /** External forces (N/m). */
  NodalField<double> force;

  /** Coulomb coefficient of each bottom node, in the order of ElasticBody::surface(). */
  std::vector<double> friction_coefficient;

  /** Distance of each of these nodes from the flat (m); empty: all of them touch it. */
  std::vector<double> gap = {};

  /** Of the springs between these nodes and the flat (N/m, in 2D Pa); empty: it is rigid. */
  std::vector<double> stiffness = {};

  /** Likewise of springs along the flat, of a flat at rest, through which nodes stick. */
  std::vector<double> tangential_stiffness = {};

  /**
   * Direction (+1, -1) along flat_direction in which the flat slides below the body: all contact
   * nodes slip. 0: the flat rests, nodes stick or slip against their own displacement from
   * reference.
   */
  int sliding = 0;

  /** Along x and y, of length one; x in 2D. */
  std::array<double, 2> flat_direction = {{1., 0.}};

  /**
   * On a flat at rest, of each node the displacement along the flat at which it sticks without friction (m), its dim - 1
   * components together: where it was after the last increment of the load, and further by what the friction then
   * stretched its spring, moved with the flat, unless a side holds it; what sides hold carries no friction then. Empty:
   * zero.
   */
  std::vector<double> reference = {};

  /** First guess of the state of each node; empty: all of them touch the flat. */
  std::vector<ContactState> state = {};

  /** First guess of the friction, as StaticContactSolution::tangential_force, or empty. */
  std::vector<double> friction = {};
};

/** How it is solved. */
struct StaticContactOptions
{
  /** Of the residual forces, and of the friction forces, as a share of the contact force.
   */
  double tolerance = 1e-8;

  unsigned int max_iterations = 500; ///< over contact states and friction

  /** Called before each iteration with their number so far; may throw to stop. */
  std::function<void(unsigned int)> before_iteration;
};

/** Equilibrium with contact. */
struct StaticContactSolution
{
  NodalField<double> displacement;  ///< m
  std::vector<double> normal_force; ///< N/m per node, positive when pressed
  /** N (2D: N/m) per node, on the body; its dim - 1 components together. */
  std::vector<double> tangential_force;

  std::vector<ContactState> state; ///< of each node

  unsigned int iterations        = 0;  ///< over contact states and friction
  unsigned int state_changes     = 0;  ///< iterations in which a node changed its state
  unsigned int solver_iterations = 0;  ///< of all linear solves
  double residual                = 0.; ///< of equilibrium, relative to the contact force
  double friction_change         = 0.; ///< of the last iteration, relative likewise
};

/**
 * Unilateral contact with Coulomb friction by an active-set iteration: contact nodes are
 * held along the normal, those that stick along the flat as well, those that slip carry mu times their
 * normal reaction of the iteration before, accelerated after Anderson, or, where friction turns on a
 * flat at rest, found by Newton's method. The states follow
 * the signs of reactions and penetrations until nothing changes. Where that fails, CondensedContact
 * is asked if it can.
 *
 * @throws NotConverged; NumericalFailure where it is certain that there is no equilibrium
 */
template <int dim>
StaticContactSolution solve_static_contact(const ElasticBody<dim> &body,
                                           StaticContactProblem problem,
                                           const StaticContactOptions &options);
} // namespace mesoslip

#endif
