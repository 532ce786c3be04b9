#include "sliding/analyses/static_load.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "material/plausibility.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>

namespace mesoslip
{
double total_normal_force(const StaticContactSolution &solution,
                          const std::size_t n_nodes)
{
  const std::vector<double> &force = solution.normal_force;
  return std::accumulate(force.begin(),
                         force.begin() + static_cast<std::ptrdiff_t>(n_nodes), 0.);
}

double total_tangential_force(const StaticContactSolution &solution,
                              const std::size_t n_nodes,
                              const unsigned int c,
                              const unsigned int n_tangents)
{
  double sum = 0.;
  for (std::size_t k = 0; k < n_nodes; ++k)
    sum += solution.tangential_force[n_tangents * k + c];
  return sum;
}

namespace
{
/** Whether sides load the body, and not only the platen. */
bool push(const std::vector<SideSupport> &sides)
{
  for (const SideSupport &side : sides)
    {
      if (side.pressure.amplitude() != 0.)
        return true;
      for (unsigned int c = 0; c < 3; ++c)
        if (side.suspension.stiffness[c] * side.suspension.motion[c](0.) != 0. ||
            side.suspension.traction.acts(c))
          return true;
    }
  return false;
}

} // namespace

template <int dim>
StaticLoad<dim>::StaticLoad(const GivenBody<dim> &body,
                            const ContactParameters &parameters,
                            const std::vector<double> &friction)
  : parameters(parameters)
  , facts(body.facts())
  , nodes(body.contact_nodes())
  , elastic(body.elastic())
  , top(body.top_nodes())
  , strain(parameters.top.pressure.amplitude() /
           elastic.phases()[0].stiffness(dim - 1, dim - 1))
  , whole_load(elastic.zero_field())
{
  const double load            = parameters.top.pressure.amplitude(),
               v               = parameters.contact.flat_velocity.amplitude();
  problem.constrained          = body.held(top_at_rest(parameters), false);
  problem.displacement         = body.compressed(strain / parameters.static_load.steps);
  problem.force                = elastic.zero_field();
  problem.friction_coefficient = friction;
  gaps                         = facts.contact_height;
  if (parameters.contact.is_compliant())
    springs.emplace(parameters.contact.normal_spring, facts.size.area,
                    load > 0. ? load : parameters.contact.normal_spring.at);
  if (parameters.contact.slips_on_springs() && v == 0.)
    for (const double area : spring_areas(facts.size.area))
      problem.tangential_stiffness.push_back(parameters.contact.tangential_stiffness *
                                             area);
  problem.sliding                = v > 0. ? 1 : (v < 0. ? -1 : 0);
  problem.flat_direction         = parameters.contact.flat_direction;
  const unsigned int n           = elastic.n_columns();
  const std::vector<double> mass = elastic.lumped_mass();
  for (unsigned int k = 0; k < mass.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      whole_load(c, {k % n, k / n}) = mass[k] * parameters.step.acceleration[c];
  if (!parameters.top.is_platen)
    for (std::size_t k = 0; k < top.nodes.size(); ++k)
      whole_load(dim - 1, top.nodes[k]) -= load * top.carried.area[k];
  pull(top, parameters.top.suspension);
  const std::vector<SideSupport> sides     = body.loaded_sides();
  sides_push                               = push(sides);
  const std::vector<SupportNodes> of_sides = body.side_nodes();
  for (std::size_t s = 0; s < sides.size(); ++s)
    {
      const double pressure = sides[s].pressure.amplitude();
      for (std::size_t k = 0; k < of_sides[s].nodes.size() && !sides[s].is_platen; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          whole_load(c, of_sides[s].nodes[k]) +=
            pressure * of_sides[s].carried.push_of(k, c);
      pull(of_sides[s], sides[s].suspension);
    }
  elastic.act_on_displacements(whole_load);
  add_platens(body);
}

/** Adds tractions, and the forces of springs whose far ends have moved, at t = 0. */
template <int dim>
void StaticLoad<dim>::pull(const SupportNodes &support, const Suspension &suspension)
{
  for (std::size_t k = 0; k < support.nodes.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      whole_load(c, support.nodes[k]) +=
        support.carried.area[k] *
        (suspension.stiffness[c] * suspension.motion[c](0.) +
         suspension.traction(c, support.carried.place_of(k), 0.));
}

template <int dim>
StaticContactSolution StaticLoad<dim>::follow(const StaticContactOptions &given)
{
  options                          = given;
  const StaticLoadParameters &load = parameters.static_load;
  const bool platen                = !platen_moves.empty();
  for (unsigned int n = 1; n <= load.steps; ++n)
    {
      const double share = static_cast<double>(n) / load.steps;
      stick_where_it_is(0.);
      problem.force = whole_load;
      for (std::size_t k = 0; k < problem.force.size(); ++k)
        problem.force.begin()[k] *= share;
      if (parameters.top.is_platen && platen_moves.size() == 1 && gaps.empty() &&
          !parameters.contact.profile && !(springs && !springs->are_linear()) &&
          !load.has_history() && !parameters.step.is_heavy() && !sides_push &&
          !parameters.top.suspension.is_there())
        press_in_proportion();
      else if (platen)
        press(share);
      else
        solve();
      record(share, 0.);
    }
  for (unsigned int n = 1; n <= load.steps && load.moves_flat(); ++n)
    {
      stick_where_it_is(1. / load.steps);
      for (std::size_t c = 0; c < load.of_flat.size(); ++c)
        way[c] = n * load.of_flat[c] / load.steps;
      if (platen) // moves along the normal, and along the flat on its springs
        press(1.);
      else
        solve();
      record(1., static_cast<double>(n) / load.steps);
    }
  if (!(normal_force() > 0.))
    throw NotConverged("static contact: no node touches the flat, as the supports carry "
                       "all of the load");
  return solution;
}

template <int dim>
double StaticLoad<dim>::normal_force() const
{
  return total_normal_force(solution, facts.size.n_contact_nodes);
}

template <int dim>
void StaticLoad<dim>::record(const double share, const double share_of_flat)
{
  const std::vector<double> &of_flat = parameters.static_load.of_flat;
  StaticLoadStep step;
  step.share        = share;
  step.normal_force = normal_force();
  for (unsigned int c = 0; c + 1 < dim; ++c)
    {
      step.displacement[c] = c < of_flat.size() ? share_of_flat * of_flat[c] : 0.;
      step.tangential_force[c] =
        total_tangential_force(solution, facts.size.n_contact_nodes, c, dim - 1);
    }
  for (std::size_t i = 0; i < facts.size.n_contact_nodes; ++i)
    {
      const double area = std::fabs(facts.size.area[i]);
      if (solution.state[i] == ContactState::stick)
        step.stick_area += area;
      if (solution.state[i] != ContactState::separated)
        step.contact_area += area;
    }
  step.iterations = solution.iterations;
  for (const StaticLoadStep &before : done)
    step.iterations -= before.iterations;
  done.push_back(step);
}

template class StaticLoad<2>;
template class StaticLoad<3>;
} // namespace mesoslip
