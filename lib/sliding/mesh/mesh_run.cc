#include "sliding/mesh/mesh_run.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "base/text.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace mesoslip
{
namespace
{
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
SlidingSetup setup_of(const ContactParameters &parameters,
                      const MeshBodyDescription &body,
                      const TimeStepChoice &time)
{
  SlidingSetup setup                 = static_cast<const SlidingSetup &>(parameters);
  setup.step                         = time.step;
  setup.contact.friction_coefficient = body.friction;
  setup.steps_per_block =
    std::max<std::uint64_t>(1, time.n_steps / parameters.observation.blocks);
  setup.monitored_nodes = monitored_nodes(
    body.reference.number, static_cast<unsigned int>(body.contact.points.size()) - 1);
  setup.node_loads  = parameters.wants_node_loads();
  setup.contact_map = contact_map_setup(parameters, time.step.dt);
  return setup;
}

template <int dim>
std::string place_of_cell(const CellExtreme &cell)
{
  std::string text = "cell " + std::to_string(cell.cell) + " around ";
  for (unsigned int d = 0; d < dim; ++d)
    text += std::string(d > 0 ? ", " : "") + "xyz"[d] + " = " +
            quantity_text(1e3 * cell.middle[d], "mm");
  return text;
}
} // namespace

template <int dim>
MeshRun<dim>::MeshRun(const ContactParameters &parameters,
                      const MeshBodyDescription &description,
                      const BodyScales &scales,
                      const TimeStepChoice &time,
                      const DistributedBody<dim> &distributed,
                      const std::vector<ElasticPhase<dim>> &phases,
                      TransientCheckpoint &checkpoint,
                      MeshOutput<dim> &output,
                      RunContext &context)
  : parameters(parameters)
  , description(description)
  , scales(scales)
  , time(time)
  , part(distributed.part())
  , checkpoint(checkpoint)
  , output(output)
  , context(context)
  , size(body_size(description, scales, dim))
  , body(distributed,
         description.contact,
         description.top,
         description.held,
         setup_of<dim>(parameters, description, time))
  , monitor(
      body.stepper,
      [this]() { return body.boundary_work(); },
      [this](const Runaway &found, const std::uint64_t n) {
        throw NumericalFailure(
          brief_text(
            3, "the run blew up: its energy is ", found.energy, " J",
            dim == 2 ? "/m" : "", " where at most ", found.put_in,
            " were put in; likely cause: ",
            undefined_friction(this->parameters, found.energy),
            "too large a step, reduce Time/Safety factor, and check that Mesh/Scale, "
            "loads and materials are in SI units; found"),
          static_cast<long long>(n), static_cast<double>(n) * this->time.step.dt, "");
      })
  , strains(body.stepper,
            [this](const Deformation &found, const std::uint64_t n) { judge(found, n); })
  , probes(description.probes,
           part,
           phases,
           body.stepper,
           {body.contact, body.contact_nodes, description.contact.points,
            description.contact.area},
           parameters.observation.probe_interval)
  , statistics(parameters, size, time, body, checkpoint, context)
{
  set_initial_velocity();
  if (body.setup.contact_map.interval > 0)
    map = std::make_unique<ContactMapOutput<dim>>(
      body.setup.contact_map, body.contact_map, body.setup.contact_places, size,
      context.communicator());
}

// The scheme has velocities of beta2 dt before, see ExplicitStepper.
template <int dim>
void MeshRun<dim>::set_initial_velocity()
{
  std::vector<std::array<bool, dim>> held(part.points.size());
  const PointIndex index(part);
  const auto hold = [&](const unsigned int point, const unsigned int component) {
    for (const unsigned int i : index.find(point))
      held[i][component] = true;
  };
  for (const HeldComponent &h : description.held)
    hold(h.point, h.component);
  // What the top holds does not move from the start.
  for (const unsigned int point : description.top.points)
    for (unsigned int c = 0; c < dim; ++c)
      if (c + 1 < dim ? transmits_tangential_force(parameters.top)
                      : parameters.top.kind == TopSetup::Kind::held)
        hold(point, c);
  constexpr unsigned int normal = dim - 1;
  std::vector<std::array<double, 3>> a(part.points.size(), time.step.acceleration);
  const SharedNodes &contact = body.contact_nodes, top(description.top.points, part);
  for (unsigned int i = 0; i < contact.size(); ++i)
    if (contact.point(i) != SharedNodes::none &&
        body.contact.rests(i, a[contact.point(i)][normal]))
      a[contact.point(i)][normal] = 0.;
  std::vector<double> mass(part.points.size()), of_top(top.size(), 0.);
  body.stepper.mass_row(0, mass.data());
  for (unsigned int i = 0; i < top.size(); ++i)
    if (top.point(i) != SharedNodes::none && !held[top.point(i)][normal])
      of_top[i] = mass[top.point(i)];
  const std::vector<double> pushed = body.top.start_acceleration(of_top);
  for (unsigned int i = 0; i < top.size(); ++i)
    if (top.point(i) != SharedNodes::none)
      a[top.point(i)][normal] = pushed[i];
  const double back = -time.step.beta2 * time.step.dt;
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t i = 0; i < part.points.size(); ++i)
      body.w.row(c, 0)[i] =
        held[i][c] ? 0. : parameters.body.initial_velocity[c] + back * a[i][c];
}

template <int dim>
void MeshRun<dim>::judge(const Deformation &found, const std::uint64_t n)
{
  require_upright_cells(found, n, time, parameters, scales, place_of_cell<dim>);
  const double t            = static_cast<double>(n) * time.step.dt;
  const std::string warning = large_strain_warning(
    found, parameters, scales, place_of_cell<dim>,
    " in step " + std::to_string(n) + " at t = " + quantity_text(t, "s"));
  if (!warning.empty() && !warned)
    context.warn(warning);
  warned = warned || !warning.empty();
}

template <int dim>
bool MeshRun<dim>::control(const std::uint64_t n)
{
  const RunRequest wanted = statistics.request(n, body.energy.get());
  if (wanted == RunRequest::look)
    monitor.check(n);
  context.progress().update(n, static_cast<double>(n) * time.step.dt);
  interrupted    = wanted == RunRequest::stop;
  at_limit_cycle = wanted == RunRequest::end && n < time.n_steps;
  if (wanted == RunRequest::save || wanted == RunRequest::stop)
    save();
  return wanted < RunRequest::stop;
}

template <int dim>
CheckpointPosition MeshRun<dim>::position() const
{
  CheckpointPosition p;
  p.step           = body.stepper.step_number();
  p.time           = static_cast<double>(p.step) * time.step.dt;
  p.by_limit_cycle = at_limit_cycle;
  p.at_end         = at_limit_cycle || p.step == time.n_steps;
  p.snapshots      = output.n_snapshots();
  return p;
}

template <int dim>
void MeshRun<dim>::save()
{
  if (map)
    map->drain(body.stepper.step_number());
  output.sync();
  checkpoint.write(position(), save_state(*this));
}

template <int dim>
void MeshRun<dim>::restore()
{
  checkpoint.restore(*this);
  at_limit_cycle = checkpoint.position().by_limit_cycle;
  context.log("Resumed at step " + std::to_string(body.stepper.step_number()));
}

template <int dim>
TransientResult MeshRun<dim>::run()
{
  std::vector<StepObserver *> observers = {&monitor, &strains};
  if (body.energy)
    observers.push_back(body.energy.get());
  if (!description.probes.empty())
    observers.push_back(&probes);
  output.begin(body.stepper, checkpoint.position().snapshots, map.get());
  if (output.has_snapshots())
    {
      observers.push_back(&output);
      monitor.guard(output);
    }
  if (map)
    {
      observers.push_back(map.get());
      monitor.guard(*map);
    }
  context.progress().start("Sliding", time.n_steps, description.n_cells,
                           body.stepper.step_number());
  if (!at_limit_cycle)
    {
      const auto scope = context.timer().scope("Time loop");
      const auto begin = std::chrono::steady_clock::now();
      run_time_loop(body.stepper, observers, time.n_steps, control_interval(size.n_cells),
                    [&](const std::uint64_t n) { return control(n); });
      monitor.check(body.stepper.step_number());
      seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
  context.progress().finish();
  if (!interrupted && parameters.checkpoints.keep)
    save();
  return collect();
}

template <int dim>
TransientResult MeshRun<dim>::collect()
{
  TransientResult all{parameters, size, time};
  statistics.collect(all);
  if (map)
    map->drain(body.stepper.step_number());
  strains.look(body.stepper.step_number());
  all.largest_strain = strains.largest_strain();
  all.steps_done     = body.stepper.step_number();
  all.loop_seconds   = seconds;
  all.interrupted    = interrupted;
  all.kernel         = body.stepper.kernel_name();
  all.probes         = probes.gather();
  if (body.energy)
    all.energy = body.energy->reduce();
  return all;
}

template class MeshRun<2>;
template class MeshRun<3>;
} // namespace mesoslip
