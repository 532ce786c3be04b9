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
  return setup;
}
} // namespace

template <int dim>
SlidingBody<dim>::SlidingBody(const UniformMaterial &material,
                              const SlidingSetup &given,
                              const MPI_Comm communicator,
                              SurfaceCondition<dim> *bottom,
                              Timer *timer)
  : material(material)
  , setup(completed(given, material))
  , communicator(communicator)
  , rows(
      partition_rows(material.n_columns(), material.n_rows(), communicator, setup.sweep))
  , u(material.n_columns(), rows.n_local())
  , w(material.n_columns(), rows.n_local())
  , contact(setup.contact, setup.step)
  , top(setup.top, setup.step, material.n_columns())
  , contact_recorder(setup.history_interval, setup.monitored_nodes, setup.step)
  , node_statistics(setup.steps_per_block)
  , top_recorder(setup.history_interval)
  , halo(material.n_columns(), rows.ghosts, communicator)
  , profile(timer)
  , stepper({material, setup.step, u, w,
             bottom != nullptr
               ? bottom
               : profile.timed<TimedSurface>(contact, "Contact and its histories"),
             profile.timed<TimedSurface>(top, "Top and its histories"), rows,
             rows.end - rows.begin < rows.n_global
               ? profile.timed<TimedHalo>(halo, "Exchange between ranks")
               : nullptr,
             communicator},
            setup.sides,
            setup.sweep)
{
  contact.observe(node_statistics);
  contact.observe(contact_recorder);
  top.observe(top_recorder);
  if (setup.energy_interval > 0)
    energy =
      std::make_unique<EnergyAudit>(stepper, setup.top.platen_mass, setup.energy_interval,
                                    [this]() { return boundary_work(); });
}

template <int dim>
BoundaryWork SlidingBody<dim>::boundary_work() const
{
  BoundaryWork work = contact.work();
  work.external     = top.work() + work.external;
  return work;
}

template class SlidingBody<2>;
} // namespace mesoslip
