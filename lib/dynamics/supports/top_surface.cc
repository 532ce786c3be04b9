#include "dynamics/supports/top_surface.h"

#include "base/exchange.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace mesoslip
{
namespace
{
/** Tributary area of each of @p n nodes of the top (m^2, in 2D m). */
std::vector<double> areas_of(const TopSetup &setup, const unsigned int n)
{
  std::vector<double> areas = setup.nodes.area;
  if (!areas.empty() || n == 0)
    return areas;
  areas.assign(n, setup.cell_width);
  if (!setup.periodic)
    areas.front() = areas.back() = 0.5 * setup.cell_width;
  return areas;
}

/** Marks the first @p n_counted of @p n nodes. */
std::vector<bool> first_of(const unsigned int n, const unsigned int n_counted)
{
  std::vector<bool> counted(n, false);
  std::fill_n(counted.begin(), n_counted, true);
  return counted;
}

/** Data of the top nodes with these areas. */
template <int dim>
SideNodes nodes_of(const TopSetup &setup, const std::vector<double> &area)
{
  SideNodes nodes = setup.nodes;
  nodes.area      = area;
  for (const double a : area)
    nodes.push[dim - 1].push_back(-a);
  return nodes;
}
} // namespace

void sum_over_ranks(TopHistory &samples, const MPI_Comm communicator)
{
  auto &[normal, tangential, displacement] = samples;
  for (auto *values : {&normal, &tangential, &displacement})
    sum_over_ranks(*values, communicator);
}

void TopRecorder::record(const double displacement, const TopLoad &load)
{
  samples.displacement.push_back(displacement);
  samples.normal_force.push_back(load.normal);
  samples.tangential_force.push_back(load.tangential);
}

template <int dim>
TopSurface<dim>::TopSurface(const TopSetup &setup,
                            const StepParameters &step,
                            const unsigned int n_nodes,
                            const MPI_Comm ranks)
  : setup(setup)
  , step(step)
  , n_distinct(setup.n_owned.value_or(setup.periodic ? n_nodes - 1 : n_nodes))
  , ranks(ranks)
  , tributary(areas_of(setup, n_nodes))
  , on_nodes(setup.is_suspended_by_nodes())
  , nodes(setup.suspension,
          step,
          on_nodes ? nodes_of<dim>(setup, tributary) : SideNodes(),
          first_of(n_nodes, n_distinct))
{
  for (std::vector<double> &component : increment)
    component.assign(n_nodes, 0.);
  no_mobility.assign(n_nodes, 0.);
  n_in_top = mpi::sum(static_cast<double>(n_distinct), ranks);
  if (setup.is_platen)
    platen.emplace(setup, setup.moves(dim), step, nodes_of<dim>(setup, tributary),
                   n_distinct, ranks);
}

template <int dim>
void TopSurface<dim>::advance(const SurfaceView<dim> &surface)
{
  AssertDimension(surface.n, tributary.size());
  if (!started)
    initialize(surface);

  const bool sampled =
    std::any_of(recorders.begin(), recorders.end(),
                [&](const TopRecorder *r) { return r->wants(surface.step); });
  const double displacement =
    sampled ? sum_of(surface.u[dim - 1], n_distinct) / n_in_top : 0.;

  work_this_step     = 0.;
  const bool held    = setup.is_held() || surface.time >= setup.hold_from;
  const TopLoad load = held              ? hold(surface)
                       : setup.is_platen ? push_platen(surface)
                       : on_nodes        ? push_suspended(surface)
                                         : push_nodes(surface);
  total_work += work_this_step;
  for (TopRecorder *recorder : recorders)
    if (recorder->wants(surface.step))
      recorder->record(displacement, load);
}

template <int dim>
void TopSurface<dim>::initialize(const SurfaceView<dim> &surface)
{
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int i = 0; i < surface.n; ++i)
      increment[c][i] = step.dt * surface.w[c][i];
  for (unsigned int i = 0; i < surface.n && on_nodes; ++i)
    nodes.start(i, held_along_flat(surface), i);
  started = true;
}

template <int dim>
std::vector<std::array<double, dim>>
TopSurface<dim>::start_acceleration(const std::vector<double> &mass,
                                    const std::vector<std::array<bool, dim>> &held,
                                    const std::array<double, 3> &velocity) const
{
  AssertDimension(mass.size(), tributary.size());
  AssertDimension(held.size(), tributary.size());
  constexpr unsigned int y = dim - 1;
  const double pressure = setup.pressure(0.), g = step.acceleration[y];
  std::array<double, dim> by_weight;
  std::copy_n(step.acceleration.begin(), dim, by_weight.begin());
  std::vector<std::array<double, dim>> result(mass.size(), by_weight);
  for (std::size_t i = 0; i < mass.size(); ++i)
    if (on_nodes && mass[i] > 0.)
      {
        std::array<double, dim> starts_with;
        for (unsigned int c = 0; c < dim; ++c)
          starts_with[c] = held[i][c] ? 0. : velocity[c];
        nodes.accelerate(i, mass[i], pressure, starts_with, result[i]);
      }
    else if (!platen && mass[i] > 0. && !held[i][y])
      result[i][y] = g - pressure * tributary[i] / mass[i];
  return result;
}

template <int dim>
void TopSurface<dim>::move_node(double &u, double &w, const double acceleration) const
{
  w += step.dt * acceleration;
  u += step.dt * w + (step.beta2 - 0.5) * step.dt * step.dt * acceleration;
}

/** Component of @p force along TopSetup::direction. */
template <int dim>
double TopSurface<dim>::along_flat(const std::array<double, dim> &force) const
{
  const auto [c, s] = setup.direction;
  return s == 0. ? force[0] : c * force[0] + s * force[1];
}

/** Tangential force along TopSetup::direction from the @p held components. */
template <int dim>
double TopSurface<dim>::transmitted(const SurfaceView<dim> &surface,
                                    const std::array<bool, 2> &held) const
{
  std::array<double, dim> force = {};
  for (unsigned int c = 0; c + 1 < dim; ++c)
    if (held[c])
      force[c] = -sum_of(surface.force[c], n_distinct);
  return along_flat(force);
}

template <int dim>
TopLoad TopSurface<dim>::push_nodes(const SurfaceView<dim> &surface)
{
  constexpr unsigned int y = dim - 1;
  TopLoad load;
  const double pressure = setup.pressure(surface.time);
  for (unsigned int i = 0; i < surface.n; ++i)
    {
      const double force  = pressure * tributary[i];
      const double before = surface.u[y][i];
      move_node(surface.u[y][i], surface.w[y][i],
                -surface.inverse_mass[y][i] * (force + surface.force[y][i]));
      const double moved = surface.u[y][i] - before;
      for (unsigned int c = 0; c < y; ++c)
        {
          if (setup.held[c])
            continue;
          const double left = surface.u[c][i];
          move_node(surface.u[c][i], surface.w[c][i],
                    -surface.inverse_mass[c][i] * surface.force[c][i]);
          increment[c][i] = surface.u[c][i] - left;
        }
      if (i < n_distinct)
        {
          work_this_step -= force * 0.5 * (moved + increment[y][i]);
          load.normal += force;
        }
      increment[y][i] = moved;
    }
  load.tangential = transmitted(surface, {{setup.held[0], setup.held[1]}});
  return load;
}

/** A view in which constrained tangential components do not move. */
template <int dim>
SurfaceView<dim> TopSurface<dim>::held_along_flat(SurfaceView<dim> surface) const
{
  for (unsigned int c = 0; c + 1 < dim; ++c)
    if (setup.held[c])
      surface.inverse_mass[c] = no_mobility.data();
  return surface;
}

template <int dim>
TopLoad TopSurface<dim>::push_suspended(const SurfaceView<dim> &given)
{
  constexpr unsigned int y       = dim - 1;
  const SuspensionLoad<dim> load = nodes.load_at(given.time, setup.pressure(given.time));
  const SurfaceView<dim> surface = held_along_flat(given);
  std::array<double, dim> force  = {};
  for (unsigned int i = 0; i < surface.n; ++i)
    {
      const auto of_node = nodes.advance(i, surface, i, load, increment);
      for (unsigned int c = 0; c < dim && i < n_distinct; ++c)
        force[c] += of_node[c];
    }
  for (unsigned int c = 0; c < y; ++c)
    if (setup.held[c])
      force[c] = sum_of(surface.force[c], n_distinct);
  return {-force[y], -along_flat(force)};
}

template <int dim>
TopLoad TopSurface<dim>::push_platen(const SurfaceView<dim> &surface)
{
  platen->advance(surface);
  for (unsigned int c = 0; c < dim; ++c)
    std::fill(increment[c].begin(), increment[c].end(), platen->increment()[c]);
  std::array<double, dim> pull = {};
  for (unsigned int c = 0; c + 1 < dim; ++c)
    pull[c] = setup.holds(c) ? -sum_of(surface.force[c], n_distinct) : -platen->load()[c];
  return {-platen->load()[dim - 1], along_flat(pull)};
}

// Work of the force that stops the surface instantly. It acts during one step, over half
// the increment of the previous step; its acceleration -w / dt enters the energy for b >
// 1/2: (m (-w / dt) + f) . increment / 2 + (b - 1/2) m w^2 / 2
template <int dim>
void TopSurface<dim>::stop(const SurfaceView<dim> &surface)
{
  const auto work = [&](const double m, const double w, const double moved,
                        const double f, const double inertia) {
    return 0.5 *
           ((f - m * w / step.dt) * moved + (step.beta2 - 0.5) * m / inertia * w * w);
  };
  const auto mass = [](const double inverse) { return inverse > 0. ? 1. / inverse : 0.; };
  for (unsigned int i = 0; i < n_distinct; ++i)
    {
      double of_node = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        of_node += work(mass(surface.inverse_mass[c][i]), surface.w[c][i],
                        increment[c][i], surface.force[c][i], step.inertia());
      work_this_step += of_node;
    }
  if (platen)
    work_this_step += platen->stop();
}

template <int dim>
TopLoad TopSurface<dim>::hold(const SurfaceView<dim> &surface)
{
  if (!holding)
    stop(surface);
  holding = true;
  for (unsigned int c = 0; c < dim; ++c)
    std::fill_n(surface.w[c], surface.n, 0.);

  return {-sum_of(surface.force[dim - 1], n_distinct),
          transmitted(surface, {{true, true}})};
}

template class TopSurface<2>;
template class TopSurface<3>;
} // namespace mesoslip
