#ifndef mesoslip_contact_active_set_iteration_h
#define mesoslip_contact_active_set_iteration_h

#include "base/exchange.h"
#include "contact/anderson_acceleration.h"
#include "contact/equilibrium_solver.h"
#include "contact/incremental_friction.h"
#include "contact/static_contact_solver.h"
#include "material/plausibility.h"

#include <map>
#include <utility>
#include <vector>

namespace mesoslip
{
/** The iteration of solve_static_contact() and its state. */
template <int dim>
class ActiveSetIteration
{
public:
  /** Of @p given; @p body and @p options must outlive it. */
  ActiveSetIteration(const ElasticBody<dim> &body,
                     StaticContactProblem &&given,
                     const StaticContactOptions &options)
    : body(body)
    , problem(std::move(given))
    , options(options)
    , solver(body)
    , bottom(body.surface(ElasticBody<dim>::bottom))
    , n_nodes(bottom.normal_area.size() - (bottom.closed ? 1 : 0))
    , scale(stiffness_scale(body))
    , is_held(!can_move(body, problem.constrained))
    , given_force(body.surface_values(ElasticBody<dim>::bottom, problem.force))
    , held(body.surface_values(ElasticBody<dim>::bottom, problem.constrained))
    , pushed(sum_along_flat(body, problem.force))
    , force(problem.force)
    , friction(Eigen::VectorXd::Zero(Eigen::Index{n_nodes} * n_tangents))
    , normal(Eigen::VectorXd::Zero(n_nodes))
    , tangential(problem.reference,
                 problem.tangential_stiffness,
                 n_nodes,
                 turning * scale,
                 of_sliding_flat())
  {
    for (unsigned int i = 0; i < n_nodes; ++i)
      solution.state.push_back(held[dim * i + normal_axis] != 0. ? ContactState::held
                               : problem.state.empty()           ? at_rest(i)
                                                                 : problem.state[i]);
    for (unsigned int i = 0; i < n_nodes && !problem.friction.empty(); ++i)
      if (solution.state[i] == ContactState::slip)
        for (unsigned int c = 0; c < n_tangents; ++c)
          friction[index(i, c)] = problem.friction[index(i, c)];
  }

  /** The solution; once. @throws NotConverged */
  StaticContactSolution run();

  /** What run() has done, also when it ends with an exception. */
  const StaticContactSolution &so_far() const
  {
    return solution;
  }

private:
  static constexpr unsigned int n_tangents  = dim - 1; ///< components of friction
  static constexpr unsigned int normal_axis = dim - 1; ///< of the flat

  /** Of the scale in the direction of friction, which in 3D turns: nodes that slip together
   * are softer than one, and with 1 friction turns too far. Between 0.03 and 0.3 a pressed
   * cylinder needs 30 to 140 iterations without springs(), with 0.1 at most 56, with 3 there is no
   * end. */
  static constexpr double turning = dim == 3 ? 0.1 : 1.;
  static constexpr unsigned int hasty_changes =
    10; ///< of states, before friction is exact
  static constexpr unsigned int most_returns =
    2; ///< of states that were there, before they cycle
  using Friction = IncrementalFriction<dim>;

  /** Of friction on all nodes; zero on a flat at rest. */
  typename Friction::Direction of_sliding_flat() const
  {
    typename Friction::Direction direction;
    for (unsigned int c = 0; c < n_tangents; ++c)
      direction[c] = problem.sliding * problem.flat_direction[c];
    return direction;
  }

  /** Whether friction that changes by @p change, and the equilibrium, are as wanted. */
  bool is_solved(const double change) const
  {
    return change <= options.tolerance && solution.residual <= options.tolerance;
  }

  static Eigen::Index index(const unsigned int i, const unsigned int c)
  {
    return Friction::index(i, c);
  }

  double gap(const unsigned int i) const
  {
    return problem.gap.empty() ? 0. : problem.gap[i];
  }

  /** Whether node @p i stands on a spring. */
  bool is_compliant(const unsigned int i) const
  {
    return !problem.stiffness.empty() && held[dim * i + normal_axis] == 0.;
  }

  /** Whether friction does not turn, so that states and directions tell what follows. */
  bool is_linear() const
  {
    return dim == 2 || problem.sliding != 0;
  }

  /** Of a node that touches the flat and has not moved. */
  ContactState at_rest(const unsigned int i) const
  {
    return problem.sliding == 0 && problem.friction_coefficient[i] > 0.
             ? ContactState::stick
             : ContactState::slip;
  }

  bool touches(const unsigned int i) const
  {
    return solution.state[i] == ContactState::stick ||
           solution.state[i] == ContactState::slip;
  }

  /** Whether a side does, so that a flat at rest has nothing to add. */
  bool side_carries(const unsigned int i, const unsigned int c) const
  {
    return problem.sliding == 0 && held[dim * i + c] != 0.;
  }

  /** Collective. */
  static typename Friction::Direction sum_along_flat(const ElasticBody<dim> &body,
                                                     const NodalField<double> &force)
  {
    typename Friction::Direction sum = {};
    for (unsigned int j = 0; j < body.n_rows(); ++j)
      for (unsigned int i = 0; i < body.n_columns(); ++i)
        for (unsigned int c = 0; c < n_tangents && body.is_counted({i, j}); ++c)
          sum[c] += force(c, {i, j});
    for (double &component : sum)
      component = mpi::sum(component, body.communicator());
    return sum;
  }

  /** Calls action(node, number of the node) with the contact nodes that this rank has. */
  template <typename Action>
  void for_each_node(const Action &action) const
  {
    for (std::size_t k = 0; k < bottom.nodes.size(); ++k)
      if (bottom.place(k) < n_nodes)
        action(bottom.nodes[k], static_cast<unsigned int>(bottom.place(k)));
  }

  /** Holds what touches and sticks, and adds springs; a body that could slide as a whole sticks with
   * one node more. */
  void hold_contact();

  /** The given constraints and those of nodes that touch or stick, where the displacements take their values. */
  DofMask constrain_contact();

  /**
   * Newton's method for friction g n that turns (g: its size, n its direction, that of the trial f - c v):
   * it then is g n - D v, D = g c / (|f - c v| - g) (1 - n n^T), of a spring across n. Nodes near sticking
   * have stiff springs, up to 10 c. None in 2D, on a sliding flat and before the first solution. Nodes
   * on the flat's own springs have those, always.
   */
  std::vector<SpringEntry> springs(bool of_friction) const;

  /** Of the nodes that slip, the one that the body brings first to where it sticks if it slides as
   * its friction and the given forces push it; n_nodes: none. */
  unsigned int next_to_stick() const;

  /** The given forces with friction. */
  void set_forces();

  /** Displacements under these; the residual that is left. @throws NotConverged */
  double solve(double tolerance);

  /** Of the last solution: displaced, normal and tangential. */
  void evaluate_reactions();

  /** What the last solution makes of node @p i; turns its friction. */
  ContactState next_state(const unsigned int i);

  /** In 3D friction turns without a change of states. */
  void turn_friction()
  {
    for (unsigned int i = 0; i < n_nodes && dim == 3 && problem.sliding == 0; ++i)
      if (solution.state[i] == ContactState::slip)
        tangential.turn(displaced, i);
  }

  /** Whether a state has changed. */
  bool update_states();

  /** Of nodes that slip, in their direction; else 0. */
  Eigen::VectorXd friction_of_pressure() const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(friction.size());
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int c = 0; c < n_tangents; ++c)
        if (solution.state[i] == ContactState::slip && !side_carries(i, c))
          result[index(i, c)] = tangential.direction[i][c] *
                                problem.friction_coefficient[i] * std::max(0., normal[i]);
    return result;
  }

  /** As a share of the normal force. */
  double friction_change() const
  {
    const double pressed = normal.lpNorm<1>();
    return pressed > 0.
             ? (friction_of_pressure() - friction).template lpNorm<1>() / pressed
             : 0.;
  }

  template <typename... Parts>
  [[noreturn]] void fail(const Parts &...what) const
  {
    throw NotConverged(brief_text(6, "static contact: ", what..., " (iteration ",
                                  solution.iterations, ")"));
  }

  /** @throws NotConverged unless the forces are finite and, if @p enough, enough nodes touch the flat */
  void require_contact(bool enough) const;

  const ElasticBody<dim> &body;
  StaticContactProblem problem;
  const StaticContactOptions &options;
  EquilibriumSolver<dim> solver;
  const SurfaceNodes<dim>
    &bottom;                  ///< whose nodes all ranks know; the duplicate at the end
  const unsigned int n_nodes; ///< distinct ones of the bottom
  const double scale;         ///< see stiffness_scale()
  const bool is_held; ///< without the contact, so that it may be lost and come again

  /** At the nodes of the bottom, their dim components together: problem.force, whether
   * problem.constrained holds them, the displacement. */
  const std::vector<double> given_force, held;
  std::vector<double> displaced;

  const typename Friction::Direction pushed; ///< by all given forces (N, in 2D N/m)

  /** Whether friction turns by Newton's method, which takes a body that cannot move as a whole. */
  bool turns_on_springs = false;

  NodalField<double> force;
  Eigen::VectorXd friction, normal;
  Friction tangential; ///< of the last solution
  AndersonAcceleration acceleration;
  StaticContactSolution solution;
  std::map<
    std::pair<std::vector<ContactState>, std::vector<typename Friction::Direction>>,
    unsigned int>
    seen; ///< how often, each time that states change
};
} // namespace mesoslip

#endif
