#include "contact/flat/power_springs.h"

#include "contact/laws/free_gap.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
double depth_of(const double height)
{
  return std::max(0., -height);
}
} // namespace

template <int dim>
PowerSprings<dim>::PowerSprings(const PowerSpring &spring,
                                const std::vector<double> &areas,
                                const unsigned int n_owned,
                                const StepParameters &step)
  : spring(spring)
  , areas(areas)
  , n_owned(n_owned)
  , step(step)
  , earlier(areas.size())
{
}

template <int dim>
void PowerSprings<dim>::press(const SurfaceView<dim> &surface,
                              const ContactArrays &contact)
{
  using Arrays   = ContactArrays;
  const auto &at = contact.column;
  const double c = (0.5 + step.beta2) * step.dt * step.dt;
  for (std::size_t i = 0; i < areas.size(); ++i)
    {
      const double minv = surface.inverse_mass[dim - 1][i], ahead = at[Arrays::gap][i],
                   gap = free_gap(surface, ahead, i, step),
                   now = ahead + surface.u[dim - 1][i] + at[Arrays::rise][i];
      earlier[i] =
        depth_of(now + at[Arrays::rise_before][i] - at[Arrays::increment_y][i]);
      at[Arrays::pressing][i] =
        gap < 0. ? force(std::fabs(areas[i]), gap, depth_of(now), earlier[i], c * minv)
                 : 0.;
    }
}

// h + gap + yields f(h) = 0 has one root from -h_(n-1) to -gap, as f rises with h. Below
// 0, where the node leaves its spring within the step, F is odd and W even: the energy
// that is no longer stored is dissipated.
template <int dim>
double PowerSprings<dim>::force(const double area,
                                const double gap,
                                const double now,
                                const double before,
                                const double yields) const
{
  const double k        = area * spring.tangent(std::max({now, before, -gap})),
               compared = yields * k, phi = 1. / (1. + 0.0625 * compared * compared),
               F_before = area * spring.pressure(before),
               W_before = area * spring.energy(before);
  const auto at         = [&](const double h) {
    const double F = std::copysign(area * spring.pressure(std::fabs(h)), h),
                 W = area * spring.energy(std::fabs(h)), way = h - before,
                 mean = std::fabs(way) > 1e-6 * (std::fabs(h) + before)
                                  ? (W - W_before) / way
                                  : 0.5 * (F + F_before);
    return std::max(0., mean + 0.5 * (1. - phi) * (F - F_before));
  };
  double low = -before, high = -gap, h = std::clamp(now, low, high);
  // Newton's method with the tangent of a node that follows its spring, inside the
  // bracket.
  for (unsigned int n = 0; n < 60; ++n)
    {
      const double off        = h + gap + yields * at(h);
      (off > 0. ? high : low) = h;
      const double slope =
                     1. + yields * area * spring.tangent(std::fabs(h)) * (1. - 0.5 * phi),
                   next = h - off / slope, from = h;
      h = next > low && next < high ? next : 0.5 * (low + high);
      if (std::fabs(h - from) <= 1e-15 * (before - gap))
        break;
    }
  return at(h);
}

template <int dim>
void PowerSprings<dim>::add_energies(const SurfaceView<dim> &surface,
                                     const ContactArrays &contact,
                                     ContactSums &sums) const
{
  using Arrays   = ContactArrays;
  const auto &at = contact.column;
  for (std::size_t i = 0; i < std::min<std::size_t>(n_owned, areas.size()); ++i)
    {
      const double after  = at[Arrays::gap][i] + surface.u[dim - 1][i],
                   before = after + at[Arrays::rise][i] - at[Arrays::increment_y][i],
                   area   = std::fabs(areas[i]),
                   stored = 0.5 * area * spring.energy(depth_of(after));
      sums.stored_energy += stored + 0.5 * area * spring.energy(depth_of(before));
      sums.impact_energy -= stored - 0.5 * area * spring.energy(earlier[i]);
    }
}

template <int dim>
double PowerSprings<dim>::stored_at_start(const SurfaceView<dim> &surface,
                                          const ContactArrays &contact) const
{
  using Arrays   = ContactArrays;
  const auto &at = contact.column;
  double stored  = 0.;
  for (std::size_t i = 0; i < std::min<std::size_t>(n_owned, areas.size()); ++i)
    {
      const double now    = at[Arrays::gap][i] + surface.u[dim - 1][i],
                   before = now + at[Arrays::rise][i] - at[Arrays::increment_y][i];
      stored += 0.5 * std::fabs(areas[i]) *
                (spring.energy(depth_of(now)) + spring.energy(depth_of(before)));
    }
  return stored;
}

template class PowerSprings<2>;
template class PowerSprings<3>;
} // namespace mesoslip
