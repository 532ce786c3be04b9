#include "contact/static_contact_solver.h"

#include "contact/anderson_acceleration.h"
#include "contact/equilibrium_solver.h"
#include "contact/incremental_friction.h"
#include "material/plausibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mesoslip
{
namespace
{
/** The iteration and its state. */
template <int dim>
class ActiveSetIteration
{
public:
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
    , given_force(body.surface_values(ElasticBody<dim>::bottom, problem.force))
    , held(body.surface_values(ElasticBody<dim>::bottom, problem.constrained))
    , force(problem.force)
    , friction(Eigen::VectorXd::Zero(Eigen::Index{n_nodes} * n_tangents))
    , normal(Eigen::VectorXd::Zero(n_nodes))
    , tangential(problem.reference, n_nodes, turning * scale, of_sliding_flat())
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

  StaticContactSolution run()
  {
    hold_contact();
    double change = 1.;
    bool changed  = true;
    while (changed || !(change <= options.tolerance) ||
           !(solution.residual <= options.tolerance))
      {
        if (solution.iterations == options.max_iterations)
          fail("no equilibrium was found; ",
               changed ? "contact states still change, " : "",
               "friction forces change by ", change, " of the contact force");
        if (options.before_iteration)
          options.before_iteration(solution.iterations);
        set_forces();
        // While friction or states are far off, an exact solution is a waste.
        solution.residual =
          solver.solve(problem.displacement, force,
                       std::max(0.1 * options.tolerance, std::min(1e-5, 1e-2 * change)));
        evaluate_reactions();
        turn_friction();
        ++solution.iterations;
        // States that follow friction which is not yet that of the pressure may go round
        // in circles.
        changed = (solution.state_changes < hasty_changes ||
                   friction_change() <= options.tolerance) &&
                  update_states();
        require_contact();
        if (changed)
          {
            ++solution.state_changes;
            acceleration.reset();
            hold_contact();
            change = 1.;
          }
        else
          {
            change   = friction_change();
            friction = acceleration.next(friction, friction_of_pressure());
          }
      }

    solution.displacement      = problem.displacement;
    solution.solver_iterations = solver.iterations();
    solution.friction_change   = change;
    solution.normal_force.assign(normal.data(), normal.data() + n_nodes);
    solution.tangential_force.assign(tangential.force.data(),
                                     tangential.force.data() + tangential.force.size());
    if (bottom.closed)
      {
        solution.normal_force.push_back(normal[0]);
        solution.tangential_force.push_back(tangential.force[0]);
        solution.state.push_back(solution.state[0]);
      }
    return std::move(solution);
  }

private:
  static constexpr unsigned int n_tangents  = dim - 1; ///< components of friction
  static constexpr unsigned int normal_axis = dim - 1; ///< of the flat

  /** Of the scale in the direction of friction, which in 3D turns: nodes that slip together
   * are softer than one, and with 1 friction turns too far. Between 0.03 and 0.3 a pressed
   * cylinder needs 30 to 140 iterations, with 0.1 at most 56, with 3 there is no end. */
  static constexpr double turning = dim == 3 ? 0.1 : 1.;
  static constexpr unsigned int hasty_changes =
    10; ///< of states, before friction is exact
  using Friction = IncrementalFriction<dim>;

  /** Of friction on all nodes; zero on a flat at rest. */
  typename Friction::Direction of_sliding_flat() const
  {
    typename Friction::Direction direction;
    for (unsigned int c = 0; c < n_tangents; ++c)
      direction[c] = problem.sliding * problem.flat_direction[c];
    return direction;
  }

  static Eigen::Index index(const unsigned int i, const unsigned int c)
  {
    return Friction::index(i, c);
  }

  double gap(const unsigned int i) const
  {
    return problem.gap.empty() ? 0. : problem.gap[i];
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

  /** Calls action(node, number of the node) with the contact nodes that this rank has. */
  template <typename Action>
  void for_each_node(const Action &action) const
  {
    for (std::size_t k = 0; k < bottom.nodes.size(); ++k)
      if (bottom.place(k) < n_nodes)
        action(bottom.nodes[k], static_cast<unsigned int>(bottom.place(k)));
  }

  void hold_contact()
  {
    DofMask constrained   = problem.constrained;
    NodalField<double> &u = problem.displacement;
    const auto put        = [&](const unsigned int c, const NodeIndex &node,
                         const double value) {
      // Held by a side: that value counts.
      if (constrained.is_constrained(c, node))
        return;
      constrained.constrain(c, node);
      u(c, node) = value;
    };
    for_each_node([&](const NodeIndex &node, const unsigned int i) {
      if (touches(i))
        put(normal_axis, node, -gap(i));
      if (solution.state[i] == ContactState::stick)
        for (unsigned int c = 0; c < n_tangents; ++c)
          put(c, node, tangential.sticks_at(i, c));
    });
    body.copy_duplicates(constrained);
    body.copy_duplicates(u);
    solver.set_constrained(constrained);
  }

  void set_forces()
  {
    for_each_node([&](const NodeIndex &node, const unsigned int i) {
      for (unsigned int c = 0; c < n_tangents; ++c)
        force(c, node) = problem.force(c, node) + friction[index(i, c)];
    });
    body.copy_duplicates(force);
  }

  void evaluate_reactions()
  {
    displaced = body.surface_values(ElasticBody<dim>::bottom, problem.displacement);
    const std::vector<double> internal =
      body.surface_values(ElasticBody<dim>::bottom, solver.internal_force());
    const auto reaction = [&](const unsigned int i, const unsigned int c) {
      return internal[dim * i + c] - given_force[dim * i + c];
    };
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        normal[i] = touches(i) ? reaction(i, normal_axis) : 0.;
        for (unsigned int c = 0; c < n_tangents; ++c)
          tangential.force[index(i, c)] = !touches(i) || side_carries(i, c) ? 0.
                                          : solution.state[i] == ContactState::stick
                                            ? reaction(i, c)
                                            : friction[index(i, c)];
      }
  }

  ContactState next_state(const unsigned int i)
  {
    const ContactState state = solution.state[i];
    if (state == ContactState::held)
      return state;
    // Nodes that hardly touch must not change to and fro with the round-off.
    const double negligible = options.tolerance * std::fabs(normal.sum()) / n_nodes;
    if (state == ContactState::separated)
      {
        if (displaced[dim * i + normal_axis] + gap(i) >= -negligible / scale)
          return state;
        // A node that comes down moves freely along the flat until its friction is known.
        if (problem.sliding == 0)
          tangential.direction[i] = {};
        return ContactState::slip;
      }
    if (normal[i] < -negligible)
      return ContactState::separated;
    if (at_rest(i) == ContactState::slip)
      return ContactState::slip;
    // Resting flat: friction opposes the displacement and stays below its limit.
    const double limit = problem.friction_coefficient[i] * normal[i];
    // A node that moves with its friction sticks before it may slip the other way.
    if (tangential.size_of_trial(displaced, i) <= limit ||
        tangential.is_pushed(displaced, i, limit))
      return ContactState::stick;
    tangential.turn(displaced, i);
    return ContactState::slip;
  }

  /** In 3D friction turns without a change of states. */
  void turn_friction()
  {
    for (unsigned int i = 0; i < n_nodes && dim == 3 && problem.sliding == 0; ++i)
      if (solution.state[i] == ContactState::slip)
        tangential.turn(displaced, i);
  }

  bool update_states()
  {
    bool changed = false;
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        const auto before        = tangential.direction[i];
        const ContactState state = next_state(i);
        const bool turned        = state == ContactState::slip &&
                            Friction::reversed(before, tangential.direction[i]) &&
                            solution.state[i] == ContactState::slip;
        if (state == solution.state[i] && !turned)
          continue;
        changed           = true;
        solution.state[i] = state;
      }
    if (changed)
      friction = friction_of_pressure();
    return changed;
  }

  /** Of nodes that slip, in their direction; else 0. */
  Eigen::VectorXd friction_of_pressure() const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(friction.size());
    for (unsigned int i = 0; i < n_nodes; ++i)
      if (solution.state[i] == ContactState::slip)
        for (unsigned int c = 0; c < n_tangents; ++c)
          result[index(i, c)] = tangential.direction[i][c] *
                                problem.friction_coefficient[i] * std::max(0., normal[i]);
    return result;
  }

  /** As a share of the normal force. */
  double friction_change() const
  {
    return (friction_of_pressure() - friction).template lpNorm<1>() / normal.lpNorm<1>();
  }

  template <typename... Parts>
  [[noreturn]] void fail(const Parts &...what) const
  {
    throw NotConverged(brief_text(6, "static contact: ", what..., " (iteration ",
                                  solution.iterations, ")"));
  }

  void require_contact() const
  {
    if (!std::isfinite(normal.sum()))
      fail("the contact forces are not finite");
    const auto touching =
      std::count_if(solution.state.begin(), solution.state.end(),
                    [](const ContactState s) { return s != ContactState::separated; });
    if (touching < (problem.gap.empty() ? 2 : 1))
      fail(
        "the body lifts off or tips over its edge, at most one node stays on the flat");
  }

  const ElasticBody<dim> &body;
  StaticContactProblem problem;
  const StaticContactOptions &options;
  EquilibriumSolver<dim> solver;
  const SurfaceNodes<dim>
    &bottom;                  ///< whose nodes all ranks know; the duplicate at the end
  const unsigned int n_nodes; ///< distinct ones of the bottom
  const double scale;         ///< see stiffness_scale()

  /** At the nodes of the bottom, their dim components together: problem.force, whether
   * problem.constrained holds them, the displacement. */
  const std::vector<double> given_force, held;
  std::vector<double> displaced;

  NodalField<double> force;
  Eigen::VectorXd friction, normal;
  Friction tangential; ///< of the last solution
  AndersonAcceleration acceleration;
  StaticContactSolution solution;
};
} // namespace

template <int dim>
StaticContactSolution solve_static_contact(const ElasticBody<dim> &body,
                                           StaticContactProblem problem,
                                           const StaticContactOptions &options)
{
  return ActiveSetIteration<dim>(body, std::move(problem), options).run();
}

template StaticContactSolution solve_static_contact(const ElasticBody<2> &,
                                                    StaticContactProblem,
                                                    const StaticContactOptions &);
template StaticContactSolution solve_static_contact(const ElasticBody<3> &,
                                                    StaticContactProblem,
                                                    const StaticContactOptions &);
} // namespace mesoslip
