// The flat below a body at rest: where nodes stick, its profile, and springs between them.
#include "base/errors.h"
#include "sliding/analyses/static_load.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
template <int dim>
void StaticLoad<dim>::stick_where_it_is(const double share)
{
  if (!parameters.static_load.has_history())
    return;
  const std::vector<double> &of_flat = parameters.static_load.of_flat;
  constexpr unsigned int bottom      = ElasticBody<dim>::bottom;
  const std::vector<double> u    = elastic.surface_values(bottom, problem.displacement),
                            held = elastic.surface_values(bottom, problem.constrained);
  problem.reference.clear();
  for (std::size_t k = 0; k < u.size(); k += dim)
    for (unsigned int c = 0; c + 1 < dim; ++c)
      {
        const bool moves     = c < of_flat.size() && held[k + c] == 0.;
        const double stretch = stretch_of(k / dim, c);
        problem.reference.push_back(u[k + c] + stretch +
                                    (moves ? share * of_flat[c] : 0.));
      }
}

template <int dim>
double StaticLoad<dim>::stretch_of(const std::size_t i, const unsigned int c) const
{
  const std::vector<double> &stiffness = problem.tangential_stiffness,
                            &friction  = solution.tangential_force;
  return stiffness.empty() || friction.empty()
           ? 0.
           : friction[(dim - 1) * i + c] / stiffness[i];
}

template <int dim>
bool StaticLoad<dim>::follow_profile()
{
  if (!parameters.contact.profile)
    return true;
  const std::vector<double> u =
    elastic.surface_values(ElasticBody<dim>::bottom, problem.displacement);
  std::vector<double> along;
  for (std::size_t k = 0; k < u.size(); ++k)
    if (k % dim != dim - 1)
      along.push_back(u[k]);
  const std::vector<double> before = gaps;
  gaps = gaps_over_profile(*parameters.contact.profile, nodes, way, along);
  if (before.empty())
    return false;
  double change = 0.;
  for (std::size_t i = 0; i < gaps.size(); ++i)
    change = std::max(change, std::fabs(gaps[i] - before[i]));
  const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
  return change <= 100. * options.tolerance * (*most - *least);
}

template <int dim>
void StaticLoad<dim>::solve()
{
  constexpr unsigned int most = 50;
  follow_profile();
  for (unsigned int n = 0; n < most; ++n)
    {
      problem.gap = gaps;
      if (springs)
        springs->linearize(problem, gaps);
      solve_linear();
      const bool on_springs = !springs || settle_springs(), on_flat = follow_profile();
      if (on_springs && on_flat)
        return;
    }
  throw NotConverged(
    "static contact: springs between body and flat, or the profile below "
    "nodes that move along it, did not settle");
}

template <int dim>
bool StaticLoad<dim>::settle_springs()
{
  if (springs->are_linear())
    return true;
  const std::vector<double> u =
    elastic.surface_values(ElasticBody<dim>::bottom, problem.displacement);
  std::vector<double> along_normal;
  for (std::size_t k = dim - 1; k < u.size(); k += dim)
    along_normal.push_back(u[k]);
  return springs->settle(solution, along_normal, gaps) <= options.tolerance;
}

template <int dim>
void StaticLoad<dim>::solve_linear()
{
  const unsigned int iterations = solution.iterations, changes = solution.state_changes,
                     of_solver = solution.solver_iterations;
  solution                     = solve_static_contact(elastic, problem, options);
  solution.iterations += iterations;
  solution.state_changes += changes;
  solution.solver_iterations += of_solver;
  problem.displacement = solution.displacement;
  if (!parameters.static_load.has_history())
    return;
  problem.state    = solution.state;
  problem.friction = solution.tangential_force;
}

#define MESOSLIP_INSTANTIATE(dim)                                 \
  template void StaticLoad<dim>::stick_where_it_is(const double); \
  template void StaticLoad<dim>::solve();
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
