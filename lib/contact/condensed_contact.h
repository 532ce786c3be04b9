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
 * A static contact condensed to its nodes: the forces of the flat on them are F + S d, d being their
 * displacements from where they touch and stick. The conditions of contact and friction are a
 * linear complementarity problem, but in 3D on a flat at rest, where friction has any direction. Each
 * column of S is one solve.
 */
template <int dim>
class CondensedContact
{
public:
  /** Number of displacements up to which this is worth it. */
  static constexpr std::size_t most = 600;

  /** @p body and @p problem must outlive this object. Collective, like solve(). */
  CondensedContact(const ElasticBody<dim> &body, const StaticContactProblem &problem);

  /** Whether it is not too large. */
  bool is_solvable() const
  {
    return place.size() <= most;
  }

  /** An equilibrium to the @p tolerance by Lemke's method from several starts, or by cone_newton(); nothing
   * if none was found. @throws NotConverged */
  std::optional<StaticContactSolution> solve(const double tolerance);

  /** After solve(): whether it is certain that there is none. */
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

  /** What a node does, and the direction of its friction where it slips. */
  struct Node
  {
    ContactState state  = ContactState::held;
    Direction direction = {};
  };

  /** M z + q, and the displacement that each z is, with its sign. */
  struct Problem
  {
    Eigen::MatrixXd M;
    Eigen::VectorXd q;
    std::vector<std::pair<Eigen::Index, double>> z;
  };

  /** z are the gaps; what moves along the flat is eliminated. */
  Problem of_sliding_flat() const;

  /** z are the gaps and the slips to either side, against which friction is at its limit. */
  Problem of_resting_flat() const;

  /** Makes d the displacements of the ends of the springs on the flat, where there are springs: with their
   * softness D, those of the nodes are d - D f, so that F becomes (1 + S D)^-1 F, and S likewise. */
  void stand_on_springs();

  std::vector<Node> nodes_of(const Problem &of, const Eigen::VectorXd &z) const;

  /** The same for cone_newton(): in 3D on a flat at rest. */
  ConeProblem cones() const;

  /** What each node does at @p d, a solution of cones(), by the augmented forces f - @p c d. */
  std::vector<Node> nodes_at(const Eigen::VectorXd &d, const double c) const;

  /** Which combination of the forces (the rows) is zero at each displacement; a row of zeros where it is
   * not free. */
  Eigen::MatrixXd conditions(const std::vector<Node> &nodes) const;

  /** Displaces the contact nodes of @p u by @p d and all others as @p force wants it; the internal
   * forces at the contact. */
  Eigen::VectorXd internal_forces(NodalField<double> &u,
                                  const Eigen::VectorXd &d,
                                  const NodalField<double> &force);

  /** With @p nodes in these states, from @p d on; nothing where they do not keep to contact and friction. */
  std::optional<StaticContactSolution>
  equilibrium(const std::vector<Node> &nodes, Eigen::VectorXd d, const double tolerance);

  /** Number of component @p c of node @p i; -1: a side holds it. */
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
  Eigen::VectorXd start;  ///< displacements where all nodes touch and stick
  Eigen::VectorXd loaded; ///< the given forces at the contact
  Eigen::VectorXd F;
  Eigen::VectorXd softness; ///< of the springs (m/N), 0 along the flat
  bool none = false;
};
} // namespace mesoslip

#endif
