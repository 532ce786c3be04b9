#include "contact/condensed_contact.h"

#include "contact/lemke.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace mesoslip
{
template <int dim>
CondensedContact<dim>::CondensedContact(const ElasticBody<dim> &body,
                                        const StaticContactProblem &problem)
  : body(body)
  , problem(problem)
  , bottom(body.surface(ElasticBody<dim>::bottom))
  , solver(body)
{
  const std::vector<double> held =
    body.surface_values(ElasticBody<dim>::bottom, problem.constrained);
  const std::size_t n_nodes = bottom.normal_area.size() - (bottom.closed ? 1 : 0);
  numbers.assign(dim * n_nodes, -1);
  for (unsigned int i = 0; i < n_nodes; ++i)
    for (unsigned int c = 0; c < dim && held[dim * i + normal_axis] == 0.; ++c)
      if (held[dim * i + c] == 0.)
        {
          numbers[dim * i + c] = static_cast<Eigen::Index>(place.size());
          place.push_back({i, c});
        }
}

template <int dim>
Eigen::VectorXd CondensedContact<dim>::internal_forces(NodalField<double> &u,
                                                       const Eigen::VectorXd &d,
                                                       const NodalField<double> &force)
{
  for (std::size_t k = 0; k < bottom.nodes.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      if (const Eigen::Index at = number(bottom.place(k), c); at >= 0)
        u(c, bottom.nodes[k]) = d[at];
  body.update_copies(u);
  solver.solve(u, force, 1e-12);
  const std::vector<double> internal =
    body.surface_values(ElasticBody<dim>::bottom, solver.internal_force());
  Eigen::VectorXd result(d.size());
  for (Eigen::Index k = 0; k < d.size(); ++k)
    result[k] = internal[dim * place[static_cast<std::size_t>(k)].i +
                         place[static_cast<std::size_t>(k)].c];
  return result;
}

template <int dim>
std::optional<StaticContactSolution> CondensedContact<dim>::solve(const double tolerance)
{
  const auto n = static_cast<Eigen::Index>(place.size());
  DofMask held = problem.constrained;
  for (std::size_t k = 0; k < bottom.nodes.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      if (number(bottom.place(k), c) >= 0)
        held.constrain(c, bottom.nodes[k]);
  body.update_copies(held);
  solver.set_constrained(held);
  const std::vector<double> given =
    body.surface_values(ElasticBody<dim>::bottom, problem.force);
  start = loaded = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k)
    {
      const auto [i, c] = place[static_cast<std::size_t>(k)];
      loaded[k]         = given[dim * i + c];
      if (c == normal_axis)
        start[k] = problem.gap.empty() ? 0. : -problem.gap[i];
      else if (!problem.reference.empty())
        start[k] = problem.reference[(dim - 1) * i + c];
    }
  NodalField<double> u = problem.displacement;
  F                    = internal_forces(u, start, problem.force) - loaded;
  S.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    {
      u        = body.zero_field();
      S.col(k) = internal_forces(u, Eigen::VectorXd::Unit(n, k), body.zero_field());
    }
  stand_on_springs();
  if (dim == 3 && problem.sliding == 0)
    {
      const ConeProblem of    = cones();
      const Eigen::VectorXd d = cone_newton(of);
      return equilibrium(nodes_at(d, of.c), d, tolerance);
    }
  Problem of = problem.sliding != 0 ? of_sliding_flat() : of_resting_flat();
  of.M /= of.M.template lpNorm<Eigen::Infinity>();
  of.q /= of.q.template lpNorm<Eigen::Infinity>();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.1, 1.);
  Eigen::VectorXd cover = Eigen::VectorXd::Ones(of.q.size());
  for (unsigned int k = 0; k < 10; ++k)
    {
      if (const auto z = lemke(of.M, of.q, cover))
        if (auto found =
              equilibrium(nodes_of(of, *z), Eigen::VectorXd::Zero(n), tolerance))
          return found;
      for (double &x : cover)
        x = share(random);
    }
  none = is_infeasible(of.M, of.q);
  return std::nullopt;
}

template <int dim>
void CondensedContact<dim>::stand_on_springs()
{
  softness = Eigen::VectorXd::Zero(F.size());
  const std::vector<double> no_springs;
  const std::vector<double> &along =
    problem.sliding == 0 ? problem.tangential_stiffness : no_springs;
  if (problem.stiffness.empty() && along.empty())
    return;
  for (Eigen::Index k = 0; k < F.size(); ++k)
    {
      const auto [i, c]                    = place[static_cast<std::size_t>(k)];
      const std::vector<double> &stiffness = c == normal_axis ? problem.stiffness : along;
      softness[k]                          = stiffness.empty() ? 0. : 1. / stiffness[i];
    }
  const Eigen::MatrixXd more =
    Eigen::MatrixXd::Identity(F.size(), F.size()) + S * softness.asDiagonal();
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(more);
  F = factors.solve(F).eval();
  S = factors.solve(S).eval();
}

template <int dim>
std::vector<typename CondensedContact<dim>::Node>
CondensedContact<dim>::nodes_of(const Problem &of, const Eigen::VectorXd &z) const
{
  std::vector<Node> nodes(numbers.size() / dim);
  for (const Place &at : place)
    {
      nodes[at.i].state =
        problem.sliding != 0 || !(problem.friction_coefficient[at.i] > 0.)
          ? ContactState::slip
          : ContactState::stick;
      for (unsigned int c = 0; c + 1 < dim; ++c)
        nodes[at.i].direction[c] = problem.sliding * problem.flat_direction[c];
    }
  for (Eigen::Index k = 0; k < z.size(); ++k)
    {
      const auto [at, sign] = of.z[static_cast<std::size_t>(k)];
      const auto [i, c]     = place[static_cast<std::size_t>(at)];
      Node &node            = nodes[i];
      if (!(z[k] > 0.) || node.state == ContactState::separated)
        continue;
      node.state = c == normal_axis ? ContactState::separated : ContactState::slip;
      if (c != normal_axis)
        node.direction[c] = -sign;
    }
  return nodes;
}

template <int dim>
ConeProblem CondensedContact<dim>::cones() const
{
  ConeProblem result{S, F, {}, 0.3 * S.lpNorm<Eigen::Infinity>()};
  for (unsigned int i = 0; i < numbers.size() / dim; ++i)
    if (const Eigen::Index normal = number(i, normal_axis); normal >= 0)
      {
        result.nodes.push_back({normal, {}, problem.friction_coefficient[i]});
        for (unsigned int c = 0; c + 1 < dim; ++c)
          if (const Eigen::Index along = number(i, c); along >= 0)
            result.nodes.back().along.push_back(along);
      }
  return result;
}

template <int dim>
std::vector<typename CondensedContact<dim>::Node>
CondensedContact<dim>::nodes_at(const Eigen::VectorXd &d, const double c) const
{
  const Eigen::VectorXd f = F + S * d, augmented = f - c * d;
  std::vector<Node> nodes(numbers.size() / dim);
  for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      const Eigen::Index normal = number(i, normal_axis);
      if (normal < 0)
        continue;
      Node &node   = nodes[i];
      double size  = 0.;
      const auto t = [&](const unsigned int axis) {
        return number(i, axis) < 0 ? 0. : augmented[number(i, axis)];
      };
      for (unsigned int axis = 0; axis + 1 < dim; ++axis)
        size = std::hypot(size, t(axis));
      const double limit = problem.friction_coefficient[i] * f[normal];
      node.state         = !(augmented[normal] > 0.) ? ContactState::separated
                           : size < limit            ? ContactState::stick
                                                     : ContactState::slip;
      for (unsigned int axis = 0; axis + 1 < dim && size > 0. && limit > 0.; ++axis)
        node.direction[axis] = t(axis) / size;
    }
  return nodes;
}

template <int dim>
Eigen::MatrixXd CondensedContact<dim>::conditions(const std::vector<Node> &nodes) const
{
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(F.size(), F.size());
  for (Eigen::Index k = 0; k < F.size(); ++k)
    {
      const auto [i, c] = place[static_cast<std::size_t>(k)];
      const Node &node  = nodes[i];
      if (node.state == ContactState::separated ||
          (c != normal_axis && node.state == ContactState::slip))
        rows(k, k) = 1.;
      if (c != normal_axis && node.state == ContactState::slip)
        rows(k, number(i, normal_axis)) =
          -problem.friction_coefficient[i] * node.direction[c];
    }
  return rows;
}

template <int dim>
std::optional<StaticContactSolution> CondensedContact<dim>::equilibrium(
  const std::vector<Node> &nodes, Eigen::VectorXd d, const double tolerance)
{
  const Eigen::MatrixXd rows = conditions(nodes);
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < F.size(); ++k)
    if (rows(k, k) != 0.)
      free.push_back(k);
  StaticContactSolution found;
  found.displacement = problem.displacement;
  Eigen::FullPivLU<Eigen::MatrixXd> moves;
  Eigen::VectorXd f;
  double pressed = 0., left = 1.;
  // Repeated if S is not exact enough.
  for (unsigned int n = 0; n < 5; ++n)
    {
      const Eigen::VectorXd pressed_in = softness.cwiseProduct(F + S * d);
      f = internal_forces(found.displacement, start + d - pressed_in, problem.force) -
          loaded;
      const Eigen::VectorXd residual = rows * f;
      left                           = residual.template lpNorm<1>();
      pressed                        = 0.;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        pressed += number(i, normal_axis) < 0 ? 0. : f[number(i, normal_axis)];
      if (left <= 0.1 * tolerance * pressed || free.empty() || n == 4)
        break;
      if (n == 0)
        {
          const Eigen::MatrixXd all = rows * S;
          moves.compute(all(free, free));
        }
      const Eigen::VectorXd of_free = residual(free), step = moves.solve(of_free);
      d(free) -= step;
    }
  found.residual = found.friction_change = left / pressed;
  bool holds                             = left <= tolerance * pressed;
  const double negligible                = tolerance * pressed / nodes.size(),
               short_way                 = negligible / stiffness_scale(body);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const auto &[state, direction] = nodes[i];
      const Eigen::Index at          = number(i, normal_axis);
      const bool touches             = at >= 0 && state != ContactState::separated;
      const double normal            = touches ? f[at] : 0.;
      const double limit             = problem.friction_coefficient[i] * normal;
      holds =
        holds && normal >= -negligible && (at < 0 || touches || d[at] >= -short_way);
      found.state.push_back(state);
      found.normal_force.push_back(normal);
      double size    = 0.; // norm of the friction
      double way     = 0.; // norm of the slip
      double against = 0.; // slip not opposite to friction
      for (unsigned int c = 0; c + 1 < dim; ++c)
        way = number(i, c) < 0 ? way : std::hypot(way, d[number(i, c)]);
      for (unsigned int c = 0; c + 1 < dim; ++c)
        {
          const Eigen::Index along = number(i, c);
          double friction          = touches ? direction[c] * limit : 0.;
          if (state == ContactState::stick || (problem.sliding == 0 && along < 0))
            friction = along < 0 ? 0. : f[along];
          found.tangential_force.push_back(friction);
          if (along >= 0)
            {
              size    = std::hypot(size, friction);
              against = std::hypot(against, d[along] + way * direction[c]);
            }
        }
      holds = holds && (state != ContactState::stick || size <= limit + negligible);
      if (problem.sliding == 0 && state == ContactState::slip && limit > 0.)
        holds = holds && against <= 2. * short_way;
    }
  if (bottom.closed)
    {
      found.state.push_back(found.state[0]);
      found.normal_force.push_back(found.normal_force[0]);
      found.tangential_force.push_back(found.tangential_force[0]);
    }
  found.solver_iterations = solver.iterations();
  return holds ? std::make_optional(std::move(found)) : std::nullopt;
}

template class CondensedContact<2>;
template class CondensedContact<3>;
} // namespace mesoslip
