#include "contact/static_contact_solver.h"

#include "material/plausibility.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <deque>

namespace mesoslip
{
namespace
{
double stiffest(const ElasticBody<2> &body)
{
  double D = 0.;
  for (const ElasticPhase<2> &phase : body.phases())
    D = std::max(D, phase.stiffness(1, 1));
  return D;
}

/**
 * Anderson's acceleration of a fixed-point iteration x = g(x) (D. G. Anderson, J. ACM 12,
 * 1965): the next x combines the last few g(x) so that their residuals, combined alike,
 * are least. On a linear g it is as good as GMRES.
 */
class AndersonAcceleration
{
public:
  /** Forgets everything, because g is another function now. */
  void reset()
  {
    residuals.clear();
    images.clear();
  }

  /** The next x from @p x and @p g = g(x). */
  Eigen::VectorXd next(const Eigen::VectorXd &x, const Eigen::VectorXd &g)
  {
    residuals.emplace_back(g - x);
    images.push_back(g);
    if (images.size() > depth + 1)
      {
        residuals.pop_front();
        images.pop_front();
      }
    const Eigen::Index m = static_cast<Eigen::Index>(images.size()) - 1;
    if (m == 0)
      return g;
    Eigen::MatrixXd dr(x.size(), m), dg(x.size(), m);
    for (Eigen::Index k = 0; k < m; ++k)
      {
        dr.col(k) = residuals[k + 1] - residuals[k];
        dg.col(k) = images[k + 1] - images[k];
      }
    return g - dg * dr.colPivHouseholderQr().solve(residuals.back());
  }

private:
  static constexpr std::size_t depth = 10; ///< former iterates that are kept
  std::deque<Eigen::VectorXd> residuals, images;
};

/** The iteration and its state. */
class ActiveSetIteration
{
public:
  ActiveSetIteration(const ElasticBody<2> &body,
                     StaticContactProblem &&given,
                     const StaticContactOptions &options)
    : body(body)
    , problem(std::move(given))
    , options(options)
    , solver(body.make_solver())
    , nodes(body.surface(ElasticBody<2>::bottom).nodes)
    , n_nodes(nodes.size() - (body.periodicity().x ? 1 : 0))
    , scale(stiffest(body))
    , force(problem.force)
    , Ku(body.zero_field())
    , residual(Ku)
    , correction(Ku)
    , friction(Eigen::VectorXd::Zero(n_nodes))
    , normal(Eigen::VectorXd::Zero(n_nodes))
    , tangential(Eigen::VectorXd::Zero(n_nodes))
    , direction(n_nodes, problem.sliding)
  {
    for (unsigned int i = 0; i < n_nodes; ++i)
      solution.state.push_back(problem.constrained.is_constrained(1, nodes[i])
                                 ? ContactState::held
                                 : at_rest(i));
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
        solve(std::max(options.tolerance, changed ? 1e-5 : 1e-2 * change));
        evaluate_reactions();
        ++solution.iterations;
        changed = update_states();
        require_contact();
        if (changed)
          {
            ++solution.state_changes;
            acceleration.reset();
            hold_contact();
            change = 1.;
          }
        else
          change = relax_friction();
      }

    solution.displacement    = problem.displacement;
    solution.friction_change = change;
    solution.normal_force.assign(normal.data(), normal.data() + n_nodes);
    solution.tangential_force.assign(tangential.data(), tangential.data() + n_nodes);
    if (body.periodicity().x)
      {
        solution.normal_force.push_back(normal[0]);
        solution.tangential_force.push_back(tangential[0]);
        solution.state.push_back(solution.state[0]);
      }
    return std::move(solution);
  }

private:
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

  void hold_contact()
  {
    constrained           = problem.constrained;
    NodalField<double> &u = problem.displacement;
    const auto put        = [&](const unsigned int c, const unsigned int i) {
      // Held by a side: that value counts.
      if (constrained.is_constrained(c, nodes[i]))
        return;
      constrained.constrain(c, nodes[i]);
      u(c, nodes[i]) = 0.;
      if (i == 0 && body.periodicity().x)
        {
          constrained.constrain(c, nodes[n_nodes]);
          u(c, nodes[n_nodes]) = 0.;
        }
    };
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        if (touches(i))
          put(1, i);
        if (solution.state[i] == ContactState::stick)
          put(0, i);
      }
    solver->set_constrained(constrained);
  }

  void set_forces()
  {
    for (unsigned int i = 0; i < n_nodes; ++i)
      force(0, nodes[i]) = problem.force(0, nodes[i]) + friction[i];
    body.copy_duplicates(force);
  }

  // Of the free degrees of freedom, relative to all nodal forces; Ku is up to date after
  // it.
  double residual_norm()
  {
    double free = 0., all = 0.;
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = 0; j < body.n_rows(); ++j)
        for (unsigned int i = 0; i < body.n_columns(); ++i)
          {
            const NodeIndex node  = {i, j};
            const double internal = Ku(c, node);
            const double x =
              constrained.is_constrained(c, node) ? 0. : force(c, node) - internal;
            residual(c, node) = x;
            free += x * x;
            all += internal * internal;
          }
    return all > 0. ? std::sqrt(free / all) : (free > 0. ? 1. : 0.);
  }

  // Solves for corrections, so that a good guess is worth something whatever the solver
  // measures its tolerance by.
  void solve(const double tolerance)
  {
    NodalField<double> &u = problem.displacement;
    for (unsigned int k = 0;; ++k)
      {
        body.vmult(Ku, u);
        solution.residual = residual_norm();
        if (solution.residual <= tolerance || k == 4)
          return;
        correction.set_zero();
        solution.solver_iterations +=
          solver
            ->solve(correction, residual,
                    std::min(0.5, 0.5 * tolerance / solution.residual))
            .iterations;
        for (std::size_t n = 0; n < u.size(); ++n)
          u.begin()[n] += correction.begin()[n];
      }
  }

  void evaluate_reactions()
  {
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        normal[i]     = touches(i) ? Ku(1, nodes[i]) - problem.force(1, nodes[i]) : 0.;
        tangential[i] = solution.state[i] == ContactState::stick
                          ? Ku(0, nodes[i]) - problem.force(0, nodes[i])
                        : touches(i) ? friction[i]
                                     : 0.;
      }
  }

  ContactState next_state(const unsigned int i)
  {
    const ContactState state = solution.state[i];
    if (state == ContactState::held)
      return state;
    // Nodes that hardly touch must not change to and fro with the round-off.
    const double negligible = options.tolerance * std::fabs(normal.sum()) / n_nodes;
    const double ux         = problem.displacement(0, nodes[i]),
                 uy         = problem.displacement(1, nodes[i]);
    if (state == ContactState::separated)
      {
        if (uy >= -negligible / scale)
          return state;
        return at_rest(i);
      }
    if (normal[i] < -negligible)
      return ContactState::separated;
    if (at_rest(i) == ContactState::slip)
      return ContactState::slip;
    // Resting flat: friction opposes the displacement and stays below its limit.
    const double trial = tangential[i] - scale * ux;
    if (std::fabs(trial) <= problem.friction_coefficient[i] * normal[i])
      return ContactState::stick;
    direction[i] = trial > 0. ? 1 : -1;
    return ContactState::slip;
  }

  bool update_states()
  {
    bool changed = false;
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        const int before         = direction[i];
        const ContactState state = next_state(i);
        const bool turned = state == ContactState::slip && direction[i] != before &&
                            solution.state[i] == ContactState::slip;
        if (state == solution.state[i] && !turned)
          continue;
        changed           = true;
        solution.state[i] = state;
        friction[i] =
          state == ContactState::slip
            ? direction[i] * problem.friction_coefficient[i] * std::max(0., normal[i])
            : 0.;
      }
    return changed;
  }

  // Returns the change as a share of the normal force.
  double relax_friction()
  {
    Eigen::VectorXd target = Eigen::VectorXd::Zero(n_nodes);
    for (unsigned int i = 0; i < n_nodes; ++i)
      if (solution.state[i] == ContactState::slip)
        target[i] = direction[i] * problem.friction_coefficient[i] * normal[i];
    const double change = (target - friction).lpNorm<1>() / normal.lpNorm<1>();
    friction            = acceleration.next(friction, target);
    return change;
  }

  template <typename... Parts>
  [[noreturn]] void fail(const Parts &...what) const
  {
    throw NotConverged(brief_text(6, "static contact: ", what..., " (iteration ",
                                  solution.iterations, ")"));
  }

  void require_contact() const
  {
    const double sum = normal.sum();
    if (!std::isfinite(sum))
      fail("the contact forces are not finite");
    const auto touching =
      std::count_if(solution.state.begin(), solution.state.end(),
                    [](const ContactState s) { return s != ContactState::separated; });
    if (touching < 2)
      fail(
        "the body lifts off or tips over its edge, at most one node stays on the flat");
  }

  const ElasticBody<2> &body;
  StaticContactProblem problem;
  const StaticContactOptions &options;
  std::unique_ptr<StaticSolver> solver;
  const std::vector<NodeIndex> &nodes; ///< of the bottom, the duplicate at the end
  const unsigned int n_nodes;          ///< distinct ones of the bottom
  const double scale;                  ///< Pa: compares displacements with forces

  DofMask constrained;
  NodalField<double> force, Ku, residual, correction;
  Eigen::VectorXd friction, normal, tangential;
  std::vector<int> direction; ///< of the friction force at nodes that slip
  AndersonAcceleration acceleration;
  StaticContactSolution solution;
};
} // namespace

std::string to_string(const ContactState state)
{
  const char *const names[] = {"separated", "stick", "slip", "held"};
  return names[static_cast<unsigned int>(state)];
}

StaticContactSolution solve_static_contact(const ElasticBody<2> &body,
                                           StaticContactProblem problem,
                                           const StaticContactOptions &options)
{
  return ActiveSetIteration(body, std::move(problem), options).run();
}
} // namespace mesoslip
