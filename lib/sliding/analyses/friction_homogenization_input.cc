#include "base/errors.h"
#include "base/files.h"
#include "exchange/grid_file.h"
#include "material/plausibility.h"
#include "sliding/analyses/friction_homogenization.h"
#include "sliding/analyses/phases_of_contact.h"

#include <cmath>
#include <map>
#include <numeric>

namespace mesoslip
{
namespace
{
const std::string section = "Friction homogenization/";
const char again[]        = "run contact_dynamics again";

Hdf5File open_dynamics(const RunSummary &summary)
{
  Hdf5File file = Hdf5File::open(summary.file("dynamics.h5"),
                                 "a transient run of contact_dynamics writes it");
  check_dynamics_header(file, 0);
  return file;
}

/** Reads a run; adds to @p warnings if the file has changed. */
FrictionRun read_run(const RunSummary &summary,
                     const Hdf5File &file,
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
  run.mu_inter          = *mu_inter;
  run.contact_duration  = if_positive(summary.find_number("mean_contact_duration"));
  run.duration_warning  = summary.text("mean_contact_duration_warning");
  const auto conditions = read_run_conditions(file);
  if (!conditions)
    throw UserError(file.path() +
                    " does not tell its loads and its friction law, as an earlier "
                    "version wrote it; run contact_dynamics again");
  run.conditions = *conditions;
  if (const auto law = run.conditions.find("coefficient_law");
      law != run.conditions.end())
    throw UserError(
      summary.key + ": " + run.folder + " was made with Friction/Coefficient law = '" +
      std::get<std::string>(law->second) +
      "', but eqs (13) and (17) are about constant coefficients; name a run "
      "with Coefficient law = constant");
  run.friction_coefficient = number_of(run.conditions, "friction_coefficient");
  run.regularization_time = if_positive(number_of(run.conditions, "regularization_time"));
  if (const std::string note = file.change_note("contact_dynamics"); !note.empty())
    warnings.push_back(note);
  return run;
}

/** Differences of loads and supports between a state at rest and a run. Ignored: flat
 * speed, load histories and initial velocity. */
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

double contact_area(const Hdf5File &file)
{
  const auto areas = file.read<double>("/contact/area", {any_extent}, again);
  return std::accumulate(areas.begin(), areas.end(), 0.);
}

/** Checks that the homogeneous run has the body of the heterogeneous run with file @p of;
 * files may lack this information. */
void require_same_body(const RunSummary &summary,
                       const Hdf5File &file,
                       const Hdf5File &of)
{
  const std::string digest = body_rve_digest(file), of_other = body_rve_digest(of);
  if (!digest.empty() && !of_other.empty() && digest != of_other)
    throw UserError(
      summary.key + ": " + summary.folder +
      " is a run with another RVE file than the heterogeneous run's; run it "
      "again with the same Body/RVE file");
  const double area = contact_area(file), wanted = contact_area(of);
  const std::string unit = summary.find_number("dim") == 3. ? " m^2" : " m";
  if (!(std::fabs(area - wanted) <= 1e-6 * wanted))
    throw UserError(brief_text(6, summary.key, ": the contact in ", summary.folder,
                               " has ", area, unit, ", that of the heterogeneous run ",
                               wanted, unit, "; run both on bodies of the same size"));
}

FrictionRun read_homogeneous(const std::string &folder,
                             const FrictionRun &heterogeneous,
                             const Hdf5File &of_heterogeneous,
                             std::vector<std::string> &warnings)
{
  const RunSummary summary(section + "Homogeneous run", folder);
  const Hdf5File file   = open_dynamics(summary);
  const FrictionRun run = read_run(summary, file, warnings);
  if (file.exists("/contact/phases"))
    throw UserError(summary.key + ": the body of " + run.folder +
                    " is heterogeneous; name a run of a homogeneous one");
  require_same_body(summary, file, of_heterogeneous);
  const std::string loads = differences_text(
    condition_differences(run.conditions, heterogeneous.conditions), true);
  if (!loads.empty())
    throw UserError(section + "Homogeneous run: " + run.folder + " and " +
                    heterogeneous.folder + " were made under different conditions (" +
                    loads + "); run both under the same");
  return run;
}

/** Contact data for eqs (17) and (19). */
struct ContactNodes
{
  std::vector<double> area;        ///< tributary (m^2, in 2D m)
  std::vector<double> mu;          ///< coefficients of friction
  std::vector<unsigned int> point; ///< number in the mesh; empty on a plane grid
};

std::vector<unsigned int> points_of(const Hdf5File &file, const std::string &group)
{
  return file.exists(group + "/point")
           ? file.read<unsigned int>(group + "/point", {any_extent}, again)
           : std::vector<unsigned int>();
}

ContactNodes read_nodes(const Hdf5File &file, const std::size_t n)
{
  return {file.read<double>("/contact/area", {n}, again),
          file.read<double>("/contact/friction_coefficient", {n}, again),
          points_of(file, "/contact")};
}

/** Eq. (17) over contact nodes. */
double coefficient_of_nodes(const ContactNodes &nodes,
                            const std::vector<double> &pressure)
{
  double friction = 0., force = 0.;
  for (std::size_t i = 0; i < nodes.mu.size(); ++i)
    {
      const double f = nodes.area[i] * pressure[i];
      force += f;
      friction += f * nodes.mu[i];
    }
  return friction / force;
}

/** Eq. (19): the pressure of a node is proportional to the moduli of the phases around
 * it. */
std::vector<double> moduli_of_nodes(const PhasesOfContact &phases)
{
  std::vector<double> moduli(phases.share[0].size());
  for (std::size_t p = 0; p < phases.share.size(); ++p)
    for (std::size_t i = 0; i < moduli.size(); ++i)
      moduli[i] += phases.share[p][i] * phases.youngs_modulus[p];
  return moduli;
}

/** Share of each phase in the contact. */
std::vector<double> surface_fractions(const PhasesOfContact &phases,
                                      const std::vector<double> &area)
{
  const double total = std::accumulate(area.begin(), area.end(), 0.);
  std::vector<double> fractions;
  for (const std::vector<double> &share : phases.share)
    fractions.push_back(std::inner_product(share.begin(), share.end(), area.begin(), 0.) /
                        total);
  return fractions;
}

/** The phases with @p fractions as areas; phases without area are left out. */
std::vector<ContactPhase> with_areas(const PhasesOfContact &phases,
                                     const std::vector<double> &friction,
                                     const std::vector<double> &fractions)
{
  std::vector<ContactPhase> result;
  for (std::size_t p = 0; p < fractions.size(); ++p)
    if (fractions[p] > 0.)
      result.push_back({fractions[p], phases.youngs_modulus[p], friction[p]});
  return result;
}

/** Coefficient of each phase: its own, or else the coefficient of the @p run. */
std::vector<double> friction_of_phases(const PhasesOfContact &phases,
                                       const FrictionRun &run)
{
  if (!phases.friction.empty())
    return phases.friction;
  if (!run.friction_coefficient)
    throw UserError(run.folder + " does not tell its coefficient of friction; " + again);
  return std::vector<double>(phases.names.size(), *run.friction_coefficient);
}

/** Pressures at rest in the order of the @p nodes of the run; empty unless the nodes
 * agree. */
std::vector<double> pressures_at_rest(const Hdf5File &file, const ContactNodes &nodes)
{
  const auto pressure = file.read<double>("/static_contact/pressure", {any_extent},
                                          "run the static contact analysis again");
  const std::vector<unsigned int> point = points_of(file, "/static_contact");
  if (pressure.size() != nodes.mu.size() || point.size() != nodes.point.size())
    return {};
  if (point.empty())
    return pressure;
  std::map<unsigned int, double> at;
  for (std::size_t i = 0; i < point.size(); ++i)
    at[point[i]] = pressure[i];
  std::vector<double> in_order;
  for (const unsigned int p : nodes.point)
    if (const auto found = at.find(p); found != at.end())
      in_order.push_back(found->second);
  return in_order.size() == nodes.mu.size() ? in_order : std::vector<double>();
}

void read_static_contact(const std::string &folder,
                         const std::string &rve_digest,
                         const ContactNodes &nodes,
                         FrictionHomogenizationInput &input)
{
  const std::string key = section + "Static contact";
  const RunSummary summary(key, folder);
  summary.require_analysis("static contact");
  if (!rve_digest.empty() && summary.text("rve_digest") != rve_digest)
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
  const Hdf5File file = open_dynamics(summary);
  if (const auto conditions = read_run_conditions(file))
    if (const std::string loads =
          differences_at_rest(*conditions, input.heterogeneous.conditions);
        !loads.empty())
      input.warnings.push_back(
        key + ": " + folder + " and " + input.heterogeneous.folder +
        " were made under different conditions (" + loads +
        "), and the pressures of phases and nodes are those of the former");
  const std::vector<double> pressure = pressures_at_rest(file, nodes);
  if (!pressure.empty())
    input.static_mu_of_nodes = coefficient_of_nodes(nodes, pressure);
  else
    input.warnings.push_back(key + ": " + folder + " and " + input.heterogeneous.folder +
                             " have not the same contact nodes, so there is no estimate "
                             "by the pressures of nodes; run both on the same cells");
}
} // namespace

FrictionHomogenizationInput
read_friction_homogenization(const FrictionHomogenizationParameters &parameters)
{
  if (parameters.heterogeneous_run.empty())
    throw UserError(section +
                    "Heterogeneous run is empty; name the output folder of a transient "
                    "run of the heterogeneous body");
  FrictionHomogenizationInput input;
  const RunSummary summary(section + "Heterogeneous run", parameters.heterogeneous_run);
  const Hdf5File file = open_dynamics(summary);
  input.heterogeneous = read_run(summary, file, input.warnings);
  if (!parameters.homogeneous_run.empty())
    input.homogeneous = read_homogeneous(parameters.homogeneous_run, input.heterogeneous,
                                         file, input.warnings);

  const PhasesOfContact phases         = read_phases_of_contact(file);
  const ContactNodes nodes             = read_nodes(file, phases.share[0].size());
  const std::vector<double> friction   = friction_of_phases(phases, input.heterogeneous);
  const std::vector<double> of_surface = surface_fractions(phases, nodes.area);
  input.surface                        = with_areas(phases, friction, of_surface);
  input.volume = with_areas(phases, friction, phases.volume_fraction);
  for (std::size_t p = 0; p < of_surface.size(); ++p)
    if (of_surface[p] > 0.)
      input.phase_names.push_back(phases.names[p]);
  input.mu_of_nodes = coefficient_of_nodes(nodes, moduli_of_nodes(phases));
  if (!parameters.static_contact.empty())
    read_static_contact(parameters.static_contact, body_rve_digest(file), nodes, input);
  return input;
}
} // namespace mesoslip
