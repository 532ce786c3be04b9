#include "sliding/sliding_body.h"

#include "base/exchange.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <numeric>

namespace mesoslip
{
namespace
{
SlidingSetup
completed(SlidingSetup setup, const UniformMaterial &material, const bool has_contact)
{
  setup.contact.periodic = setup.top.periodic = setup.periodic;
  setup.top.cell_width                        = material.grid().spacing[0];
  // With periodic sides the last node is the first one again.
  setup.contact_places.resize(has_contact ? material.n_columns() - setup.periodic : 0);
  std::iota(setup.contact_places.begin(), setup.contact_places.end(), 0U);
  AssertDimension(setup.contact.friction_coefficient.size(), material.n_columns());
  if (setup.contact.wants_area())
    for (unsigned int i = 0; i < material.n_columns(); ++i)
      {
        setup.contact.area.push_back(tributary_width(material.grid(), i, setup.periodic));
        setup.contact.position[0].push_back(i * material.grid().spacing[0]);
      }
  return setup;
}
} // namespace

template <int dim>
SlidingBody<dim>::SlidingBody(const SlidingSetup &setup,
                              const unsigned int n_top_nodes,
                              Timer *timer)
  : setup(setup)
  , contact(setup.contact, setup.step)
  , top(setup.top, setup.step, n_top_nodes, setup.ranks)
  , contact_recorder(setup.history_interval, setup.monitored_nodes, setup.step)
  , node_loads(contact)
  , node_statistics(setup.steps_per_block, setup.node_loads ? &node_loads : nullptr)
  , contact_map(setup.contact_map, contact, node_loads)
  , top_recorder(setup.history_interval)
  , profile(timer)
{
  if (setup.node_loads)
    contact.observe(node_loads);
  contact.observe(node_statistics);
  contact.observe(contact_recorder);
  if (setup.contact_map.interval > 0)
    contact.observe(contact_map);
  top.observe(top_recorder);
}

template <int dim>
BoundaryWork SlidingBody<dim>::boundary_work() const
{
  BoundaryWork work = contact.work();
  work.external     = top.work() + work.external;
  work.supports     = top.suspended();
  return work;
}

template <int dim>
std::vector<NodeCounts> SlidingBody<dim>::contact_states(const std::size_t n_nodes)
{
  node_statistics.finish(contact);
  return setup.ranks == MPI_COMM_SELF
           ? node_statistics.blocks()
           : gather_nodes(node_statistics.blocks(), setup.contact_places, n_nodes,
                          setup.node_loads, setup.ranks);
}

template <int dim>
void SlidingBody<dim>::watch_energy()
{
  if (setup.energy_interval > 0)
    energy = std::make_unique<EnergyAudit>(time_integration(), setup.top.platen_mass,
                                           setup.energy_interval,
                                           [this]() { return boundary_work(); });
}

SlidingGrid::SlidingGrid(const UniformMaterial &material,
                         const SlidingSetup &given,
                         const MPI_Comm communicator,
                         SurfaceCondition<2> *bottom,
                         Timer *timer)
  : SlidingBody<2>(completed(given, material, mpi::this_mpi_process(communicator) == 0),
                   material.n_columns(),
                   timer)
  , material(material)
  , communicator(communicator)
  , rows(
      partition_rows(material.n_columns(), material.n_rows(), communicator, given.sweep))
  , u(material.n_columns(), rows.n_local())
  , w(material.n_columns(), rows.n_local())
  , halo(material.n_columns(), rows.ghosts, communicator)
  , stepper({material, given.step, u, w,
             bottom != nullptr
               ? bottom
               : profile.timed<TimedSurface<2>>(contact, "Contact and its histories"),
             profile.timed<TimedSurface<2>>(top, "Top and its histories"), rows,
             rows.end - rows.begin < rows.n_global
               ? profile.timed<TimedHalo>(halo, "Exchange between ranks")
               : nullptr,
             communicator},
            given.sides,
            given.sweep)
{
  watch_energy();
}

void SlidingGrid::set_initial_velocity(const std::array<double, 3> &v)
{
  const unsigned int n = w.n_columns(), last = rows.n_global - 1;
  const double back                = -setup.step.beta2 * setup.step.dt;
  std::array<double, 3> of_mass    = setup.step.acceleration;
  const std::array<bool, 2> &left  = setup.sides.left_held,
                            &right = setup.sides.right_held;
  for (unsigned int c = 0; c < 2; ++c)
    of_mass[c] -= setup.step.alpha * v[c];
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < rows.n_local(); ++j)
      std::fill_n(w.row(c, j), n, v[c] + back * of_mass[c]);
  for (unsigned int i = 0; rows.begin == 0 && i < n; ++i)
    if (contact.rests(i, of_mass[1]))
      w.row(1, rows.local(0))[i] = v[1];
  if (rows.end == rows.n_global)
    {
      std::vector<double> mass(n);
      stepper.mass_row(last, mass.data());
      std::vector<std::array<bool, 2>> held(n);
      held.front() = left;
      held.back()  = right;
      const auto a = top.start_acceleration(mass, held, v);
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int i = 0; i < n; ++i)
          w.row(c, rows.local(last))[i] =
            v[c] + back * (a[i][c] - setup.step.alpha * v[c]);
    }
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < rows.n_local(); ++j)
      {
        if (left[c])
          w.row(c, j)[0] = 0.;
        if (right[c])
          w.row(c, j)[n - 1] = 0.;
      }
  // What the top holds does not move from the start.
  for (unsigned int c = 0; c < 2 && rows.end == rows.n_global; ++c)
    if (c == 0 ? setup.top.holds(0) : setup.top.holds_normally())
      std::fill_n(w.row(c, rows.local(last)), n, 0.);
}

template class SlidingBody<2>;
template class SlidingBody<3>;
} // namespace mesoslip
