#ifndef mesoslip_tests_benchmarks_box_run_h
#define mesoslip_tests_benchmarks_box_run_h

#include "dynamics/critical_time_step.h"
#include "material/stiffness.h"
#include "sliding/contact_parameters.h"
#include "sliding/mesh/box_body.h"
#include "sliding/mesh/sliding_mesh.h"

#include <memory>
#include <random>
#include <vector>

namespace verification
{
using namespace mesoslip;

/** Pressed to the flat that moves along x, with friction and damping, and without observers. */
inline ContactParameters box_parameters(const std::array<unsigned int, 3> &cells,
                                        const std::array<double, 3> &size)
{
  ContactParameters p;
  p.mesh.mesh.dim         = 3;
  p.body.cells            = cells;
  p.body.size             = size;
  p.contact.flat_velocity = LoadHistory(1.);
  p.top.pressure          = LoadHistory(1e6);
  p.friction.coefficient  = 0.3;
  p.history_interval      = 0;
  p.energy_interval       = 0;
  return p;
}

/** @p n cubes along each edge, for so many steps that nothing happens. */
inline ContactParameters cubes(const std::array<unsigned int, 3> &n)
{
  const double edge   = 0.1 / n[0];
  ContactParameters p = box_parameters(n, {{edge * n[0], edge * n[1], edge * n[2]}});
  p.step.dt           = 1e-6 * edge;
  return p;
}

/** A box on the flat, made as contact_dynamics makes it. */
class BoxRun
{
public:
  /**
   * Cells are those of the first of @p phases, a quarter of them, at random, those of the
   * last one. Without a time step in @p parameters that is @p share of the critical one.
   * Collective.
   */
  BoxRun(const ContactParameters &parameters,
         const std::vector<ElasticPhase<3>> &phases,
         const MPI_Comm communicator,
         const double share = 0.95)
    : BoxRun(parameters, describe(parameters, phases), phases, communicator, share)
  {
  }

private:
  struct Description
  {
    BoxBody box;
    MeshBodyDescription body;
  };

  static Description describe(ContactParameters p,
                              const std::vector<ElasticPhase<3>> &phases)
  {
    // The mass of the body does not count here, but a phase has to have a density.
    PhaseParameters phase;
    phase.young_modulus = 1e9;
    phase.density       = phases[0].density;
    p.mesh.phases       = {phase};
    Description found;
    found.box.read(p, 1, 1);
    if (phases.size() > 1)
      {
        std::mt19937 random(1);
        std::vector<std::uint8_t> id(found.box.n_cells());
        for (std::uint8_t &one : id)
          one = static_cast<std::uint8_t>(random() % 4 == 0 ? phases.size() - 1 : 0);
        found.box.materials_in = reader_of(found.box.box.grid, id);
      }
    found.body = describe_body(found.box, p);
    return found;
  }

  BoxRun(const ContactParameters &parameters,
         const Description &description,
         const std::vector<ElasticPhase<3>> &phases,
         const MPI_Comm communicator,
         const double share)
    : distributed(description.box.distribute(description.body.contact.points,
                                             {},
                                             phases,
                                             InstructionSet::automatic,
                                             communicator))
    , body(*distributed,
           description.body.contact,
           description.body.top,
           description.body.held,
           completed(parameters, description.body, share))
  {
  }

  SlidingSetup completed(const ContactParameters &parameters,
                         const MeshBodyDescription &description,
                         const double share) const
  {
    SlidingSetup setup                 = parameters;
    setup.contact.friction_coefficient = description.friction;
    if (!(setup.step.dt > 0.))
      setup.step.dt = share * critical_time_step(distributed->largest_frequency().upper,
                                                 setup.step.beta2, setup.step.beta);
    return setup;
  }

  const std::unique_ptr<DistributedBody<3>> distributed;

public:
  const MeshPart<3> &part() const
  {
    return distributed->part();
  }

  SlidingMesh<3> body;
};
} // namespace verification

#endif
