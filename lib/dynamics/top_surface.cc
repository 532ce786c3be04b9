#include "dynamics/top_surface.h"

#include "base/exchange.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace mesoslip
{
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
  , tributary(setup.tributary)
{
  for (std::vector<double> &component : increment)
    component.assign(n_nodes, 0.);
  if (tributary.empty() && n_nodes > 0)
    {
      area = setup.cell_width * (n_nodes - 1);
      tributary.assign(n_nodes, setup.cell_width);
      if (!setup.periodic)
        tributary.front() = tributary.back() = 0.5 * setup.cell_width;
    }
  else
    area = std::accumulate(tributary.begin(), tributary.begin() + n_distinct, 0.);
  top_area = mpi::sum(area, ranks);
  n_in_top = mpi::sum(static_cast<double>(n_distinct), ranks);
  if (top_area > 0.)
    platen_mass = setup.platen_mass * (area / top_area);
}

template <int dim>
void TopSurface<dim>::advance(const SurfaceView<dim> &surface)
{
  AssertDimension(surface.n, tributary.size());
  if (!started)
    initialize(surface);

  std::vector<TopRecorder *> &all = recorders;
  const bool sampled              = std::any_of(
                 all.begin(), all.end(), [&](const TopRecorder *r) { return r->wants(surface.step); });
  const double displacement =
    sampled ? sum_of(surface.u[dim - 1], n_distinct) / n_in_top : 0.;

  work_this_step  = 0.;
  const bool held = setup.kind == TopSetup::Kind::held || surface.time >= setup.hold_from;
  const TopLoad load = held                                   ? hold(surface)
                       : setup.kind == TopSetup::Kind::platen ? push_platen(surface)
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
  moving_mass = platen_mass;
  for (unsigned int i = 0; i < n_distinct; ++i)
    if (surface.inverse_mass[dim - 1][i] > 0.)
      moving_mass += 1. / surface.inverse_mass[dim - 1][i];
  moving_mass = mpi::sum(moving_mass, ranks);
  started     = true;
}

template <int dim>
std::vector<double>
TopSurface<dim>::start_acceleration(const std::vector<double> &mass) const
{
  AssertDimension(mass.size(), tributary.size());
  const double pressure = setup.pressure(0.), g = step.acceleration[dim - 1];
  const double moved =
    mpi::sum(std::accumulate(mass.begin(), mass.begin() + n_distinct, 0.), ranks);
  const double of_platen =
    (g * moved - pressure * top_area) / (moved + setup.platen_mass);
  std::vector<double> result(mass.size(), g);
  for (std::size_t i = 0; i < mass.size(); ++i)
    if (setup.kind == TopSetup::Kind::platen)
      result[i] = of_platen;
    else if (mass[i] > 0.)
      result[i] -= pressure * tributary[i] / mass[i];
  return result;
}

template <int dim>
void TopSurface<dim>::move_node(double &u, double &w, const double acceleration) const
{
  w += step.dt * acceleration;
  u += step.dt * w + (step.beta2 - 0.5) * step.dt * step.dt * acceleration;
}

/** Tangential force along TopSetup::direction. */
template <int dim>
double TopSurface<dim>::transmitted(const SurfaceView<dim> &surface) const
{
  const auto [c, s]    = setup.direction;
  const double along_x = sum_of(surface.force[0], n_distinct);
  return s == 0. ? -along_x : -(c * along_x + s * sum_of(surface.force[1], n_distinct));
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
      for (unsigned int c = 0; c < y && !setup.lateral_held; ++c)
        {
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
  if (setup.lateral_held)
    load.tangential = transmitted(surface);
  return load;
}

template <int dim>
TopLoad TopSurface<dim>::push_platen(const SurfaceView<dim> &surface)
{
  constexpr unsigned int y = dim - 1;

  TopLoad load;
  const double pressure = setup.pressure(surface.time);
  load.normal           = pressure * area;
  load.tangential       = transmitted(surface);
  if (surface.n == 0)
    return load;
  const double force        = surface.total_force != nullptr
                                ? surface.total_force[y]
                                : sum_of(surface.force[y], n_distinct);
  const double acceleration = -(pressure * top_area + force) / moving_mass;

  double u = surface.u[y][0], w = surface.w[y][0];
  move_node(u, w, acceleration);
  const double moved = u - surface.u[y][0];
  work_this_step     = -load.normal * 0.5 * (moved + increment[y][0]);
  std::fill(increment[y].begin(), increment[y].end(), moved);
  platen_w = w;
  std::fill_n(surface.u[y], surface.n, u);
  std::fill_n(surface.w[y], surface.n, w);
  return load;
}

// Work of the force that stops the surface at once. It acts during one step, along half
// the increment of the step before, and its acceleration -w / dt enters the energy for
// b > 1/2:
//     (m (-w / dt) + f) . increment / 2 + (b - 1/2) m w^2 / 2
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
  if (surface.n > 0)
    work_this_step += work(platen_mass, platen_w, increment[dim - 1][0], 0., 1.);
}

template <int dim>
TopLoad TopSurface<dim>::hold(const SurfaceView<dim> &surface)
{
  if (!holding)
    stop(surface);
  holding  = true;
  platen_w = 0.;
  for (unsigned int c = 0; c < dim; ++c)
    std::fill_n(surface.w[c], surface.n, 0.);

  TopLoad load;
  load.normal     = -sum_of(surface.force[dim - 1], n_distinct);
  load.tangential = transmitted(surface);
  return load;
}

template class TopSurface<2>;
template class TopSurface<3>;
} // namespace mesoslip
