#ifndef mesoslip_contact_condensed_contact_h
#define mesoslip_contact_condensed_contact_h

#include "contact/cone_newton.h"
#include "contact/equilibrium_solver.h"
#include "contact/static_contact_solver.h"

#include <Eigen/Dense>

#include <array>
#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * A static contact condensed to its nodes: forces of the flat on the nodes are F + S d,
 * with displacements d from the state in which all nodes touch and stick. Contact and
 * friction conditions form a linear complementarity problem, except in 3D on a flat at
 * rest, where friction may have any direction. Each column of S takes one solve.
 */
template <int dim>
class CondensedContact
{
public:
  /** Largest number of displacements for which condensation is used. */
  static constexpr std::size_t most = 600;

  /** @p body and @p problem must outlive this object. Collective, like solve(). */
  CondensedContact(const ElasticBody<dim> &body, const StaticContactProblem &problem);

  /** Whether the problem is small enough. */
  bool is_solvable() const
  {
    return place.size() <= most;
  }

  /**
   * An equilibrium to the @p tolerance by Lemke's method from several starts, or by
   * cone_newton(); empty if none was found. @throws NotConverged
   */
  std::optional<StaticContactSolution> solve(const double tolerance);

  /** After solve(): whether it is certain that there is no equilibrium. */
  bool has_none() const
  {
    return none;
  }

private:
  static constexpr unsigned int normal_axis = dim - 1;
  using Direction                           = std::array<double, dim - 1>;

  /** A displacement: component c of contact node i. */
  struct Place
  {
    unsigned int i = 0;
    unsigned int c = 0;
  };

  /** State of a node and, if it slips, the direction of its friction. */
  struct Node
  {
    ContactState state  = ContactState::held;
    Direction direction = {};
  };

  /**
   * Linear complementarity problem M z + q; z lists the displacement of each unknown and
   * its sign.
   */
  struct Problem
  {
    Eigen::MatrixXd M;
    Eigen::VectorXd q;
    std::vector<std::pair<Eigen::Index, double>> z;
  };

  /** z are the gaps; displacements along the flat are eliminated. */
  Problem of_sliding_flat() const;

  /**
   * z are the gaps and the slips to either side; friction opposing a slip is at its
   * limit.
   */
  Problem of_resting_flat() const;

  /**
   * Converts d to displacements of the ends of the springs on the flat, if there are
   * springs. With the compliance D of the springs, node displacements are d - D f, so
   * that F becomes (1 + S D)^-1 F, and S likewise.
   */
  void stand_on_springs();

  std::vector<Node> nodes_of(const Problem &of, const Eigen::VectorXd &z) const;

  /** The condensed problem for cone_newton(): 3D on a flat at rest. */
  ConeProblem cones() const;

  /**
   * States of the nodes at a solution @p d of cones(), from the augmented forces f - @p c
   * d.
   */
  std::vector<Node> nodes_at(const Eigen::VectorXd &d, const double c) const;

  /**
   * Combinations of the forces (rows) that vanish, one per displacement; a zero row if
   * the displacement is not free.
   */
  Eigen::MatrixXd conditions(const std::vector<Node> &nodes) const;

  /**
   * Sets the displacements @p d of the contact nodes in @p u, and solves for all others
   * under @p force; returns the internal forces at the contact.
   */
  Eigen::VectorXd internal_forces(NodalField<double> &u,
                                  const Eigen::VectorXd &d,
                                  const NodalField<double> &force);

  /**
   * Equilibrium with @p nodes in these states, starting from @p d; empty if contact or
   * friction conditions are violated.
   */
  std::optional<StaticContactSolution>
  equilibrium(const std::vector<Node> &nodes, Eigen::VectorXd d, const double tolerance);

  /** Index of component @p c of node @p i in d; -1 if a side constrains it. */
  Eigen::Index number(const std::size_t i, const unsigned int c) const
  {
    return dim * i + c < numbers.size() ? numbers[dim * i + c] : -1;
  }

  const ElasticBody<dim> &body;
  const StaticContactProblem &problem;
  const SurfaceNodes<dim> &bottom;
  std::vector<Place> place; ///< node and component of each displacement
  std::vector<Eigen::Index> numbers;
  EquilibriumSolver<dim> solver;
  Eigen::MatrixXd S;
  Eigen::VectorXd start;  ///< displacements with all nodes touching and sticking
  Eigen::VectorXd loaded; ///< given forces at the contact
  Eigen::VectorXd F;
  Eigen::VectorXd softness; ///< compliance of the springs (m/N), 0 along the flat
  bool none = false;
};
} // namespace mesoslip

#endif
