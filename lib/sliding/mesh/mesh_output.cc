#include "sliding/mesh/mesh_output.h"

#include "base/exchange.h"
#include "exchange/datasets.h"
#include "exchange/xdmf.h"
#include "sliding/mesh/mesh_file.h"
#include "sliding/transient/result_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
const char mesh_snapshots[] = "/snapshots/displacement";

/** Steps nearest to From, From + Interval, ... up to To or the end. */
std::vector<std::uint64_t> snapshot_steps(const ObservationParameters &o,
                                          const TimeStepChoice &time)
{
  std::vector<std::uint64_t> steps;
  if (!(o.snapshots_interval > 0.))
    return steps;
  const double dt = time.step.dt, spacing = std::max(o.snapshots_interval, dt),
               end = static_cast<double>(time.n_steps) * dt,
               to  = std::isnan(o.snapshots_to) ? end : std::min(o.snapshots_to, end);
  double next      = o.snapshots_from;
  while (next <= to + 1e-6 * spacing)
    {
      steps.push_back(static_cast<std::uint64_t>(std::llround(next / dt)));
      next = o.snapshots_from + static_cast<double>(steps.size()) * spacing;
    }
  while (!steps.empty() && steps.back() >= time.n_steps)
    steps.pop_back();
  return steps;
}

/** Owned points of a rank with the displacement there. */
using Displacements = std::pair<std::vector<unsigned int>, std::vector<double>>;

/** Appends the shares of time of the contact nodes in a block. */
void append_shares(const NodeCounts &block,
                   std::vector<float> &slip,
                   std::vector<float> &stick,
                   std::vector<float> &separated)
{
  for (std::size_t i = 0; i < block.slip.size(); ++i)
    {
      slip.push_back(block.slip[i] / static_cast<float>(block.n_steps));
      stick.push_back(block.stick[i] / static_cast<float>(block.n_steps));
      separated.push_back(1.f - slip.back() - stick.back());
    }
}
} // namespace

template <int dim>
MeshOutput<dim>::MeshOutput(RunContext &context,
                            const ContactParameters &parameters,
                            const MeshMorphology<dim> &morphology,
                            const MeshBodyDescription &body,
                            const TimeStepChoice &time,
                            const MeshPart<dim> &part)
  : context(context)
  , parameters(parameters)
  , morphology(morphology)
  , body(body)
  , time(time)
  , part(part)
  , steps(snapshot_steps(parameters.observation, time))
{
}

template <int dim>
void MeshOutput<dim>::begin(const Stepper &of_stepper, const std::uint64_t n_done)
{
  stepper   = &of_stepper;
  n_written = n_done;
  on_root(context.communicator(), [&]() {
    const std::string path = context.file("dynamics.h5");
    if (n_done > 0)
      {
        file.emplace(Hdf5File::resume(path, "start again without --resume"));
        for (const std::string &name : file->list("/"))
          if (name != "mesh" && name != "material" && name != "snapshots")
            file->remove("/" + name);
      }
    else
      {
        file.emplace(create_mesh_file(path, "mesoslip-dynamics-mesh", morphology, body));
      }
    if (has_snapshots())
      file->reserve_rows(mesh_snapshots, {steps.size(), body.n_points, dim});
    file->flush();
  });
}

template <int dim>
std::uint64_t MeshOutput<dim>::next_step(const std::uint64_t n) const
{
  const auto next = std::lower_bound(steps.begin(), steps.end(), n);
  return next == steps.end() ? std::numeric_limits<std::uint64_t>::max() : *next;
}

template <int dim>
std::vector<double> MeshOutput<dim>::whole_displacement() const
{
  std::vector<double> own(std::size_t(part.n_owned) * dim);
  for (unsigned int i = 0; i < part.n_owned; ++i)
    for (unsigned int c = 0; c < dim; ++c)
      own[std::size_t(i) * dim + c] = stepper->u.row(c, 0)[i];
  const std::vector<unsigned int> points(part.point_in_mesh.begin(),
                                         part.point_in_mesh.begin() + part.n_owned);
  std::vector<double> whole(context.root() ? body.n_points * dim : 0);
  for (const std::string &message :
       gather(context.communicator(), save_state(Displacements(points, own))))
    {
      Displacements of_rank;
      load_state(message, of_rank, "the message of another process");
      for (std::size_t i = 0; i < of_rank.first.size(); ++i)
        std::copy_n(&of_rank.second[i * dim], dim,
                    &whole[std::size_t(of_rank.first[i]) * dim]);
    }
  return whole;
}

template <int dim>
void MeshOutput<dim>::before_step(const std::uint64_t)
{
  const std::vector<double> whole = whole_displacement();
  if (context.root())
    file->write_row(mesh_snapshots, n_written, whole);
  ++n_written;
}

template <int dim>
void MeshOutput<dim>::sync()
{
  file->sync();
}

template <int dim>
void MeshOutput<dim>::write(const MeshResult &result)
{
  const std::string force = dim == 2 ? "N/m" : "N", energy = dim == 2 ? "J/m" : "J";
  const ContactHistory &h = result.history;
  const std::vector<double> friction =
    transmits_tangential_force(parameters.top)
      ? quotients(result.top.tangential_force, result.top.normal_force)
      : quotients(h.tangential_force, h.normal_force);
  const std::vector<Series> columns = {
    {"time", "s", &h.time},
    {"contact_normal_force", force, &h.normal_force},
    {"contact_tangential_force", force, &h.tangential_force},
    {"friction_energy", energy, &h.friction_energy},
    {"impact_energy", energy, &h.impact_energy},
    {"sticking_nodes", "-", &h.sticking},
    {"slipping_nodes", "-", &h.slipping},
    {"separated_nodes", "-", &h.separated},
    {"top_normal_force", force, &result.top.normal_force},
    {"top_tangential_force", force, &result.top.tangential_force},
    {"top_displacement", "m", &result.top.displacement},
    {"apparent_friction", "-", &friction}};
  RunConditions conditions  = parameters.stated_conditions();
  conditions["time_step"]   = time.step.dt;
  conditions["steady_from"] = steady_from(result);
  conditions["steady_to"]   = static_cast<double>(result.steps_done) * time.step.dt;
  write_run_conditions(*file, conditions);
  write_series(*file, "/history", columns);
  write_table(context.file("history.csv"), columns, 5000);
  const EnergyHistory &e = result.energy;
  if (!e.time.empty())
    {
      const std::vector<double> residual = e.residual();
      const std::vector<Series> energies = {{"time", "s", &e.time},
                                            {"kinetic", energy, &e.kinetic},
                                            {"elastic", energy, &e.elastic},
                                            {"potential", energy, &e.potential},
                                            {"external_work", energy, &e.external_work},
                                            {"friction", energy, &e.friction},
                                            {"impact", energy, &e.impact},
                                            {"damping", energy, &e.damping},
                                            {"scheme", energy, &e.scheme},
                                            {"residual", energy, &residual}};
      write_series(*file, "/energy", energies);
      file->write_attribute("/energy", "initial", e.initial);
      write_table(context.file("energy.csv"), energies);
    }
  for (const ProbeHistory &probe : result.probes)
    write_probe(*file, "/probes/" + probe.name, probe, dim);
  write_contact(result);
  std::vector<double> times;
  for (std::size_t k = 0; k < n_written; ++k)
    times.push_back(static_cast<double>(steps[k]) * time.step.dt);
  if (has_snapshots())
    {
      file->reserve_rows(mesh_snapshots, {n_written, body.n_points, dim});
      write_dataset(*file, "/snapshots/time", {times.size()}, times, "s");
      file->write_unit(mesh_snapshots, "m");
    }
  if (!times.empty())
    write_xdmf(context.file("dynamics.xdmf"), "dynamics.h5", morphology.mesh,
               {{"displacement", mesh_snapshots, XdmfField::Values::nodes, {dim}}},
               times);
  show_mesh_phases(context.file("dynamics-phases.xdmf"), "dynamics.h5", morphology);
  file->close();
  file.reset();
}

template <int dim>
ContactSummary MeshOutput<dim>::summary_of(const MeshResult &result) const
{
  return summarize_contact(result.blocks, body.contact.points.size(), time.step.dt,
                           steady_from(result));
}

template <int dim>
double MeshOutput<dim>::steady_from(const MeshResult &result) const
{
  return 0.5 * static_cast<double>(result.steps_done) * time.step.dt;
}

template <int dim>
void MeshOutput<dim>::write_contact(const MeshResult &result)
{
  const std::size_t n = body.contact.points.size();
  std::vector<double> position, area, slip, stick, separated;
  for (const double a : body.contact.area)
    area.push_back(-a);
  for (const unsigned int point : body.contact.points)
    for (unsigned int d = 0; d < dim; ++d)
      position.push_back(morphology.mesh.points[point][d]);
  for (const ContactShares &shares : summary_of(result).node_shares)
    {
      slip.push_back(shares.slip);
      stick.push_back(shares.stick);
      separated.push_back(shares.separation);
    }
  write_dataset(*file, "/contact/point", {n}, body.contact.points);
  write_series(*file, "/contact",
               {{"position", "m", &position, dim},
                {"area", dim == 2 ? "m" : "m^2", &area},
                {"height", "m", &body.contact.height},
                {"friction_coefficient", "-", &body.friction},
                {"slip", "-", &slip},
                {"stick", "-", &stick},
                {"separated", "-", &separated}});
  write_blocks(result);
}

template <int dim>
void MeshOutput<dim>::write_blocks(const MeshResult &result)
{
  std::vector<double> times;
  std::vector<float> slip, stick, separated;
  for (const NodeCounts &block : result.blocks)
    {
      times.push_back(static_cast<double>(block.first_step + block.n_steps) *
                      time.step.dt);
      append_shares(block, slip, stick, separated);
    }
  const Shape shape = {times.size(), body.contact.points.size()};
  write_series(*file, "/contact/blocks", {{"time", "s", &times}});
  write_dataset(*file, "/contact/blocks/slip", shape, slip);
  write_dataset(*file, "/contact/blocks/stick", shape, stick);
  write_dataset(*file, "/contact/blocks/separated", shape, separated);
}

template <int dim>
void MeshOutput<dim>::summarize(const MeshResult &result) const
{
  const double n_steps = static_cast<double>(result.steps_done);
  const auto largest   = [](const std::vector<double> &values) {
    double most = 0.;
    for (const double x : values)
      most = std::max(most, std::fabs(x));
    return most;
  };
  const ContactShares states    = summary_of(result).shares;
  nlohmann::json &summary       = context.summary();
  summary["kernel"]             = result.kernel;
  summary["steps"]              = result.steps_done;
  summary["time_step"]          = time.step.dt;
  summary["critical_time_step"] = time.critical;
  summary["beta2"]              = time.step.beta2;
  summary["rayleigh_beta"]      = time.step.beta;
  summary["simulated_time"]     = n_steps * time.step.dt;
  summary["cell_updates_per_second"] =
    result.loop_seconds > 0.
      ? n_steps * static_cast<double>(body.n_cells) / result.loop_seconds
      : 0.;
  summary["pressure"]            = parameters.top.pressure.amplitude();
  summary["flat_velocity"]       = parameters.contact.flat_velocity.amplitude();
  summary["slip_fraction"]       = states.slip;
  summary["stick_fraction"]      = states.stick;
  summary["separation_fraction"] = states.separation;
  summary["largest_strain"]      = result.largest_strain;
  summary["friction_energy"] =
    result.history.friction_energy.empty() ? 0. : result.history.friction_energy.back();
  const EnergyHistory &e = result.energy;
  const double scale     = std::max({largest(e.friction), largest(e.kinetic),
                                     largest(e.elastic), largest(e.external_work)});
  summary["energy_balance_residual"] =
    scale > 0. ? nlohmann::json(largest(e.residual()) / scale) : nlohmann::json();
  context.log(brief_text(4, "Slip ", 100. * states.slip, " %, stick ",
                         100. * states.stick, " %, separated ", 100. * states.separation,
                         " % in the second half of the run"));
  context.log("Largest strain " + quantity_text(100. * result.largest_strain, "%"));
  if (scale > 0.)
    context.log(brief_text(3, "Energy balance closes to ", largest(e.residual()) / scale,
                           " of the largest energy") +
                (parameters.energy_interval > 1
                   ? "; with Observation/Energy interval = 1 it closes to round-off"
                   : ""));
}

template class MeshOutput<2>;
template class MeshOutput<3>;
} // namespace mesoslip
