#include "sliding/sliding_body.h"

#include "base/exchange.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <numeric>

namespace mesoslip
{
namespace
{
/** Of a whole column what concerns the rows of this rank, ghost rows as well. */
void restrict_side(LoadedSide &side, const NodeRows &rows)
{
  std::vector<unsigned int> here(rows.n_local());
  std::iota(here.begin(), here.end(), rows.first());
  side.nodes = side.nodes.at(here);
  for (unsigned int l = 0; l < rows.n_local(); ++l)
    side.counted.push_back(rows.first() + l >= rows.begin && rows.first() + l < rows.end);
}

SlidingSetup completed(SlidingSetup setup,
                       const UniformMaterial &material,
                       const MPI_Comm communicator)
{
  const bool has_contact = mpi::this_mpi_process(communicator) == 0;
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
  const NodeRows rows =
    partition_rows(material.n_columns(), material.n_rows(), communicator, setup.sweep);
  for (LoadedSide &side : setup.loaded)
    restrict_side(side, rows);
  return setup;
}

/** The columns of the loaded sides. */
std::deque<SideColumn> make_columns(std::deque<SideSurface<2>> &sides,
                                    const SlidingSetup &setup,
                                    const UniformMaterial &material,
                                    const NodeRows &rows,
                                    NodalField<double> &u,
                                    NodalField<double> &w)
{
  std::deque<SideColumn> columns;
  for (std::size_t k = 0; k < sides.size(); ++k)
    {
      const bool left = setup.loaded[k].support.name == "Left";
      columns.emplace_back(sides[k], left ? 0 : material.n_columns() - 1, material, rows,
                           setup.step,
                           left ? setup.sides.left_held : setup.sides.right_held, u, w);
    }
  return columns;
}

std::vector<SideColumn *> pointers_to(std::deque<SideColumn> &columns)
{
  std::vector<SideColumn *> pointers;
  for (SideColumn &column : columns)
    pointers.push_back(&column);
  return pointers;
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
  for (const LoadedSide &side : setup.loaded)
    sides.emplace_back(side.support, setup.step, side.nodes, side.counted);
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
  for (const SideSurface<dim> &side : sides)
    {
      work.external += side.work();
      work.supports += side.suspended();
    }
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
  : SlidingBody<2>(completed(given, material, communicator), material.n_columns(), timer)
  , material(material)
  , communicator(communicator)
  , rows(
      partition_rows(material.n_columns(), material.n_rows(), communicator, given.sweep))
  , u(material.n_columns(), rows.n_local())
  , w(material.n_columns(), rows.n_local())
  , halo(material.n_columns(), rows.ghosts, communicator)
  , columns(make_columns(sides, setup, material, rows, u, w))
  , stepper({material, given.step, u, w,
             bottom != nullptr
               ? bottom
               : profile.timed<TimedSurface<2>>(contact, "Contact and its histories"),
             profile.timed<TimedSurface<2>>(top, "Top and its histories"), rows,
             rows.end - rows.begin < rows.n_global
               ? profile.timed<TimedHalo>(halo, "Exchange between ranks")
               : nullptr,
             communicator, pointers_to(columns)},
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
  start_sides(v);
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
    if (c == 0 ? setup.top.holds(0) : setup.top.is_held())
      std::fill_n(w.row(c, rows.local(last)), n, 0.);
}

/** The velocities of the scheme of nodes of loaded sides, which have those of free ones, and of contact and top. */
void SlidingGrid::start_sides(const std::array<double, 3> &v)
{
  const double back = -setup.step.beta2 * setup.step.dt, alpha = setup.step.alpha;
  const bool platen = setup.top.is_platen; // moves as one
  std::vector<double> mass(w.n_columns());
  for (std::size_t k = 0; k < sides.size(); ++k)
    {
      const unsigned int i = columns[k].column;
      const auto &held     = i == 0 ? setup.sides.left_held : setup.sides.right_held;
      for (unsigned int l = 0; l < rows.n_local(); ++l)
        {
          const unsigned int j = rows.first() + l;
          if (platen && j + 1 == rows.n_global)
            continue;
          stepper.mass_row(j, mass.data());
          std::array<double, 2> a, starts_with;
          for (unsigned int c = 0; c < 2; ++c)
            {
              starts_with[c] = held[c] ? 0. : v[c];
              a[c]           = (w.row(c, l)[i] - v[c]) / back + alpha * v[c];
            }
          const bool rests  = j == 0 && w.row(1, l)[i] == v[1];
          const double more = j + 1 == rows.n_global ? top.suspended_mass(i) : 0.;
          sides[k].accelerate(l, mass[i] + more, starts_with, a);
          for (unsigned int c = 0; c < 2; ++c)
            if (c == 0 || !rests)
              w.row(c, l)[i] = v[c] + back * (a[c] - alpha * v[c]);
        }
    }
}

template class SlidingBody<2>;
template class SlidingBody<3>;
} // namespace mesoslip
