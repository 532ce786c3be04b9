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
/** Iteration of solve_static_contact() and its state. */
template <int dim>
class ActiveSetIteration
{
public:
  /** Sets up the iteration for @p given; @p body and @p options must outlive it. */
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

  /** Returns the solution; call it once. @throws NotConverged */
  StaticContactSolution run();

  /** Result of run() so far, also after an exception. */
  const StaticContactSolution &so_far() const
  {
    return solution;
  }

private:
  static constexpr unsigned int n_tangents  = dim - 1; ///< components of friction
  static constexpr unsigned int normal_axis = dim - 1; ///< axis of the flat's normal

  /**
   * Factor of the stiffness scale for friction. In 3D the direction of friction turns:
   * nodes that slip together are softer than a single node, and with factor 1 friction
   * turns too far. Between 0.03 and 0.3 a pressed cylinder needs 30 to 140 iterations
   * without springs(), with 0.1 at most 56; with 3 the iteration does not end.
   */
  static constexpr double turning = dim == 3 ? 0.1 : 1.;
  static constexpr unsigned int hasty_changes =
    10; ///< changes of states with inexact friction
  static constexpr unsigned int most_returns =
    2; ///< returns to former states until states count as cycling
  using Friction = IncrementalFriction<dim>;

  /** Direction of friction on all nodes; zero on a flat at rest. */
  typename Friction::Direction of_sliding_flat() const
  {
    typename Friction::Direction direction;
    for (unsigned int c = 0; c < n_tangents; ++c)
      direction[c] = problem.sliding * problem.flat_direction[c];
    return direction;
  }

  /**
   * Whether friction, which changed by @p change, and equilibrium are within the
   * tolerance.
   */
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

  /** Whether a spring is between node @p i and the flat. */
  bool is_compliant(const unsigned int i) const
  {
    return !problem.stiffness.empty() && held[dim * i + normal_axis] == 0.;
  }

  /**
   * Whether the direction of friction is fixed, so that states determine the solution.
   */
  bool is_linear() const
  {
    return dim == 2 || problem.sliding != 0;
  }

  /** State of a node that touches the flat and has not moved. */
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

  /**
   * Whether a side constrains component @p c of node @p i, so that a flat at rest adds no
   * friction.
   */
  bool side_carries(const unsigned int i, const unsigned int c) const
  {
    return problem.sliding == 0 && held[dim * i + c] != 0.;
  }

  /** Sum of @p force along the flat. Collective. */
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

  /** Calls action(node, index) for the contact nodes on this rank. */
  template <typename Action>
  void for_each_node(const Action &action) const
  {
    for (std::size_t k = 0; k < bottom.nodes.size(); ++k)
      if (bottom.place(k) < n_nodes)
        action(bottom.nodes[k], static_cast<unsigned int>(bottom.place(k)));
  }

  /**
   * Constrains nodes that touch and stick, and adds springs. If the body could slide as a
   * whole, one more node sticks.
   */
  void hold_contact();

  /**
   * The given constraints and the constraints of touching or sticking nodes; sets the
   * displacements of the latter.
   */
  DofMask constrain_contact();

  /**
   * Springs of Newton's method for friction g n with varying direction (g: its size, n
   * its direction, the direction of the trial f - c v): it then is g n - D v, D = g c /
   * (|f - c v| - g) (1 - n n^T), a spring across n. Nodes near sticking have stiff
   * springs, up to 10 c. None in 2D, on a sliding flat and before the first solution. The
   * springs between nodes and flat are always included.
   */
  std::vector<SpringEntry> springs(bool of_friction) const;

  /**
   * The slipping node that would be the first to stick if the body slides in the
   * direction in which its friction and the given forces push it; n_nodes if there is
   * none.
   */
  unsigned int next_to_stick() const;

  /** Sets the nodal forces: given forces and friction. */
  void set_forces();

  /**
   * Solves for the displacements under these forces; returns the residual. @throws
   * NotConverged
   */
  double solve(double tolerance);

  /** Computes displaced, normal and tangential from the last solution. */
  void evaluate_reactions();

  /**
   * State of node @p i after the last solution; updates the direction of its friction.
   */
  ContactState next_state(const unsigned int i);

  /** Updates the direction of friction in 3D without a change of states. */
  void turn_friction()
  {
    for (unsigned int i = 0; i < n_nodes && dim == 3 && problem.sliding == 0; ++i)
      if (solution.state[i] == ContactState::slip)
        tangential.turn(displaced, i);
  }

  /** Updates the states; returns whether one has changed. */
  bool update_states();

  /**
   * Friction of slipping nodes from their normal forces, in their direction; otherwise 0.
   */
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

  /** Change of friction relative to the normal force. */
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

  /**
   * Checks the reactions. @throws NotConverged unless the forces are finite and, if
   * @p enough, enough nodes touch the flat
   */
  void require_contact(bool enough) const;

  const ElasticBody<dim> &body;
  StaticContactProblem problem;
  const StaticContactOptions &options;
  EquilibriumSolver<dim> solver;
  const SurfaceNodes<dim> &bottom; ///< contact side; the periodic copy is the last node
  const unsigned int n_nodes;      ///< distinct contact nodes
  const double scale;              ///< see stiffness_scale()
  const bool is_held;              ///< whether the body is fixed without contact

  /**
   * Values at the contact nodes, dim components per node: problem.force,
   * problem.constrained and the displacement.
   */
  const std::vector<double> given_force, held;
  std::vector<double> displaced;

  const typename Friction::Direction pushed; ///< sum of all given forces (N, in 2D N/m)

  /**
   * Whether friction turns by Newton's method, which requires a body that cannot move as
   * a whole.
   */
  bool turns_on_springs = false;

  NodalField<double> force;
  Eigen::VectorXd friction, normal;
  Friction tangential; ///< friction of the last solution
  AndersonAcceleration acceleration;
  StaticContactSolution solution;
  std::map<
    std::pair<std::vector<ContactState>, std::vector<typename Friction::Direction>>,
    unsigned int>
    seen; ///< how often each set of states has occurred
};
} // namespace mesoslip

#endif
