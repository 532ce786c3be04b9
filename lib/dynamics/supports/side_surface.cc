#include "dynamics/supports/side_surface.h"

namespace mesoslip
{
namespace
{
/** Larger than the number of steps in a sweep over a grid. */
constexpr std::uint64_t steps_under_way = 128;
} // namespace

template <int dim>
SideSurface<dim>::SideSurface(const SideSupport &support,
                              const StepParameters &step,
                              const SideNodes &nodes,
                              const std::vector<bool> &counted)
  : support(support)
  , step(step)
  , nodes(support.suspension, step, nodes, counted)
  , steps(nodes.area.size())
  , loads(steps_under_way)
{
  for (std::vector<double> &component : increment)
    component.assign(nodes.area.size(), 0.);
}

template <int dim>
const SuspensionLoad<dim> &SideSurface<dim>::load_at(const SurfaceView<dim> &surface)
{
  std::optional<LoadOfStep> &place = loads[surface.step % steps_under_way];
  if (!place || place->step != surface.step)
    place = LoadOfStep{surface.step,
                       nodes.load_at(surface.time, support.pressure(surface.time))};
  return place->load;
}

template <int dim>
void SideSurface<dim>::start(const unsigned int k,
                             const SurfaceView<dim> &surface,
                             const unsigned int i)
{
  for (unsigned int c = 0; c < dim; ++c)
    increment[c][k] = step.dt * surface.w[c][i];
  nodes.start(k, surface, i);
}

template <int dim>
void SideSurface<dim>::advance(const unsigned int k,
                               const SurfaceView<dim> &surface,
                               const unsigned int i)
{
  nodes.advance(k, surface, i, load_at(surface), increment);
}

template <int dim>
void SideSurface<dim>::start_guest(const unsigned int k,
                                   const SurfaceView<dim> &surface,
                                   const unsigned int i)
{
  for (unsigned int c = 0; c < dim; ++c)
    increment[c][k] = step.dt * surface.w[c][i];
  nodes.start_guest(k, surface, i);
}

template <int dim>
void SideSurface<dim>::add_force(const unsigned int k,
                                 const SurfaceView<dim> &surface,
                                 const unsigned int i,
                                 const std::array<double *, dim> &force)
{
  if (is_at_start())
    start_guest(k, surface, i);
  const auto more = nodes.force(k, surface, i, load_at(surface));
  for (unsigned int c = 0; c < dim; ++c)
    {
      force[c][i] -= more[c];
      steps[k].u_before[c] = surface.u[c][i];
      steps[k].w_before[c] = surface.w[c][i];
    }
}

template <int dim>
void SideSurface<dim>::account(const unsigned int k,
                               const SurfaceView<dim> &surface,
                               const unsigned int i)
{
  for (unsigned int c = 0; c < dim; ++c)
    {
      steps[k].u_after[c] = surface.u[c][i];
      steps[k].w_after[c] = surface.w[c][i];
    }
  nodes.account(k, steps[k], load_at(surface), increment);
}

template <int dim>
void SideSurface<dim>::advance(const SurfaceView<dim> &surface)
{
  if (is_at_start())
    for (unsigned int i = 0; i < surface.n; ++i)
      start(i, surface, i);
  has_started();
  for (unsigned int i = 0; i < surface.n; ++i)
    advance(i, surface, i);
}

template class SideSurface<2>;
template class SideSurface<3>;
} // namespace mesoslip
