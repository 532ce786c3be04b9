#include "contact/static_contact_solver.h"

#include "base/errors.h"
#include "contact/active_set_iteration.h"
#include "contact/condensed_contact.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
template <int dim>
StaticContactSolution ActiveSetIteration<dim>::run()
{
  hold_contact();
  double change = 1.;
  bool changed  = true;
  while (changed || !is_solved(change))
    {
      if (solution.iterations == options.max_iterations)
        fail("no equilibrium was found; ", changed ? "contact states still change, " : "",
             "friction forces change by ", change,
             " of the contact force, the residual is ", solution.residual);
      if (options.before_iteration)
        options.before_iteration(solution.iterations);
      set_forces();
      // Exact solutions are not needed while friction or states are far from convergence.
      solution.residual =
        solve(std::max(0.1 * options.tolerance, std::min(1e-5, 1e-2 * change)));
      evaluate_reactions();
      turn_friction();
      ++solution.iterations;
      // States that follow inexact friction may cycle.
      changed = (solution.state_changes < hasty_changes ||
                 friction_change() <= options.tolerance) &&
                update_states();
      require_contact(!is_held);
      if (changed)
        {
          ++solution.state_changes;
          if (is_linear() &&
              ++seen[{solution.state, tangential.direction}] > most_returns)
            fail("no equilibrium was found; contact states go round in circles");
          acceleration.reset();
          hold_contact();
          change = 1.;
        }
      else
        {
          change   = friction_change();
          friction = turns_on_springs
                       ? friction_of_pressure()
                       : acceleration.next(friction, friction_of_pressure());
          if (turns_on_springs && !is_solved(change))
            hold_contact();
        }
    }
  require_contact(true);

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

template <int dim>
double ActiveSetIteration<dim>::solve(const double tolerance)
{
  try
    {
      return solver.solve(problem.displacement, force, tolerance);
    }
  catch (const NotConverged &)
    {
      if (!solver.can_move())
        throw;
    }
  fail("sides, contact and friction do not hold the body, which moves or turns as a "
       "whole: hold a side of it, or reduce the forces along the flat");
}

template <int dim>
void ActiveSetIteration<dim>::hold_contact()
{
  DofMask constrained         = constrain_contact();
  std::vector<SpringEntry> on = springs(true);
  bool moves                  = problem.sliding == 0 &&
               can_move(body, constrained, with_foundation(body.foundation(), on));
  const unsigned int i = moves && !displaced.empty() ? next_to_stick() : n_nodes;
  if (i < n_nodes)
    {
      solution.state[i] = ContactState::stick;
      constrained       = constrain_contact();
      on                = springs(true);
      moves = can_move(body, constrained, with_foundation(body.foundation(), on));
      if (moves) // the body still rolls or tips
        {
          solution.state[i] = ContactState::slip;
          constrained       = constrain_contact();
        }
    }
  turns_on_springs = dim == 3 && problem.sliding == 0 && !moves;
  solver.set_constrained(constrained, turns_on_springs ? on : springs(false));
}

template <int dim>
DofMask ActiveSetIteration<dim>::constrain_contact()
{
  DofMask constrained   = problem.constrained;
  NodalField<double> &u = problem.displacement;
  const auto put = [&](const unsigned int c, const NodeIndex &node, const double value) {
    // A side already constrains the component; its value has priority.
    if (constrained.is_constrained(c, node))
      return;
    constrained.constrain(c, node);
    u(c, node) = value;
  };
  for_each_node([&](const NodeIndex &node, const unsigned int i) {
    if (touches(i) && !is_compliant(i))
      put(normal_axis, node, -gap(i));
    if (solution.state[i] == ContactState::stick && !(tangential.softness(i) > 0.))
      for (unsigned int c = 0; c < n_tangents; ++c)
        put(c, node, tangential.sticks_at(i, c));
  });
  body.update_copies(constrained);
  body.update_copies(u);
  return constrained;
}

template <int dim>
std::vector<SpringEntry> ActiveSetIteration<dim>::springs(const bool of_friction) const
{
  const bool turns =
    of_friction && dim == 3 && problem.sliding == 0 && !displaced.empty();
  std::vector<SpringEntry> entries;
  for_each_node([&](const NodeIndex &node, const unsigned int i) {
    if (touches(i) && is_compliant(i))
      entries.push_back({node, normal_axis, normal_axis, problem.stiffness[i], -gap(i)});
    if (const double soft = tangential.softness(i);
        soft > 0. && solution.state[i] == ContactState::stick)
      for (unsigned int c = 0; c < n_tangents; ++c)
        if (held[dim * i + c] == 0.)
          entries.push_back({node, c, c, 1. / soft, tangential.sticks_at(i, c)});
    const double g =
      turns ? problem.friction_coefficient[i] * std::max(0., normal[i]) : 0.;
    if (solution.state[i] != ContactState::slip || !(g > 0.))
      return;
    const double beyond  = std::max(0.1 * g, tangential.size_of_trial(displaced, i) - g),
                 c_scale = turning * scale,
                 k       = g * c_scale / (beyond + c_scale * tangential.softness(i) * g);
    const auto &n        = tangential.direction[i];
    for (unsigned int c = 0; c < n_tangents; ++c)
      for (unsigned int d = 0; d < n_tangents; ++d)
        entries.push_back({node, c, d, k * ((c == d ? 1. : 0.) - n[c] * n[d]),
                           tangential.sticks_at(i, d)});
  });
  return entries;
}

template <int dim>
unsigned int ActiveSetIteration<dim>::next_to_stick() const
{
  const Eigen::VectorXd carried     = friction_of_pressure();
  typename Friction::Direction push = pushed;
  for (unsigned int i = 0; i < n_nodes; ++i)
    for (unsigned int c = 0; c < n_tangents; ++c)
      push[c] += carried[index(i, c)];
  unsigned int next = n_nodes;
  for (unsigned int i = 0; i < n_nodes; ++i)
    {
      double along = 0.;
      for (unsigned int c = 0; c < n_tangents; ++c)
        along += carried[index(i, c)] * push[c];
      // Friction in the direction of sliding belongs to a returning node.
      if (along > 0. && (next == n_nodes || tangential.squared_slip(displaced, i) <
                                              tangential.squared_slip(displaced, next)))
        next = i;
    }
  return next;
}

template <int dim>
void ActiveSetIteration<dim>::set_forces()
{
  for_each_node([&](const NodeIndex &node, const unsigned int i) {
    for (unsigned int c = 0; c < n_tangents; ++c)
      force(c, node) = problem.force(c, node) + friction[index(i, c)];
  });
  body.update_copies(force);
}

template <int dim>
void ActiveSetIteration<dim>::evaluate_reactions()
{
  displaced = body.surface_values(ElasticBody<dim>::bottom, problem.displacement);
  const std::vector<double> internal =
    body.surface_values(ElasticBody<dim>::bottom, solver.internal_force());
  const auto reaction = [&](const unsigned int i, const unsigned int c) {
    return internal[dim * i + c] - given_force[dim * i + c];
  };
  for (unsigned int i = 0; i < n_nodes; ++i)
    {
      normal[i] = !touches(i) ? 0.
                  : is_compliant(i)
                    ? -problem.stiffness[i] * (displaced[dim * i + normal_axis] + gap(i))
                    : reaction(i, normal_axis);
      for (unsigned int c = 0; c < n_tangents; ++c)
        {
          double &f = tangential.force[index(i, c)];
          f         = !touches(i) || side_carries(i, c) ? 0.
                      : solution.state[i] == ContactState::stick || turns_on_springs
                        ? reaction(i, c)
                        : friction[index(i, c)];
          if (turns_on_springs && solution.state[i] == ContactState::slip)
            friction[index(i, c)] = f;
        }
    }
}

template <int dim>
ContactState ActiveSetIteration<dim>::next_state(const unsigned int i)
{
  const ContactState state = solution.state[i];
  if (state == ContactState::held)
    return state;
  // Barely touching nodes must not change their state by round-off.
  const double negligible = options.tolerance * std::fabs(normal.sum()) / n_nodes;
  if (state == ContactState::separated)
    {
      if (displaced[dim * i + normal_axis] + gap(i) >= -negligible / scale)
        return state;
      // A landing node moves freely along the flat until its friction is known.
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
  // A node that moves with its friction sticks before it can slip in the other direction.
  if (tangential.size_of_trial(displaced, i) <= limit ||
      tangential.is_pushed(displaced, i, limit))
    return ContactState::stick;
  tangential.turn(displaced, i);
  return ContactState::slip;
}

template <int dim>
bool ActiveSetIteration<dim>::update_states()
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

template <int dim>
void ActiveSetIteration<dim>::require_contact(const bool enough) const
{
  if (!std::isfinite(normal.sum()))
    fail("the contact forces are not finite");
  const auto touching =
    std::count_if(solution.state.begin(), solution.state.end(),
                  [](const ContactState s) { return s != ContactState::separated; });
  if (enough && touching < (problem.gap.empty() ? 2 : 1))
    fail("the body lifts off or tips over its edge, at most one node stays on the flat");
}

namespace
{
/** Solves by pivots of the condensed contact after the iteration @p failed. */
template <int dim>
StaticContactSolution solve_condensed(const ElasticBody<dim> &body,
                                      const StaticContactProblem &problem,
                                      const StaticContactOptions &options,
                                      const NotConverged &failed)
{
  const std::string said = failed.what();
  CondensedContact<dim> contact(body, problem);
  if (!contact.is_solvable())
    throw NotConverged(
      said + "; only active sets were tried, as other methods take contacts of " +
      std::to_string(CondensedContact<dim>::most) + " displacements at most");
  if (auto found = contact.solve(options.tolerance))
    return std::move(*found);
  if (contact.has_none())
    throw NumericalFailure(
      "static contact: there is no equilibrium, as no contact forces "
      "with this friction carry the load; hold the body otherwise, or change "
      "loads or friction");
  throw NumericalFailure(said + "; " +
                         (dim == 3 && problem.sliding == 0 ? "Newton's" : "Lemke's") +
                         " method on the nodes of the contact alone found no equilibrium "
                         "either, and with this friction there need not be one");
}
} // namespace

template <int dim>
StaticContactSolution solve_static_contact(const ElasticBody<dim> &body,
                                           StaticContactProblem problem,
                                           const StaticContactOptions &options)
{
  const StaticContactProblem given = problem;
  ActiveSetIteration<dim> iteration(body, std::move(problem), options);
  try
    {
      return iteration.run();
    }
  catch (const NotConverged &e)
    {
      StaticContactSolution found = solve_condensed(body, given, options, e);
      found.iterations            = iteration.so_far().iterations;
      found.state_changes         = iteration.so_far().state_changes;
      return found;
    }
}

template StaticContactSolution solve_static_contact(const ElasticBody<2> &,
                                                    StaticContactProblem,
                                                    const StaticContactOptions &);
template StaticContactSolution solve_static_contact(const ElasticBody<3> &,
                                                    StaticContactProblem,
                                                    const StaticContactOptions &);
} // namespace mesoslip
