#include "sliding/sliding_body.h"

#include <deal.II/base/exceptions.h>

namespace mesoslip
{
namespace
{
SlidingSetup completed(SlidingSetup setup, const UniformMaterial &material)
{
  setup.contact.periodic = setup.top.periodic = setup.periodic;
  setup.top.cell_width                        = material.grid().spacing[0];
  AssertDimension(setup.contact.friction_coefficient.size(), material.n_columns());
  if (setup.contact.law.slip_law && setup.contact.law.slip_law->looks_around())
    for (unsigned int i = 0; i < material.n_columns(); ++i)
      {
        setup.contact.area.push_back(tributary_width(material.grid(), i, setup.periodic));
        setup.contact.position[0].push_back(i * material.grid().spacing[0]);
      }
  return setup;
}
} // namespace

template <int dim>
SlidingSurfaces<dim>::SlidingSurfaces(const SlidingSetup &setup,
                                      const unsigned int n_top_nodes)
  : setup(setup)
  , contact(setup.contact, setup.step)
  , top(setup.top, setup.step, n_top_nodes, setup.ranks)
  , contact_recorder(setup.history_interval, setup.monitored_nodes, setup.step)
  , node_loads(contact)
  , node_statistics(setup.steps_per_block, setup.node_loads ? &node_loads : nullptr)
  , contact_map(setup.contact_map, contact, node_loads)
  , top_recorder(setup.history_interval)
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
BoundaryWork SlidingSurfaces<dim>::boundary_work() const
{
  BoundaryWork work = contact.work();
  work.external     = top.work() + work.external;
  return work;
}

template <int dim>
std::vector<NodeCounts> SlidingSurfaces<dim>::contact_states(const std::size_t n_nodes)
{
  node_statistics.finish(contact);
  return setup.ranks == MPI_COMM_SELF
           ? node_statistics.blocks()
           : gather_nodes(node_statistics.blocks(), setup.contact_places, n_nodes,
                          setup.node_loads, setup.ranks);
}

template <int dim>
SlidingBody<dim>::SlidingBody(const UniformMaterial &material,
                              const SlidingSetup &given,
                              const MPI_Comm communicator,
                              SurfaceCondition<dim> *bottom,
                              Timer *timer)
  : SlidingSurfaces<dim>(completed(given, material), material.n_columns())
  , material(material)
  , communicator(communicator)
  , rows(
      partition_rows(material.n_columns(), material.n_rows(), communicator, given.sweep))
  , u(material.n_columns(), rows.n_local())
  , w(material.n_columns(), rows.n_local())
  , halo(material.n_columns(), rows.ghosts, communicator)
  , profile(timer)
  , stepper({material, given.step, u, w,
             bottom != nullptr
               ? bottom
               : profile.timed<TimedSurface>(this->contact, "Contact and its histories"),
             profile.timed<TimedSurface>(this->top, "Top and its histories"), rows,
             rows.end - rows.begin < rows.n_global
               ? profile.timed<TimedHalo>(halo, "Exchange between ranks")
               : nullptr,
             communicator},
            given.sides,
            given.sweep)
{
  if (given.energy_interval > 0)
    energy =
      std::make_unique<EnergyAudit>(stepper, given.top.platen_mass, given.energy_interval,
                                    [this]() { return this->boundary_work(); });
}

template class SlidingSurfaces<2>;
template class SlidingSurfaces<3>;
template class SlidingBody<2>;
} // namespace mesoslip
