#include "sliding/mesh/mesh_transient.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "dynamics/critical_time_step.h"
#include "io/drafts.h"
#include "parameters/keys.h"
#include "parameters/parameters.h"
#include "program/run_context.h"
#include "sliding/mesh/mesh_analysis.h"
#include "sliding/mesh/mesh_file.h"
#include "sliding/mesh/mesh_output.h"
#include "sliding/transient/run_draft.h"
#include "sliding/transient/run_needs.h"
#include "sliding/transient/transient_run.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>
#include <ostream>

namespace mesoslip
{
namespace
{
/** That forces on the nodes are pressures. @throws UserError */
void require_contact_area(const MeshBodyDescription &body)
{
  const std::vector<double> &area = body.contact.area;
  const auto found =
    std::find_if(area.begin(), area.end(), [](const double a) { return !(a < 0.); });
  if (found == area.end())
    return;
  const std::size_t node = found - area.begin();
  throw UserError("Mesh/Contact boundary: node " + std::to_string(node) +
                  " of the contact has no area seen along the normal of the flat, so no "
                  "pressure for Contact map and Observation/Contact means; leave faces "
                  "that look away from the flat out of the contact, or both keys");
}

BodySize body_size(const MeshBodyDescription &body,
                   const BodyScales &scales,
                   const unsigned int dim)
{
  BodySize size;
  size.dim             = dim;
  size.top_area        = std::accumulate(body.top.area.begin(), body.top.area.end(), 0.);
  size.n_cells         = body.n_cells;
  size.crossing        = scales.crossing();
  size.friction        = body.friction;
  size.n_contact_nodes = body.contact.points.size();
  for (const double area : body.contact.area)
    size.area.push_back(-area);
  size.reference = body.reference;
  return size;
}

template <int dim>
class MeshTransient : public MeshAnalysis<dim>
{
public:
  MeshTransient(const ContactParameters &given, const Keys &keys)
    : MeshAnalysis<dim>(given)
    , identity(run_identity(
        keys,
        this->parameters,
        "Content of Mesh/File = " + this->body.digest +
          "\nContent of Body/RVE file = " + this->parameters.mesh.rve_content + "\n"))
    , distributed(distribute_body(this->morphology,
                                  this->body.contact.points,
                                  this->body.probes,
                                  this->phases,
                                  this->parameters.sweep.isa))
    , scales(this->body.scales)
  {
    scales.highest_frequency = distributed->largest_frequency().upper;
    time                     = time_step();
    const auto n             = static_cast<double>(time.n_steps);
    needs = run_needs(this->parameters, scales, n, time.statistics_interval,
                      static_cast<double>(dim * this->body.n_points),
                      static_cast<double>(this->body.contact.points.size()));
    if (this->parameters.map.interval > 0. || this->parameters.wants_node_loads())
      require_contact_area(this->body);
    require_memory(needs.memory);
    this->memory.on_rank_0 += needs.memory.bytes;
  }

  ResourceNeed need() const override
  {
    return needs.disk;
  }

  void describe(std::ostream &out) const override
  {
    MeshAnalysis<dim>::describe(out);
    out << time.text() << "\nTimes: " << crossing_text(this->parameters, scales) << '\n'
        << needs.text() << bytes_text(needs.disk.bytes) << " on the disk\n";
    for (const std::string &warning : warnings())
      out << "warning: " << warning << '\n';
  }

  unsigned int useful_ranks() const override
  {
    // Some seconds of one core; cells that hide what ranks tell each other.
    constexpr double long_run        = 2e8;
    constexpr unsigned int of_a_rank = 2000;
    const std::uint64_t n_cells      = this->body.n_cells;
    if (static_cast<double>(n_cells) * static_cast<double>(time.n_steps) < long_run)
      return 1;
    unsigned int most = static_cast<unsigned int>(n_cells / of_a_rank);
    if constexpr (dim == 3)
      if (this->morphology.box)
        most = std::min(most, this->morphology.box->grid.cells[2] / 4);
    return std::max(1U, most);
  }

  bool resumable() const override
  {
    return true;
  }

  void write_draft(const std::string &folder) const override
  {
    on_root(MPI_COMM_WORLD, [&]() {
      const DraftMark mark(false);
      Hdf5File file = create_mesh_file(path_of_draft(folder, "dynamics.h5"),
                                       "mesoslip-dynamics", this->morphology, this->body);
      write_transient_draft(file, this->parameters, time,
                            vectors_shape(this->morphology));
      for (const MeshPlace &place : this->body.probes)
        {
          const auto &position = place.point.position;
          add_draft_probe(file, place.point.name,
                          {position.begin(), position.begin() + dim},
                          this->parameters.observation.probe_interval, time);
        }
      file.close();
    });
  }

  void run(RunContext &context) override;

private:
  TimeStepChoice time_step() const
  {
    constexpr double most_steps = 1e15;
    TimeStepChoice choice = choose_time_step(this->parameters, scales.highest_frequency);
    const double end_time = this->parameters.time.end_time, n = end_time / choice.step.dt;
    if (!(n < most_steps))
      throw UserError("Time/End time: " + to_text(end_time) + " s are " +
                      quantity_text(n, "") + " steps, more than any run can do; are " +
                      this->parameters.mesh.size_key() +
                      ", materials and times in SI units?");
    choice.statistics_interval =
      statistics_interval(this->body.shortest_side / scales.wave_speed, choice.step.dt);
    check_steady_from(this->parameters, n, choice.statistics_interval);
    return choice;
  }

  std::vector<std::string> warnings() const
  {
    return implausible_run(this->parameters, scales, static_cast<double>(time.n_steps));
  }

  const std::string identity; ///< see run_identity()
  const std::unique_ptr<DistributedBody<dim>> distributed;
  BodyScales scales;
  TimeStepChoice time;
  RunNeeds needs;
};

template <int dim>
void MeshTransient<dim>::run(RunContext &context)
{
  this->log_body(context);
  TransientCheckpoint checkpoint(context, this->parameters.checkpoints,
                                 identity + "Time step in s = " + to_text(time.step.dt) +
                                   "\n");
  const auto found = checkpoint.begin(time.n_steps);
  if (found == TransientCheckpoint::Found::complete)
    return;
  context.log(time.text());
  for (const std::string &warning : warnings())
    context.warn(warning);

  const MeshBodyDescription &body = this->body;
  const BodySize size             = body_size(body, scales, dim);
  SlidingMesh<dim> sliding(*distributed, body.contact, body.top, body.held,
                           run_setup(this->parameters, size, time),
                           context.options().profile ? &context.timer() : nullptr);
  sliding.set_initial_velocity(this->parameters.body.initial_velocity, body.held,
                               body.top);
  MeshProbes<dim> probes(
    body.probes, distributed->part(), this->phases, sliding.stepper,
    {sliding.contact, sliding.contact_nodes, body.contact.points, body.contact.area},
    this->parameters.observation.probe_interval);
  MeshOutput<dim> output(context, this->parameters, this->morphology, body, time,
                         distributed->part());
  TransientRun<dim> run(
    {this->parameters, time, scales, size, MeshAnalysis<dim>::place_of_cell, sliding,
     body.probes.empty() ? nullptr : &probes, output, checkpoint, context});
  run.carry_out(found == TransientCheckpoint::Found::state,
                [&]() { this->summarize_body("transient", context); });
}
} // namespace

std::unique_ptr<Analysis> make_mesh_transient(const ContactParameters &parameters,
                                              const Keys &keys)
{
  if (parameters.mesh.mesh.dim == 2)
    return std::make_unique<MeshTransient<2>>(parameters, keys);
  return std::make_unique<MeshTransient<3>>(parameters, keys);
}
} // namespace mesoslip
