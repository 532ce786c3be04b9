#include "sliding/mesh/statics/mesh_static_load.h"

#include "base/errors.h"
#include "material/plausibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mesoslip
{
double total_normal_force(const StaticContactSolution &solution)
{
  return std::accumulate(solution.normal_force.begin(), solution.normal_force.end(), 0.);
}

double total_tangential_force(const StaticContactSolution &solution,
                              const unsigned int c,
                              const unsigned int n_tangents)
{
  double sum = 0.;
  for (std::size_t k = c; k < solution.tangential_force.size(); k += n_tangents)
    sum += solution.tangential_force[k];
  return sum;
}

template <int dim>
void check_mesh_static(const ContactParameters &p, const std::vector<double> &mu)
{
  const bool platen = p.top.kind == TopSetup::Kind::platen;
  if (p.top.kind == TopSetup::Kind::held)
    throw UserError("Top/Kind is held, so nothing presses the body on the flat; use "
                    "platen or pressure for a static contact analysis");
  if (platen && p.step.is_heavy())
    throw UserError("Body/Acceleration is not zero, which a static contact analysis "
                    "under a platen does not take; set it to 0, or Top/Kind = "
                    "pressure, which loads each node by itself");
  if (!(p.top.pressure.amplitude() > 0.))
    throw UserError("Top/Pressure is " + to_text(p.top.pressure.amplitude()) +
                    " Pa; a static contact analysis needs a positive one");
  if (p.contact.gap != 0.)
    throw UserError("Flat/Gap is " + to_text(p.contact.gap) +
                    " m; a static contact analysis starts from a body that touches the "
                    "flat, set it to 0");
  const bool rubs                    = *std::max_element(mu.begin(), mu.end()) > 0.;
  const double speed                 = p.contact.flat_velocity.amplitude();
  const std::vector<double> &of_flat = p.static_load.of_flat;
  for (unsigned int c = 0; c + 1 < dim; ++c)
    {
      const std::string side = p.mesh.is_given()
                                 ? std::string("a group in Mesh/Held in ") + "xy"[c]
                                 : std::string("a side in u_") + "xy"[c] + " (Sides)";
      if (p.top.holds_tangentially() || !p.mesh.held[c].empty())
        continue;
      if (rubs && speed * p.contact.flat_direction[c] != 0.)
        throw UserError(
          "Nothing holds the body against the friction of the sliding flat: set "
          "Top/Lateral held, hold " +
          side + ", use a platen, Friction/Coefficient = 0 or Flat/Velocity = 0");
      if (c < of_flat.size() && of_flat[c] != 0.)
        throw UserError(
          "Static contact/Flat displacement: nothing holds the body against the "
          "flat; set Top/Lateral held, use a platen or hold " +
          side);
    }
}

template <int dim>
MeshStaticLoad<dim>::MeshStaticLoad(const ContactParameters &parameters,
                                    const MeshBodyDescription &body,
                                    const MeshBody<dim> &elastic,
                                    const DofMask &held,
                                    const double stiffness)
  : parameters(parameters)
  , body(body)
  , elastic(elastic)
  , stiffness(stiffness)
  , whole_load(elastic.zero_field())
{
  const ContactParameters &p     = parameters;
  const double load              = p.top.pressure.amplitude();
  const MeshBoundary &top        = body.top;
  problem.constrained            = held;
  problem.displacement           = elastic.zero_field();
  problem.force                  = elastic.zero_field();
  problem.friction_coefficient   = body.friction;
  problem.gap                    = body.contact.height;
  const double v                 = p.contact.flat_velocity.amplitude();
  problem.sliding                = v > 0. ? 1 : (v < 0. ? -1 : 0);
  problem.flat_direction         = p.contact.flat_direction;
  const std::vector<double> mass = elastic.lumped_mass();
  for (unsigned int i = 0; i < mass.size(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      whole_load(c, {i, 0}) = mass[i] * p.step.acceleration[c];
  for (std::size_t k = 0; k < top.points.size() && p.top.kind == TopSetup::Kind::pressure;
       ++k)
    if (const auto node = elastic.find(top.points[k]))
      whole_load(dim - 1, *node) -= load * top.area[k];
}

template <int dim>
StaticContactSolution MeshStaticLoad<dim>::follow(const StaticContactOptions &given)
{
  options                          = given;
  const StaticLoadParameters &load = parameters.static_load;
  const bool platen                = parameters.top.kind == TopSetup::Kind::platen;
  for (unsigned int n = 1; n <= load.steps; ++n)
    {
      const double share = static_cast<double>(n) / load.steps;
      stick_where_it_is(0.);
      problem.force = whole_load;
      for (std::size_t k = 0; k < problem.force.size(); ++k)
        problem.force.begin()[k] *= share;
      if (platen)
        press(share);
      else
        solve();
      record(share, 0.);
    }
  for (unsigned int n = 1; n <= load.steps && load.moves_flat(); ++n)
    {
      stick_where_it_is(1. / load.steps);
      solve();
      record(1., static_cast<double>(n) / load.steps);
    }
  return solution;
}

template <int dim>
void MeshStaticLoad<dim>::stick_where_it_is(const double share)
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
        const bool moves = c < of_flat.size() && held[k + c] == 0.;
        problem.reference.push_back(u[k + c] + (moves ? share * of_flat[c] : 0.));
      }
}

template <int dim>
void MeshStaticLoad<dim>::solve()
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

template <int dim>
void MeshStaticLoad<dim>::press(const double share)
{
  // The force grows with the displacement, in proportion where there are no gaps: the
  // secant through the last two.
  constexpr unsigned int most = 20;
  const MeshBoundary &top     = body.top;
  const double load           = parameters.top.pressure.amplitude() * share,
               wanted = load * std::accumulate(top.area.begin(), top.area.end(), 0.);
  if (done.empty())
    lowered = load / stiffness * elastic.extent(dim - 1);
  else
    {
      lowered_before = lowered;
      force_before   = total_normal_force(solution);
      lowered *= share / done.back().share;
    }
  for (unsigned int n = 0; n < most; ++n)
    {
      for (const unsigned int point : top.points)
        if (const auto node = elastic.find(point))
          problem.displacement(dim - 1, *node) = -lowered;
      solve();
      const double force = total_normal_force(solution);
      if (std::fabs(force - wanted) <= 10. * options.tolerance * wanted)
        return;
      const double next =
        lowered + (wanted - force) * (lowered - lowered_before) / (force - force_before);
      lowered_before = lowered;
      force_before   = force;
      lowered        = next;
    }
  throw NotConverged(brief_text(6, "static contact: the flat carries ", force_before,
                                " of ", wanted, " N after lowering the platen ", most,
                                " times"));
}

template <int dim>
void MeshStaticLoad<dim>::record(const double share, const double share_of_flat)
{
  const std::vector<double> &of_flat = parameters.static_load.of_flat;
  StaticLoadStep step;
  step.share        = share;
  step.normal_force = total_normal_force(solution);
  for (unsigned int c = 0; c + 1 < dim; ++c)
    {
      step.displacement[c]     = c < of_flat.size() ? share_of_flat * of_flat[c] : 0.;
      step.tangential_force[c] = total_tangential_force(solution, c, dim - 1);
    }
  for (std::size_t i = 0; i < solution.state.size(); ++i)
    {
      const double area = std::fabs(body.contact.area[i]);
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

template void check_mesh_static<2>(const ContactParameters &,
                                   const std::vector<double> &);
template void check_mesh_static<3>(const ContactParameters &,
                                   const std::vector<double> &);
template class MeshStaticLoad<2>;
template class MeshStaticLoad<3>;
} // namespace mesoslip
