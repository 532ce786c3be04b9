#include "simulation/contact_program.h"

#include "elasticity/row_partition.h"
#include "elasticity/uniform_material.h"
#include "io/errors.h"
#include "io/parameters.h"
#include "io/raw_parameters.h"
#include "io/run_context.h"
#include "io/version.h"
#include "material/plausibility.h"
#include "simulation/contact_parameters.h"
#include "simulation/friction_homogenization.h"
#include "simulation/modal.h"
#include "simulation/run_report.h"
#include "simulation/run_size.h"
#include "simulation/scene.h"
#include "simulation/static_contact.h"
#include "simulation/time_step_choice.h"
#include "simulation/transient.h"
#include "simulation/transient_setup.h"
#include "simulation/transient_summary.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <ostream>

namespace mesoslip
{
namespace
{
void check_probes(const ContactParameters &parameters, const UniformGrid<2> &grid)
{
  for (const ProbeParameters &probe : parameters.observation.probes)
    for (unsigned int d = 0; d < 2; ++d)
      if (!(probe.position[d] >= 0. &&
            probe.position[d] <= grid.extent(d) * (1. + 1e-12)))
        throw UserError("Observation/" + probe.name + "/Position: (" +
                        to_text(probe.position[0]) + ", " + to_text(probe.position[1]) +
                        ") m lies outside the body, which reaches from (0, 0) to (" +
                        to_text(grid.extent(0)) + ", " + to_text(grid.extent(1)) + ") m");
  const double x = parameters.observation.reference_x;
  if (!std::isnan(x) && !(x >= 0. && x <= grid.extent(0)))
    throw UserError("Observation/Reference x: " + to_text(x) +
                    " m lies outside the body, 0 to " + to_text(grid.extent(0)) + " m");
}

// A million years on a machine of today.
constexpr double most_steps = 1e18;

// mu_inter rests on the samples for statistics from there to the end: three at least,
// unless the run is too short for it anyway.
void check_steady_from(const ContactParameters &parameters,
                       const UniformMaterial &material,
                       const double n_steps)
{
  const double from = parameters.observation.steady_from, end = parameters.time.end_time;
  const double n_samples = n_steps / statistics_interval(material, end / n_steps);
  const double latest = n_samples < static_cast<double>(TransientSummary::least_samples)
                          ? end
                          : end - 2. * end / n_samples;
  if (!std::isnan(from) && !(from < end && from <= latest))
    throw UserError(
      "Observation/Steady from: " + to_text(from) +
      " s leaves fewer than three samples for statistics before Time/End time, " +
      to_text(end) + " s; set it earlier, or auto");
}

// The rows of nodes are divided among the ranks.
void check_ranks(const UniformGrid<2> &grid)
{
  const unsigned int n_rows  = grid.cells[1] + 1,
                     n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                     most    = largest_number_of_ranks(n_rows);
  if (n_ranks > most)
    throw UserError(
      "the body has " + std::to_string(n_rows) +
      " rows of nodes (Body/Cells), which are divided among the processes, "
      "two at least each; start " +
      (most == 1 ? "it without mpirun" : "at most " + std::to_string(most) + " of them") +
      " instead of " + std::to_string(n_ranks));
}

Need check_transient(const ContactParameters &parameters, const Scene &scene)
{
  check_ranks(scene.grid);
  const UniformMaterial material = scene.make_material(parameters.periodic);
  check_time_step(parameters, material);
  const double n_steps = largest_number_of_steps(parameters, material);
  if (!(n_steps <= most_steps))
    throw UserError("Time/End time: " + to_text(parameters.time.end_time) + " s are " +
                    quantity_text(n_steps, "") +
                    " steps, more than any run can do; are Body/Size in m, the stiffness "
                    "in Pa, the density in kg/m^3 and the times in s?");
  check_steady_from(parameters, material, n_steps);
  require_memory(history_memory(parameters, material, n_steps));
  return dynamics_file_size(parameters, material, n_steps);
}

void estimate_transient(const ContactParameters &parameters,
                        const Scene &scene,
                        std::ostream &report)
{
  const UniformMaterial material = scene.make_material(parameters.periodic);
  const TimeStepChoice time      = choose_time_step(parameters, material);
  const double n_steps           = static_cast<double>(time.n_steps);
  report.precision(4);
  report << time.text() << "\nTimes: " << crossing_text(parameters, material) << '\n'
         << n_snapshots(parameters, n_steps) << " snapshots, "
         << bytes_text(dynamics_file_size(parameters, material, n_steps).bytes)
         << " on the disk, "
         << bytes_text(field_memory(parameters.analysis, scene.grid).bytes +
                       history_memory(parameters, material, n_steps).bytes)
         << " of memory\n";
  for (const std::string &warning : transient_warnings(parameters, material))
    report << "Warning: " << warning << '\n';
}

void estimate(dealii::ParameterHandler &prm, std::ostream &report)
{
  const ContactParameters parameters = ContactParameters::parse(prm);
  if (parameters.analysis == ContactAnalysis::friction_homogenization)
    return;
  const Scene scene = make_scene(parameters);
  for (const std::string &line : body_text(parameters, scene))
    report << line << '\n';
  report << 2 * scene.grid.n_nodes() << " degrees of freedom\n";
  for (const std::string &warning : body_warnings(parameters, scene))
    report << "Warning: " << warning << '\n';
  if (parameters.analysis == ContactAnalysis::transient)
    estimate_transient(parameters, scene, report);
}

// What every analysis needs, then what the chosen one does.
Need check(dealii::ParameterHandler &prm)
{
  const ContactParameters parameters = ContactParameters::parse(prm);
  require_memory(field_memory(parameters.analysis, body_grid(parameters)));
  const Scene scene = make_scene(parameters);
  check_probes(parameters, scene.grid);
  if (parameters.analysis != ContactAnalysis::friction_homogenization)
    require_frequency(scene.make_material(parameters.periodic));
  switch (parameters.analysis)
    {
    case ContactAnalysis::transient:
      return check_transient(parameters, scene);
    case ContactAnalysis::static_contact:
      check_static_contact(parameters, scene);
      break;
    case ContactAnalysis::friction_homogenization:
      friction_estimates(read_friction_homogenization(parameters.homogenization,
                                                      parameters.body.rve_file));
      break;
    case ContactAnalysis::modal:
      check_modal(parameters, scene);
      break;
    }
  return {};
}

// Whatever decides a bit of the state or of what was written so far: a run that is
// resumed has to agree in it.
std::string run_identity(const dealii::ParameterHandler &prm,
                         const ContactParameters &parameters,
                         const Scene &scene)
{
  return canonical_parameters(prm,
                              {"Output folder", "Time/End time",
                               "Observation/Steady from", "Checkpoints/", "Performance/",
                               "Modal/", "Static contact/", "Friction homogenization/"}) +
         "Performance/Instruction set = " +
         to_string(resolve(sweep_options(parameters).isa)) +
         "\nContent of Body/RVE file = " + scene.rve_digest +
         "\nProgram version = " + version + "\n";
}

// With a log of what is taken, and of what looks like a slip.
Scene make_logged_scene(const ContactParameters &parameters, RunContext &context)
{
  Scene scene = make_scene(parameters);
  for (const std::string &line : body_text(parameters, scene))
    context.log(line);
  for (const std::string &warning : body_warnings(parameters, scene))
    context.warn(warning);
  return scene;
}

void run(dealii::ParameterHandler &prm, RunContext &context)
{
  const ContactParameters parameters = ContactParameters::parse(prm);
  if (context.n_ranks() > 1 && (parameters.analysis == ContactAnalysis::modal ||
                                parameters.analysis == ContactAnalysis::static_contact))
    context.log(
      "This analysis runs on one process, all others repeat it; start it without mpirun");
  switch (parameters.analysis)
    {
    case ContactAnalysis::transient:
      {
        const Scene scene = make_logged_scene(parameters, context);
        return run_transient(parameters, scene, run_identity(prm, parameters, scene),
                             context);
      }
    case ContactAnalysis::modal:
      return run_modal(parameters, make_logged_scene(parameters, context), context);
    case ContactAnalysis::static_contact:
      return run_static_contact(parameters, make_logged_scene(parameters, context),
                                context);
    case ContactAnalysis::friction_homogenization:
      return run_friction_homogenization(parameters, context);
    }
}
} // namespace

Program contact_dynamics_program()
{
  Program program;
  program.name = "contact_dynamics";
  program.description =
    "Explicit dynamics of an elastic body that rubs on a moving rigid flat.";
  program.declare    = ContactParameters::declare;
  program.check_keys = ContactParameters::check_keys;
  program.check      = check;
  program.estimate   = estimate;
  program.resumable  = [](dealii::ParameterHandler &prm) {
    return ContactParameters::parse(prm).analysis == ContactAnalysis::transient;
  };
  program.run = run;
  return program;
}
} // namespace mesoslip
