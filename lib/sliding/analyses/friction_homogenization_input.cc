#include "base/errors.h"
#include "base/files.h"
#include "exchange/dynamics_file.h"
#include "exchange/rve_file.h"
#include "io/drafts.h"
#include "material/engineering_constants.h"
#include "sliding/analyses/friction_homogenization.h"
#include "sliding/analyses/static_contact.h"

#include <filesystem>

namespace mesoslip
{
namespace
{
const std::string section = "Friction homogenization/";

/** A file in the folder stands for the folder, as elsewhere. */
std::string folder_of(const std::string &given)
{
  std::error_code ignored;
  return std::filesystem::is_regular_file(given, ignored)
           ? std::filesystem::path(given).parent_path().string()
           : given;
}

DynamicsFile open_dynamics(const RunSummary &summary)
{
  return DynamicsFile::open(summary.file("dynamics.h5"),
                            "a transient run of contact_dynamics writes it");
}

/** Adds to @p warnings if the file has changed. */
FrictionRun read_run(const RunSummary &summary,
                     const DynamicsFile &file,
                     std::vector<std::string> &warnings)
{
  summary.require_analysis("transient");
  const std::string why = summary.text("global_interface_friction_warning");
  FrictionRun run;
  run.folder           = summary.folder;
  const std::string mu = "global_interface_friction_coefficient";
  const auto mu_inter  = summary.find_number(mu);
  if (!mu_inter)
    throw UserError(
      summary.key + ": " + summary.file("summary.json") + " has no number " + mu + ": " +
      (why.empty() ? "the run has no steady part; give it a longer Time/End time" : why));
  run.mu_inter         = *mu_inter;
  run.contact_duration = if_positive(summary.find_number("mean_contact_duration"));
  run.duration_warning = summary.text("mean_contact_duration_warning");
  if (!file.conditions)
    throw UserError(file.path() +
                    " does not tell its loads and its friction law, as an earlier "
                    "version wrote it; run contact_dynamics again");
  run.conditions = *file.conditions;
  if (const auto law = run.conditions.find("coefficient_law");
      law != run.conditions.end())
    throw UserError(
      summary.key + ": " + run.folder + " was made with Friction/Coefficient law = '" +
      std::get<std::string>(law->second) +
      "', but eqs (13) and (17) are about constant coefficients; name a run "
      "with Coefficient law = constant");
  run.friction_coefficient = number_of(run.conditions, "friction_coefficient");
  run.regularization_time = if_positive(number_of(run.conditions, "regularization_time"));
  if (!file.change_note().empty())
    warnings.push_back(file.change_note());
  return run;
}

/** In what loads and supports of a state at rest differ from those of a run, which may move
 * the flat faster or slower, and begin as it likes. */
std::string differences_at_rest(RunConditions at_rest, RunConditions run)
{
  const auto velocity = number_of(at_rest, "velocity"),
             of_run   = number_of(run, "velocity");
  const bool one_way  = velocity && of_run && (*velocity < 0.) == (*of_run < 0.);
  for (RunConditions *of : {&at_rest, &run})
    for (const std::string name :
         {"analysis", "platen_mass", "hold_from", "pressure_history", "velocity_history",
          "pressure_ramp_time", "velocity_ramp_time", "initial_velocity_x",
          "initial_velocity_y", "velocity"})
      if (name != "velocity" || one_way)
        of->erase(name);
  return differences_text(condition_differences(at_rest, run), true);
}

FrictionRun read_homogeneous(const std::string &folder,
                             const FrictionRun &heterogeneous,
                             std::vector<std::string> &warnings)
{
  const RunSummary summary(section + "Homogeneous run", folder);
  const FrictionRun run = read_run(summary, open_dynamics(summary), warnings);
  if (const auto material = run.conditions.find("material");
      material != run.conditions.end() &&
      std::get<std::string>(material->second) == "heterogeneous")
    throw UserError(summary.key + ": the body of " + run.folder +
                    " is heterogeneous; name a run with Body/Material = homogeneous");
  const std::string loads = differences_text(
    condition_differences(run.conditions, heterogeneous.conditions), true);
  if (!loads.empty())
    throw UserError(section + "Homogeneous run: " + run.folder + " and " +
                    heterogeneous.folder + " were made under different conditions (" +
                    loads + "); run both under the same");
  return run;
}

void set_friction_coefficients(BodyDescription &body,
                               const FrictionRun &run,
                               const std::string &rve_file,
                               std::vector<std::string> &warnings)
{
  if (run.friction_coefficient)
    {
      for (Phase<2> &phase : body.phases)
        phase.friction_coefficient = *run.friction_coefficient;
      return;
    }
  if (rve_file.empty())
    throw UserError("Body/RVE file is empty, but " + run.folder +
                    " took its friction coefficients from the phases of one; name it");
  require_readable_file("Body/RVE file: ", rve_file, "run rve_homogenization first");
  const RveFile<2> rve(rve_file);
  if (rve.digest != body.rve_digest)
    throw UserError("Body/RVE file: " + rve_file + " is not the one that " + run.folder +
                    " was run with (digest " + rve.digest + ", there " + body.rve_digest +
                    "); name that one");
  if (rve.phases.size() != body.phases.size())
    throw UserError("Body/RVE file: " + rve_file + " has " +
                    std::to_string(rve.phases.size()) + " phases, but " + run.folder +
                    " was run with " + std::to_string(body.phases.size()) +
                    "; run contact_dynamics again");
  for (std::size_t p = 0; p < body.phases.size(); ++p)
    body.phases[p].friction_coefficient = rve.phases[p].friction_coefficient;
  if (!rve.change_note().empty())
    warnings.push_back(rve.change_note());
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
std::vector<double> moduli_of_nodes(const BodyDescription &body)
{
  const std::size_t n = body.grid.cells[0];
  std::vector<double> cells, nodes;
  for (std::size_t i = 0; i < n; ++i)
    cells.push_back(
      closest_isotropic<2>(body.phases[body.phase_of(i)].stiffness).young_modulus);
  for (std::size_t i = 0; i <= n; ++i)
    nodes.push_back(0.5 * (cells[i > 0 ? i - 1 : 0] + cells[i < n ? i : n - 1]));
  return nodes;
}

void read_static_contact(const std::string &folder,
                         const BodyDescription &body,
                         FrictionHomogenizationInput &input)
{
  const std::string key = section + "Static contact";
  const RunSummary summary(key, folder);
  summary.require_analysis("static contact");
  if (!body.rve_digest.empty() && summary.text("rve_digest") != body.rve_digest)
    throw UserError(
      key + ": " + folder +
      " is an analysis of another RVE file than the heterogeneous run's; run it "
      "again with the same Body/RVE file");
  for (const std::string &name : input.phase_names)
    {
      const auto found = summary.find_number(name, "phase_contact_pressures");
      if (!found)
        throw UserError(key + ": " + folder + " has no contact pressure of the phase " +
                        name + ", which is in contact in the heterogeneous run");
      input.static_pressures.push_back(*found);
    }
  const DynamicsFile file = open_dynamics(summary);
  if (file.conditions)
    if (const std::string loads =
          differences_at_rest(*file.conditions, input.heterogeneous.conditions);
        !loads.empty())
      input.warnings.push_back(
        key + ": " + folder + " and " + input.heterogeneous.folder +
        " were made under different conditions (" + loads +
        "), and the pressures of phases and nodes are those of the former");
  const auto pressure = file.read<double>("/static_contact/pressure", {any_extent},
                                          "run the static contact analysis again");
  if (pressure.size() == body.node_friction.size())
    input.static_mu_of_nodes = coefficient_of_nodes(body.node_friction, pressure);
  else
    input.warnings.push_back(
      key + ": " + folder + " has " + std::to_string(pressure.size()) +
      " contact nodes and " + input.heterogeneous.folder + " " +
      std::to_string(body.node_friction.size()) +
      ", so there is no estimate by the pressures of nodes; run both with the same "
      "Body/Cells");
}
} // namespace

RunSummary::RunSummary(const std::string &key, const std::string &given)
  : key(key)
  , folder(folder_of(given))
{
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw UserError(key + ": there is no folder " + folder +
                    "; run contact_dynamics first");
  const std::string name = file("summary.json");
  if (!std::filesystem::is_regular_file(name, ignored))
    throw UserError(
      key + ": " + folder +
      " holds no summary.json, so the run has not finished; run contact_dynamics");
  json = nlohmann::json::parse(read_file(name), nullptr, false);
  if (!json.is_object())
    throw UserError(key + ": " + name + " is no JSON object; run contact_dynamics again");
  if (json.value("draft", false) && !drafts_are_accepted())
    throw UserError(key + ": " + folder +
                    " holds drafts, in which nothing was computed; run contact_dynamics "
                    "without --try");
}

std::string RunSummary::file(const std::string &name) const
{
  return (std::filesystem::path(folder) / name).string();
}

std::string RunSummary::text(const std::string &name) const
{
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

void RunSummary::require_analysis(const std::string &analysis) const
{
  const std::string found = text("analysis");
  if (found != analysis)
    throw UserError(
      key + ": " + folder + " holds " +
      (found.empty() ? "no contact_dynamics run" : "the analysis '" + found + "'") +
      ", but '" + analysis + "' is needed");
}

std::optional<double> RunSummary::find_number(const std::string &name,
                                              const std::string &of) const
{
  const nlohmann::json object = of.empty() ? json : json.value(of, nlohmann::json());
  const auto found            = object.find(name);
  return found != object.end() && found->is_number()
           ? std::optional<double>(found->get<double>())
           : std::nullopt;
}

FrictionHomogenizationInput
read_friction_homogenization(const FrictionHomogenizationParameters &parameters,
                             const std::string &rve_file)
{
  if (parameters.heterogeneous_run.empty())
    throw UserError(section +
                    "Heterogeneous run is empty; name the output folder of a transient "
                    "run of the heterogeneous body");
  FrictionHomogenizationInput input;
  const RunSummary summary(section + "Heterogeneous run", parameters.heterogeneous_run);
  if (summary.find_number("dim").value_or(2.) != 2.)
    throw UserError(summary.key + ": " + summary.folder +
                    " is a run in 3D, but friction is homogenized of plane grids only");
  const DynamicsFile file = open_dynamics(summary);
  input.heterogeneous     = read_run(summary, file, input.warnings);
  if (!parameters.homogeneous_run.empty())
    input.homogeneous =
      read_homogeneous(parameters.homogeneous_run, input.heterogeneous, input.warnings);

  BodyDescription body = file.heterogeneous_body();
  set_friction_coefficients(body, input.heterogeneous, rve_file, input.warnings);
  const std::vector<double> of_surface = body.fractions(body.grid.cells[0]);
  input.surface                        = contact_phases<2>(body.phases, of_surface);
  input.volume = contact_phases<2>(body.phases, body.fractions(body.grid.n_cells()));
  for (std::size_t p = 0; p < body.phases.size(); ++p)
    if (of_surface[p] > 0.)
      input.phase_names.push_back(body.phases[p].name);
  input.mu_of_nodes = coefficient_of_nodes(body.node_friction, moduli_of_nodes(body));
  if (!parameters.static_contact.empty())
    read_static_contact(parameters.static_contact, body, input);
  return input;
}
} // namespace mesoslip
