#include "sliding/sliding_body.h"

#include "base/exchange.h"
#include "sliding/supports/grid_columns.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <numeric>

namespace mesoslip
{
namespace
{
SlidingSetup completed(SlidingSetup setup,
                       const UniformMaterial &material,
                       const MPI_Comm communicator)
{
  const bool has_contact = mpi::this_mpi_process(communicator) == 0;
  setup.contact.periodic = setup.top.periodic = setup.periodic;
  setup.top.cell_width                        = material.grid().spacing[0];
  // On a periodic grid the last node is a copy of the first.
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
  setup.platen_ranks = communicator;
  return setup;
}

const UniformMaterial *pointer_to(const std::optional<UniformMaterial> &damping)
{
  return damping ? &*damping : nullptr;
}

template <typename Column>
std::vector<Column *> pointers_to(std::deque<Column> &columns)
{
  std::vector<Column *> pointers;
  for (Column &column : columns)
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
    if (side.support.is_platen)
      add_platen(side);
    else
      sides.emplace_back(side.support, setup.step, side.nodes, side.counted);
  if (setup.contact_map.interval > 0)
    contact.observe(contact_map);
  top.observe(top_recorder);
}

template <int dim>
void SlidingBody<dim>::add_platen(const LoadedSide &side)
{
  const auto n_owned = side.counted.empty()
                         ? side.nodes.area.size()
                         : std::count(side.counted.begin(), side.counted.end(), true);
  platens.emplace_back(side.support, side.moves, setup.step, side.nodes,
                       static_cast<unsigned int>(n_owned), setup.platen_ranks);
}

template <int dim>
BoundaryWork SlidingBody<dim>::boundary_work() const
{
  BoundaryWork work = contact.work();
  work.external     = top.work() + work.external;
  work.supports     = top.suspended();
  for (const RigidPlaten<dim> &platen : platens)
    {
      work.external += platen.work();
      work.supports += platen.energies();
    }
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
    energy = std::make_unique<EnergyAudit>(time_integration(), setup.energy_interval,
                                           [this]() { return boundary_work(); });
}

NodesOfContact nodes_of_contact(const SlidingSetup &setup)
{
  NodesOfContact nodes = {setup.contact_places,
                          static_cast<unsigned int>(setup.contact_places.size())};
  if (setup.periodic && nodes.n_owned > 0)
    nodes.number.push_back(0);
  return nodes;
}

SlidingGrid::SlidingGrid(const UniformMaterial &material,
                         const SlidingSetup &given,
                         const MPI_Comm communicator,
                         SurfaceCondition<2> *bottom,
                         Timer *timer,
                         CounterMotion<2> *counter)
  : SlidingBody<2>(completed(given, material, communicator), material.n_columns(), timer)
  , material(material)
  , damping(given.step.damps_by_phase()
              ? std::optional(
                  material.with_phases(phases_of_damping(material.phases(), given.step)))
              : std::nullopt)
  , communicator(communicator)
  , rows(
      partition_rows(material.n_columns(), material.n_rows(), communicator, given.sweep))
  , u(material.n_columns(), rows.n_local())
  , w(material.n_columns(), rows.n_local())
  , halo(material.n_columns(), rows.ghosts, communicator)
  , platen_columns(
      make_platen_columns(platens, setup, material, pointer_to(damping), rows, u, w))
  , columns(make_columns(sides, setup, material, pointer_to(damping), rows, u, w))
  , stepper({material, given.step, u, w,
             bottom != nullptr
               ? bottom
               : &contact_condition(counter, nodes_of_contact(setup), MPI_COMM_SELF),
             profile.timed<TimedSurface<2>>(top, "Top and its histories"), rows,
             rows.end - rows.begin < rows.n_global
               ? profile.timed<TimedHalo>(halo, "Exchange between ranks")
               : nullptr,
             communicator, pointers_to(columns), pointers_to(platen_columns),
             pointer_to(damping)},
            given.sides,
            given.sweep)
{
  watch_energy();
}

void SlidingGrid::set_initial_velocity(const std::array<double, 3> &v)
{
  const unsigned int n = w.n_columns(), last = rows.n_global - 1;
  const double back                = -setup.step.beta2 * setup.step.dt;
  const std::array<bool, 2> &left  = setup.sides.left_held,
                            &right = setup.sides.right_held;
  const auto a                     = start_acceleration(v);
  for (unsigned int l = 0; l < rows.n_local(); ++l)
    for (unsigned int c = 0; c < 2; ++c)
      {
        double *of_row    = w.row(c, l);
        const bool bottom = rows.first() + l == 0, top_row = rows.first() + l == last;
        for (unsigned int i = 0; i < n; ++i)
          {
            const double by = a(c, {i, l});
            of_row[i] =
              c == 1 && bottom && contact.rests(i, by) ? v[c] : v[c] + back * by;
          }
        for (std::size_t k = 0; k < platens.size() && !bottom && !top_row; ++k)
          if (!setup.loaded[k].moves[c])
            of_row[platen_columns[k].column] = 0.;
        if (left[c])
          of_row[0] = 0.;
        if (right[c])
          of_row[n - 1] = 0.;
        // Nodes held by the top are at rest from the start.
        if (top_row && (c == 0 ? setup.top.holds(0) : setup.top.is_held()))
          std::fill_n(of_row, n, 0.);
      }
  if (rows.begin > 0)
    return;
  contact_start.velocity = v[1];
  contact_start.acceleration.assign(a.row(1, 0), a.row(1, 0) + n);
  contact_start.inverse_inertia.resize(n);
  stepper.mass_row(0, contact_start.inverse_inertia.data());
  for (double &of_node : contact_start.inverse_inertia)
    of_node = 1. / of_node;
  if (left[1])
    contact_start.inverse_inertia.front() = 0.;
  if (right[1])
    contact_start.inverse_inertia.back() = 0.;
  start_together();
}

void SlidingGrid::start_contact()
{
  const double back = -setup.step.beta2 * setup.step.dt;
  for (unsigned int i = 0; i < w.n_columns(); ++i)
    if (contact_start.inverse_inertia[i] > 0.)
      w.row(1, 0)[i] = contact_start.velocity + back * contact_start.acceleration[i];
}

/** Initial accelerations (m/s^2) of all nodes moving with @p v, by weight, loads and
 * damping proportional to mass. */
NodalField<double> SlidingGrid::start_acceleration(const std::array<double, 3> &v) const
{
  const unsigned int n     = w.n_columns();
  const double of_supports = setup.step.common_alpha();
  NodalField<double> a     = w.zeros_alike();
  std::vector<double> mass(n), drag(n);
  for (unsigned int l = 0; l < rows.n_local(); ++l)
    {
      const unsigned int j = rows.first() + l;
      stepper.mass_row(j, mass.data());
      std::vector<double> whole = mass;
      for (unsigned int c = 0; c < 2; ++c)
        std::fill_n(a.row(c, l), n, setup.step.acceleration[c]);
      for (unsigned int i = 0; i < n; ++i)
        drag[i] = stepper.alpha_of({i, l}, mass[i]) * mass[i];
      if (j + 1 == rows.n_global)
        load_top(v, whole, a);
      for (std::size_t k = 0; k < sides.size(); ++k)
        load_side(k, l, v, whole, a);
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int i = 0; i < n; ++i)
          a.row(c, l)[i] -=
            (drag[i] + of_supports * (whole[i] - mass[i])) / whole[i] * v[c];
      if (j + 1 < rows.n_global || top.moved_by() == nullptr)
        continue;
      std::vector<NodeIndex> nodes;
      for (unsigned int i = 0; i < n; ++i)
        nodes.push_back({i, l});
      start_as_one(*top.moved_by(), nodes, whole, v, a);
    }
  for (std::size_t k = 0; k < platens.size(); ++k)
    {
      std::vector<NodeIndex> nodes;
      std::vector<double> of_nodes;
      for (const unsigned int l : inner_rows(rows))
        {
          stepper.mass_row(rows.first() + l, mass.data());
          nodes.push_back({platen_columns[k].column, l});
          of_nodes.push_back(mass[nodes.back().i]);
        }
      start_as_one(platens[k], nodes, of_nodes, v, a);
    }
  return a;
}

/** Gives @p nodes (in local rows) with these masses the common acceleration of the
 * @p platen that moves them. Collective. */
void SlidingGrid::start_as_one(const RigidPlaten<2> &platen,
                               const std::vector<NodeIndex> &nodes,
                               const std::vector<double> &mass,
                               const std::array<double, 3> &v,
                               NodalField<double> &a) const
{
  std::vector<RigidPlaten<2>::NodeAtStart> at_start;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    at_start.push_back({mass[k], {{a(0, nodes[k]), a(1, nodes[k])}}});
  const auto found = platen.start_acceleration(at_start, v);
  for (const NodeIndex &node : nodes)
    for (unsigned int c = 0; c < 2; ++c)
      a.row(c, node.j)[node.i] = found[c];
}

/** Replaces the accelerations of the top row by accelerations under its load, and adds
 * suspended masses to @p whole. */
void SlidingGrid::load_top(const std::array<double, 3> &v,
                           std::vector<double> &whole,
                           NodalField<double> &a) const
{
  const unsigned int n = w.n_columns();
  std::vector<std::array<bool, 2>> held(n);
  held.front()     = setup.sides.left_held;
  held.back()      = setup.sides.right_held;
  const auto found = top.start_acceleration(whole, held, v);
  for (unsigned int i = 0; i < n; ++i)
    {
      whole[i] += top.suspended_mass(i);
      for (unsigned int c = 0; c < 2; ++c)
        a.row(c, rows.local(rows.n_global - 1))[i] = found[i][c];
    }
}

/** Like load_top(), for the node of side @p k in row @p l. */
void SlidingGrid::load_side(const std::size_t k,
                            const unsigned int l,
                            const std::array<double, 3> &v,
                            std::vector<double> &whole,
                            NodalField<double> &a) const
{
  const unsigned int i = columns[k].column;
  const auto &held     = i == 0 ? setup.sides.left_held : setup.sides.right_held;
  std::array<double, 2> of_node, starts_with;
  for (unsigned int c = 0; c < 2; ++c)
    {
      starts_with[c] = held[c] ? 0. : v[c];
      of_node[c]     = a(c, {i, l});
    }
  sides[k].accelerate(l, whole[i], starts_with, of_node);
  whole[i] += sides[k].mass(l);
  for (unsigned int c = 0; c < 2; ++c)
    a.row(c, l)[i] = of_node[c];
}

template class SlidingBody<2>;
template class SlidingBody<3>;
} // namespace mesoslip
