#include "base/errors.h"
#include "exchange/rve_file.h"
#include "io/hdf5_file.h"
#include "material/engineering_constants.h"
#include "parameters/parameters.h"
#include "sliding/analyses/friction_homogenization.h"
#include "sliding/analyses/run_summary.h"
#include "sliding/analyses/static_contact.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
const std::string section = "Friction homogenization/";

const std::string hint = "a transient run of contact_dynamics writes it";

Hdf5File open_dynamics(const std::string &path)
{
  Hdf5File file = Hdf5File::open(path, hint);
  file.check_header("mesoslip-dynamics", 1, 2, hint);
  return file;
}

void read_conditions(const std::string &path, FrictionRun &run)
{
  const Hdf5File file   = open_dynamics(path);
  const auto conditions = read_run_conditions(file);
  if (!conditions)
    throw UserError(path + " does not tell its loads and its friction law, as an earlier "
                           "version wrote it; run contact_dynamics again");
  run.conditions  = *conditions;
  run.change_note = file.change_note("contact_dynamics");
}

FrictionRun read_run(const RunSummary &summary)
{
  summary.require_analysis("transient");
  FrictionRun run;
  run.folder      = summary.folder();
  std::string why = summary.text("global_interface_friction_warning");
  if (why.empty())
    why = "the run has no steady part; give it a longer Time/End time";
  run.mu_inter         = summary.number("global_interface_friction_coefficient", why);
  run.contact_duration = summary.find_number("mean_contact_duration");
  run.duration_warning = summary.text("mean_contact_duration_warning");
  read_conditions(summary.file("dynamics.h5"), run);
  run.friction_coefficient = run.conditions.number("friction_coefficient");
  run.regularization_time  = run.conditions.number("regularization_time");
  if (run.regularization_time && !(*run.regularization_time > 0.))
    run.regularization_time.reset(); // plain Coulomb
  if (run.contact_duration && !(*run.contact_duration > 0.))
    run.contact_duration.reset();
  return run;
}

/** The phases of the heterogeneous body, its contact nodes, and what of the contact and
 * the volume they take.
 */
struct Morphology
{
  std::vector<Phase<2>> phases;
  std::vector<double> surface, volume;
  std::vector<std::uint8_t> bottom; ///< phases of the bottom cells
  std::vector<double> node_friction;
  std::string rve_digest;
  std::string rve_note; ///< what to say of the RVE file, if it has changed
};

Morphology read_morphology(const RunSummary &summary)
{
  const Hdf5File file       = open_dynamics(summary.file("dynamics.h5"));
  const UniformGrid<2> grid = read_grid(file, hint);
  const auto names          = file.read<std::string>("/material/name", {}, hint);
  const std::size_t n       = names.size();
  const auto D              = file.read<double>("/material/stiffness", {n, 3, 3}, hint);
  const auto id =
    file.read<std::uint8_t>("/material/phase_id", {grid.cells[1], grid.cells[0]},
                            "Heterogeneous run has to be one of a heterogeneous "
                            "body");
  Morphology m;
  m.surface.assign(n, 0.);
  m.volume.assign(n, 0.);
  m.rve_digest = file.read_attribute<std::string>("/material", "rve_digest", hint);
  for (std::size_t p = 0; p < n; ++p)
    {
      Phase<2> phase;
      phase.name      = names[p];
      phase.stiffness = Eigen::Map<const VoigtMatrix<2>>(D.data() + 9 * p);
      m.phases.push_back(phase);
    }
  m.node_friction = file.read<double>("/contact/friction_coefficient",
                                      {grid.cells[0] + std::size_t(1)}, hint);
  m.bottom.assign(id.begin(), id.begin() + grid.cells[0]);
  for (std::size_t k = 0; k < id.size(); ++k)
    {
      if (id[k] >= n)
        throw UserError(file.path() +
                        ": /material/phase_id names a phase that /material/name "
                        "does not have; run contact_dynamics again");
      m.volume[id[k]] += 1. / static_cast<double>(id.size());
      if (k < grid.cells[0])
        m.surface[id[k]] += 1. / grid.cells[0];
    }
  return m;
}

void set_friction_coefficients(Morphology &m,
                               const FrictionRun &run,
                               const std::string &rve_file)
{
  if (run.friction_coefficient)
    {
      for (Phase<2> &phase : m.phases)
        phase.friction_coefficient = *run.friction_coefficient;
      return;
    }
  if (rve_file.empty())
    throw UserError("Body/RVE file is empty, but " + run.folder +
                    " took its friction coefficients from the phases of one; name it");
  const RveFile rve = RveFile::open(rve_file);
  if (rve.digest() != m.rve_digest)
    throw UserError("Body/RVE file: " + rve_file + " is not the one that " + run.folder +
                    " was run with (digest " + rve.digest() + ", there " + m.rve_digest +
                    "); name that one");
  if (rve.phases().size() != m.phases.size())
    throw UserError("Body/RVE file: " + rve_file + " has " +
                    std::to_string(rve.phases().size()) + " phases, but " + run.folder +
                    " was run with " + std::to_string(m.phases.size()) +
                    "; run contact_dynamics again");
  for (std::size_t p = 0; p < m.phases.size(); ++p)
    m.phases[p].friction_coefficient = rve.phases()[p].friction_coefficient;
  m.rve_note = rve.change_note();
}

/** Eq. (17) over nodes; the ends stand for half a cell (also of a periodic body). */
double coefficient_of_nodes(const std::vector<double> &mu,
                            const std::vector<double> &pressure)
{
  double friction = 0., force = 0.;
  for (std::size_t i = 0; i < mu.size(); ++i)
    {
      const double f = (i == 0 || i + 1 == mu.size() ? 0.5 : 1.) * pressure[i];
      force += f;
      friction += f * mu[i];
    }
  return friction / force;
}

/** Eq. (19): the pressure of a node goes with the moduli of the cells beside it. */
std::vector<double> moduli_of_nodes(const Morphology &m)
{
  const std::size_t n = m.bottom.size();
  std::vector<double> cells, nodes;
  for (const std::uint8_t id : m.bottom)
    cells.push_back(closest_isotropic<2>(m.phases[id].stiffness).young_modulus);
  for (std::size_t i = 0; i <= n; ++i)
    nodes.push_back(0.5 * (cells[i > 0 ? i - 1 : 0] + cells[i < n ? i : n - 1]));
  return nodes;
}

std::vector<double> read_static_pressures(const std::string &folder,
                                          const std::vector<std::string> &phases,
                                          const std::string &rve_digest)
{
  const std::string key = section + "Static contact";
  const RunSummary summary(key, folder);
  summary.require_analysis("static contact");
  if (!rve_digest.empty() && summary.text("rve_digest") != rve_digest)
    throw UserError(
      key + ": " + folder +
      " is an analysis of another RVE file than the heterogeneous run's; run it "
      "again with the same Body/RVE file");
  const auto found = summary.numbers("phase_contact_pressures", "run the analysis again");
  std::vector<double> pressures;
  for (const std::string &name : phases)
    {
      if (found.count(name) == 0)
        throw UserError(key + ": " + folder + " has no contact pressure of the phase " +
                        name + ", which is in contact in the heterogeneous run");
      pressures.push_back(found.at(name));
    }
  return pressures;
}
} // namespace

FrictionHomogenizationInput
read_friction_homogenization(const FrictionHomogenizationParameters &parameters,
                             const std::string &rve_file)
{
  if (parameters.heterogeneous_run.empty())
    throw UserError(section +
                    "Heterogeneous run is empty; name the output folder of a transient "
                    "run of the heterogeneous body");
  FrictionHomogenizationInput input;
  const RunSummary heterogeneous(section + "Heterogeneous run",
                                 parameters.heterogeneous_run);
  input.heterogeneous = read_run(heterogeneous);
  if (!parameters.homogeneous_run.empty())
    {
      const RunSummary homogeneous(section + "Homogeneous run",
                                   parameters.homogeneous_run);
      input.homogeneous = read_run(homogeneous);
      const std::string loads =
        differences_text(condition_differences(input.homogeneous->conditions,
                                               input.heterogeneous.conditions),
                         true);
      if (!loads.empty())
        throw UserError(section + "Homogeneous run: " + input.homogeneous->folder +
                        " and " + parameters.heterogeneous_run +
                        " were made under different conditions (" + loads +
                        "); run both under the same");
    }

  Morphology m = read_morphology(heterogeneous);
  set_friction_coefficients(m, input.heterogeneous, rve_file);
  for (const std::string &note :
       {input.heterogeneous.change_note,
        input.homogeneous ? input.homogeneous->change_note : "", m.rve_note})
    if (!note.empty())
      input.warnings.push_back(note);
  input.surface = contact_phases(m.phases, m.surface);
  input.volume  = contact_phases(m.phases, m.volume);
  for (std::size_t p = 0; p < m.phases.size(); ++p)
    if (m.surface[p] > 0.)
      input.phase_names.push_back(m.phases[p].name);
  input.mu_of_nodes = coefficient_of_nodes(m.node_friction, moduli_of_nodes(m));
  if (parameters.static_contact.empty())
    return input;
  input.static_pressures =
    read_static_pressures(parameters.static_contact, input.phase_names, m.rve_digest);
  const RunSummary static_contact(section + "Static contact", parameters.static_contact);
  const auto pressure = Hdf5File::open(static_contact.file("dynamics.h5"))
                          .read<double>("/static_contact/pressure", {any_extent},
                                        "run the static contact analysis again");
  if (pressure.size() == m.node_friction.size())
    input.static_mu_of_nodes = coefficient_of_nodes(m.node_friction, pressure);
  return input;
}
} // namespace mesoslip
