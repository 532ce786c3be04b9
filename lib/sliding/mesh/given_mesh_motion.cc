#include "base/exchange.h"
#include "base/object_exchange.h"
#include "mesh/point_blocks.h"
#include "program/run_context.h"
#include "sliding/mesh/given_mesh.h"

namespace mesoslip
{
/** Adds the materials and the nodes of the supports of this body. */
template <int dim>
SlidingSetup GivenMesh<dim>::with_sides(SlidingSetup setup) const
{
  setup.step                            = mesh->of_materials(setup.step);
  setup.top.nodes                       = body.top_nodes;
  const std::vector<SideSupport> loaded = parameters.loaded_sides();
  for (const auto &[points, nodes, moves] : body.sides)
    setup.loaded.push_back({loaded[setup.loaded.size()], nodes, points, {}, moves});
  return setup;
}

template <int dim>
BodyInMotion<dim> GivenMesh<dim>::start(const SlidingSetup &given,
                                        RunContext &context,
                                        CounterMotion<dim> *counter) const
{
  const SlidingSetup setup = with_sides(given);
  auto sliding             = std::make_unique<SlidingMesh<dim>>(
    *distributed, body.contact, body.top, body.held, setup,
    context.options().profile ? &context.timer() : nullptr, counter);
  sliding->set_initial_velocity(parameters.body.initial_velocity, body.held, body.top);
  BodyInMotion<dim> motion;
  motion.probes       = probes_of(*sliding, true, setup.probe_interval);
  motion.displacement = displacement_rows(*sliding);
  motion.body         = std::move(sliding);
  return motion;
}

template <int dim>
CounterMotion<dim> GivenMesh<dim>::start_below(const SlidingSetup &given,
                                               RunContext & /*context*/) const
{
  CounterMotion<dim> below;
  below.communicator = distributed->communicator();
  below.partner      = std::make_unique<PartnerSurface<dim>>();
  auto sliding = std::make_unique<SlidingMesh<dim>>(*distributed, body.contact, body.top,
                                                    body.held, with_sides(given), nullptr,
                                                    nullptr, below.partner.get());
  below.partner->nodes = nodes_of_contact(sliding->contact_nodes);
  sliding->set_initial_velocity(parameters.body.initial_velocity, body.held, body.top);
  below.probes       = probes_of(*sliding, false, given.probe_interval);
  below.displacement = displacement_rows(*sliding);
  below.body         = std::move(sliding);
  return below;
}

/** Probes of the body, null without any; with @p in_contact they have tractions. */
template <int dim>
std::unique_ptr<ProbeRecorder>
GivenMesh<dim>::probes_of(const SlidingMesh<dim> &moving,
                          const bool in_contact,
                          const std::uint64_t interval) const
{
  if (body.probes.empty())
    return nullptr;
  using Contact = typename MeshProbes<dim>::Contact;
  std::optional<Contact> contact;
  if (in_contact)
    contact.emplace(Contact{moving.contact, moving.contact_nodes, body.contact.points,
                            body.contact.area});
  return std::make_unique<MeshProbes<dim>>(body.probes, distributed->part(), phases,
                                           moving.stepper, contact, interval);
}

template <int dim>
std::function<FieldRows()>
GivenMesh<dim>::displacement_rows(const SlidingMesh<dim> &moving) const
{
  // Made when fields are written. Planes of a box are not split.
  std::size_t n_together = 0;
  std::shared_ptr<const PointBlocks<dim>> blocks;
  return [this, &u = moving.u, n_together, blocks]() mutable {
    if (!blocks)
      {
        on_root(MPI_COMM_WORLD,
                [&]() { n_together = body.n_points / vectors_shape()[0]; });
        broadcast_object(MPI_COMM_WORLD, n_together);
        blocks = std::make_shared<const PointBlocks<dim>>(
          distributed->part(), body.n_points, distributed->communicator(), n_together);
      }
    std::array<const double *, dim> components;
    for (unsigned int c = 0; c < dim; ++c)
      components[c] = u.row(c, 0);
    return FieldRows{blocks->first() / n_together, blocks->gather(components)};
  };
}

#define MESOSLIP_INSTANTIATE(dim)                                                      \
  template SlidingSetup GivenMesh<dim>::with_sides(SlidingSetup) const;                \
  template BodyInMotion<dim> GivenMesh<dim>::start(const SlidingSetup &, RunContext &, \
                                                   CounterMotion<dim> *) const;        \
  template CounterMotion<dim> GivenMesh<dim>::start_below(const SlidingSetup &,        \
                                                          RunContext &) const;         \
  template std::unique_ptr<ProbeRecorder> GivenMesh<dim>::probes_of(                   \
    const SlidingMesh<dim> &, const bool, const std::uint64_t) const;                  \
  template std::function<FieldRows()> GivenMesh<dim>::displacement_rows(               \
    const SlidingMesh<dim> &) const;
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
