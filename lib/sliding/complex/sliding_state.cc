#include "sliding/complex/sliding_state.h"

#include "base/errors.h"
#include "sliding/complex/steady_friction.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mesoslip
{
namespace
{
/** Tributary area of a node (m^2, in 2D m), including its periodic copy. */
template <int dim>
double area_of(const SurfaceNodes<dim> &bottom, const std::size_t k)
{
  const bool joined = bottom.closed && (k == 0 || k + 1 == bottom.nodes.size());
  return joined ? std::fabs(bottom.normal_area.front()[dim - 1]) +
                    std::fabs(bottom.normal_area.back()[dim - 1])
                : std::fabs(bottom.normal_area[k][dim - 1]);
}

/** Friction of each surface node by the law in a static contact. */
template <int dim>
std::vector<SteadyFriction> friction_of(const SurfaceNodes<dim> &bottom,
                                        const ElasticBody<dim> &body,
                                        const ContactParameters &parameters,
                                        const std::vector<double> &coefficients,
                                        const StaticContactSolution *solution)
{
  const FrictionLaw &law = parameters.contact.law;
  std::vector<SteadyFriction> result(coefficients.size());
  for (std::size_t k = 0; k < result.size(); ++k)
    {
      if (!law.coefficient_law)
        {
          result[k].coefficient = coefficients[k];
          continue;
        }
      const double area = area_of<dim>(bottom, k);
      SlipPoint at;
      at.slip_rate = std::fabs(parameters.contact.flat_velocity.amplitude());
      at.pressure  = solution == nullptr ? parameters.top.pressure.amplitude()
                     : area > 0.         ? solution->normal_force[k] / area
                                         : 0.;
      for (unsigned int c = 0; c + 1 < dim; ++c)
        at.position[c] = body.point(bottom.nodes[k])[c];
      SteadyFriction &node = result[k];
      node                 = steady_friction(*law.coefficient_law, at);
      const double factor  = coefficients[k] / law.reference;
      node.coefficient *= factor;
      node.slopes = {factor * node.slopes.pressure, factor * node.slopes.rate,
                     factor * node.slopes.state};
    }
  return result;
}

/** Iterates the static contact until its pressures and the coefficients agree. */
template <int dim>
StaticContactSolution settle(const SurfaceNodes<dim> &bottom,
                             const ElasticBody<dim> &body,
                             const ContactParameters &parameters,
                             const std::vector<double> &coefficients,
                             const StaticContact &solve)
{
  constexpr unsigned int most = 50;
  const FrictionLaw &law      = parameters.contact.law;
  std::optional<StaticContactSolution> solution;
  std::vector<double> before;
  for (unsigned int n = 0; n < most; ++n)
    {
      std::vector<double> mu;
      double change = 0.;
      for (const SteadyFriction &node : friction_of<dim>(
             bottom, body, parameters, coefficients, solution ? &*solution : nullptr))
        {
          if (solution)
            change = std::max(change, std::fabs(node.coefficient - before[mu.size()]));
          mu.push_back(node.coefficient);
        }
      if (solution && change < 1e-9)
        return *solution;
      solution = solve(mu);
      if (!law.coefficient_law || !law.coefficient_law->looks_around())
        return *solution;
      before = mu;
    }
  throw NotConverged(
    "coefficients of friction that depend on the pressure and the pressures "
    "in the static state did not settle");
}
} // namespace

namespace
{
/** Tangent stiffness (N/m, in 2D Pa) of the spring of a node that carries @p force. */
double tangent_of(const PowerSpring &spring, const double area, const double force)
{
  return area * (area > 0.
                   ? spring.tangent(spring.depth_under(std::max(0., force) / area))
                   : spring.stiffness);
}
} // namespace

template <int dim>
SlidingState sliding_state(const ElasticBody<dim> &body,
                           const ContactParameters &parameters,
                           const DofMask &held,
                           const std::vector<double> &friction,
                           const StaticContact &solve)
{
  if (!solve && parameters.contact.is_compliant() &&
      !parameters.contact.normal_spring.is_linear())
    throw UserError("Flat/Normal exponent: the top is held, so that the pressure on the "
                    "springs is not known, and with it their stiffness; set "
                    "Supports/Top/Kind = platen or pressure, or the exponent to 1");
  SlidingState state;
  state.held               = held;
  const ContactSetup &flat = parameters.contact;
  for (unsigned int c = 0; c < 2; ++c)
    state.contact.velocity[c] = flat.flat_velocity.amplitude() * flat.flat_direction[c];
  const SurfaceNodes<dim> &bottom = body.surface(ElasticBody<dim>::bottom);
  std::optional<StaticContactSolution> solution;
  if (solve)
    solution = settle<dim>(bottom, body, parameters, friction, solve);
  const std::vector<SteadyFriction> nodes =
    friction_of<dim>(bottom, body, parameters, friction, solution ? &*solution : nullptr);
  for (std::size_t k = 0; k + (bottom.closed ? 1 : 0) < bottom.nodes.size(); ++k)
    {
      const NodeIndex &node = bottom.nodes[k];
      if (held.is_constrained(dim - 1, node))
        continue; // held by a side: no contact node
      if (solution && solution->state[k] == ContactState::separated)
        {
          ++state.n_separated;
          continue;
        }
      const std::vector<WeightedNode> met = body.meets(k);
      if (flat.is_compliant())
        state.contact.stiffness.push_back(
          tangent_of(flat.normal_spring, area_of<dim>(bottom, k),
                     solution ? solution->normal_force[k] : 0.));
      else if (met.empty())
        state.held.constrain(dim - 1, node);
      state.contact.nodes.push_back(node);
      if (!met.empty())
        state.contact.meets.push_back(met);
      state.contact.friction.push_back(nodes[k].coefficient);
      state.contact.normal_force.push_back(solution ? solution->normal_force[k] : 0.);
      state.area.push_back(area_of<dim>(bottom, k));
      if (flat.slips_on_springs())
        state.contact.slack.push_back(
          state.area.back() > 0. ? 1. / (flat.tangential_stiffness * state.area.back())
                                 : 0.);
      if (flat.law.coefficient_law)
        {
          state.contact.slopes.push_back(nodes[k].slopes);
          if (state.area.back() > 0.)
            state.steepest_fall =
              std::max(state.steepest_fall, -nodes[k].slopes.rate *
                                              state.contact.normal_force.back() /
                                              state.area.back());
        }
      state.state_time = nodes[k].state_time;
      state.place.push_back(k);
    }
  body.update_copies(state.held);
  if (state.contact.nodes.empty())
    throw UserError("no contact node touches the flat in the static state of sliding");
  return state;
}

template SlidingState sliding_state(const ElasticBody<2> &,
                                    const ContactParameters &,
                                    const DofMask &,
                                    const std::vector<double> &,
                                    const StaticContact &);
template SlidingState sliding_state(const ElasticBody<3> &,
                                    const ContactParameters &,
                                    const DofMask &,
                                    const std::vector<double> &,
                                    const StaticContact &);
} // namespace mesoslip
