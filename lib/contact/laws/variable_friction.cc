#include "contact/laws/variable_friction.h"

#include "contact/laws/flat_spring_impl.h"
#include "contact/laws/free_gap.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
template <int dim>
VariableFriction<dim>::VariableFriction(
  const FrictionLaw &law,
  const std::vector<double> &coefficients,
  const std::vector<double> &area,
  const std::array<std::vector<double>, 2> &position,
  const StepParameters &step)
  : law(law)
  , step(step)
  , factor(coefficients)
  , area(area)
  , position(position)
  , before(coefficients.size())
  , normal(coefficients.size())
  , free_rate(coefficients.size())
  , softness(coefficients.size())
  , pressure(area.size())
  , coefficient(coefficients.size())
{
  if (law.coefficient_law)
    for (double &f : factor)
      f = f == law.reference ? 1. : f / law.reference;
  if (law.coefficient_law && law.coefficient_law->state())
    kept.states.assign(factor.size(), law.coefficient_law->state()->initial);
  if (law.normal_stress.is_given())
    kept.remembered.assign(factor.size(), 0.);
}

// As in the contact kernel; see the class.
template <int dim>
typename VariableFriction<dim>::Node
VariableFriction<dim>::predict(const SurfaceView<dim> &surface,
                               const FlatMotion &flat,
                               const ContactArrays &contact,
                               const std::size_t i)
{
  using Arrays  = ContactArrays;
  const auto at = [&](const Arrays::Column c) { return contact.column[c][i]; };
  const Arrays::Column forces[]  = {Arrays::tangential_force, Arrays::lateral_force},
                       targets[] = {Arrays::target, Arrays::lateral_target};
  const double dt = step.dt, c = (0.5 + step.beta2) * dt * dt;
  const double lag = at(Arrays::lag), decay = at(Arrays::decay);

  SlipStep &last = before[i];
  last.dt        = dt;
  last.touches   = at(Arrays::touching) != 0.;
  last.sticks    = at(Arrays::sticking) != 0.;

  constexpr Arrays::Column increments[] = {Arrays::increment_x,
                                           Arrays::lateral_increment},
                           stretches[]  = {Arrays::stretch, Arrays::lateral_stretch},
                           of_before[]  = {Arrays::stretch_before,
                                           Arrays::lateral_stretch_before};
  const double slack = at(Arrays::slackness), ahead = last.touches ? 2. : 1.;
  double slip[dim - 1], rate[dim - 1]; // without friction of this step
  double moved = 0., distance = 0.;
  for (unsigned int k = 0; k + 1 < dim; ++k)
    {
      const double w         = surface.w[k][i],
                   braking   = surface.force[k][i] * surface.inverse_mass[k][i],
                   remembers = decay * at(forces[k]) + (lag - decay) * at(targets[k]);
      // The previous stretch of the tangential spring may slide, the new stretch may not,
      // see stretch_springs().
      const double stretch = at(stretches[k]), stretched = stretch - at(of_before[k]),
                   next = slack * (ahead * remembers - (ahead - 1.) * at(forces[k]));
      slip[k]           = (flat.now[k] - w) * dt + c * braking + stretch;
      rate[k] = (1. - step.beta2) * flat.before[k] + step.beta2 * flat.now[k] - w +
                step.beta2 * dt * (braking - surface.inverse_mass[k][i] * remembers) +
                (step.beta2 * (stretch - next) - (1. - step.beta2) * stretched) / dt;
      moved    = std::hypot(moved, flat.before[k] * dt - at(increments[k]) - stretched);
      distance = std::hypot(distance, slip[k]);
    }
  last.slip_rate = last.sticks ? 0. : moved / dt;

  Node node;
  const double minv    = surface.inverse_mass[dim - 1][i],
               height  = at(Arrays::gap) + surface.u[dim - 1][i],
               gap     = free_gap(surface, at(Arrays::gap), i, step),
               earlier = std::max(0., at(Arrays::increment_y) - height -
                                        at(Arrays::rise) - at(Arrays::rise_before));
  node.normal          = !(gap < 0. && minv > 0.) ? 0.
                         : at(Arrays::pressing) >= 0.
                           ? at(Arrays::pressing)
                           : force_of_flat(gap, earlier, at(Arrays::softness), c * minv);
  for (unsigned int k = 0; k + 1 < dim && distance > 0.; ++k)
    {
      const double e = slip[k] / distance;
      node.free_rate += e * rate[k];
      node.softness += e * e * step.beta2 *
                       (dt * surface.inverse_mass[k][i] + ahead * slack / dt) *
                       (1. - lag);
    }
  return node;
}

template <int dim>
void VariableFriction<dim>::note_weakening(const double soft, const double share)
{
  const double by_rate = soft * law.coefficient_law->steepest_fall(),
               by_slip = share > 0. ? soft / (share * step.beta2) * step.dt *
                                        law.coefficient_law->steepest_fall_in_slip()
                                    : 0.;
  kept.weakening       = std::max({kept.weakening, by_rate, by_slip});
}

template <int dim>
void VariableFriction<dim>::update(const SurfaceView<dim> &surface,
                                   const FlatMotion &flat,
                                   const ContactArrays &contact)
{
  using Arrays                      = ContactArrays;
  const std::size_t n               = factor.size();
  double *const result              = contact.column[Arrays::friction_coefficient];
  const double *const before_normal = contact.column[Arrays::normal_force];
  for (std::size_t i = 0; i < n; ++i)
    {
      const Node node = predict(surface, flat, contact, i);
      normal[i]       = node.normal;
      double pressing = node.normal; // normal force that enters friction
      if (!kept.remembered.empty())
        {
          const Relaxation r = law.normal_stress.step(step.dt, before[i].slip_rate);
          pressing = node.normal + r.decay * (kept.remembered[i] - before_normal[i]) -
                     r.lag * (node.normal - before_normal[i]);
          kept.remembered[i] = node.normal > 0. ? std::max(0., pressing) : 0.;
          pressing           = kept.remembered[i];
        }
      free_rate[i] = node.free_rate;
      softness[i]  = node.normal > 0. ? node.softness * pressing * factor[i] : -1.;
      if (!pressure.empty())
        pressure[i] = area[i] != 0. ? node.normal / std::fabs(area[i]) : 0.;
      if (law.coefficient_law && softness[i] > 0.)
        note_weakening(softness[i], 1. - contact.column[Arrays::lag][i]);
    }
  if (law.coefficient_law)
    {
      const auto or_null = [](const std::vector<double> &values) {
        return values.empty() ? nullptr : values.data();
      };
      SlipNodes nodes;
      nodes.n           = n;
      nodes.before      = before.data();
      nodes.free_rate   = free_rate.data();
      nodes.softness    = softness.data();
      nodes.pressure    = or_null(pressure);
      nodes.position    = {{or_null(position[0]), or_null(position[1])}};
      nodes.time        = surface.time;
      nodes.state       = kept.states.empty() ? nullptr : kept.states.data();
      nodes.coefficient = coefficient.data();
      law.coefficient_law->update(nodes);
    }
  for (std::size_t i = 0; i < n; ++i)
    if (normal[i] > 0.)
      result[i] = (law.coefficient_law ? coefficient[i] : 1.) * factor[i] *
                  (kept.remembered.empty() ? 1. : kept.remembered[i] / normal[i]);
}

template class VariableFriction<2>;
template class VariableFriction<3>;
} // namespace mesoslip
