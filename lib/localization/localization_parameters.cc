#include "localization/localization_parameters.h"

#include "base/errors.h"
#include "base/files.h"
#include "parameters/keys.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
void bind_input(Keys &keys, LocalizationParameters &p)
{
  const auto section = keys.section("Input");
  keys.bind_input("RVE file", p.rve_file,
                  "Path of the rve.h5 of rve_homogenization, with concentration tensors");
  keys.bind_input(
    "Homogeneous run", p.homogeneous_run,
    "Path of the dynamics.h5 of contact_dynamics with the homogenized body, "
    "whose strains are localized");
  keys.bind_input("Direct run", p.direct_run,
                  "Path of the dynamics.h5 of the same run with the heterogeneous body, "
                  "with whose stresses the localized ones are compared; empty: no "
                  "comparison");
  keys.bind("Allow different loads", p.allow_different_loads,
            "Compare with a direct run under other loads, supports or friction "
            "coefficients as well; the difference is then not the error of localization");
}

void bind_localization(Keys &keys, LocalizationParameters &p)
{
  const auto section                   = keys.section("Localization");
  const std::vector<std::string> names = {"mean von Mises", "mean stress",
                                          "deviation of stress"};
  std::vector<std::string> fields      = names;
  std::string variant                  = "local strain";
  keys.bind(
    "Concentration", p.concentration, {"KUBC", "PBC", "MUBC"},
    "Boundary conditions of the homogenization whose strain concentration tensors L "
    "are used: local strain = L : macroscopic strain");
  keys.bind(
    "Temperature change", p.heating, Range::any(),
    "Change of temperature since the phases were free of stress, at which the body "
    "could expand freely before it slides: the stresses that it leaves in the phases "
    "are added. Needs a Thermal expansion of phases in the RVE file [K]");
  keys.bind("Variant", variant, {"local strain", "mean strain", "both"},
            "Macroscopic strain that L is applied to: that of the homogeneous run at the "
            "place (eq. 24), its mean over the body (eq. 23), or both in turn");
  keys.bind_list(
    "Fields", fields, names,
    "Statistics over time of the stress of each cell: mean von Mises stress, "
    "mean and standard deviation of the components; empty: none");
  keys.bind_list(
    "Out-of-plane ratio", p.out_of_plane_ratio, Range::closed(-100., 100.),
    "sigma_zz / (sigma_xx + sigma_yy) of each phase (or one for all) in the von "
    "Mises stress; empty: Poisson's ratio of the isotropic solid closest to "
    "the phase, exact for isotropic phases in plane strain; 0: plane stress [-]",
    0, std::numeric_limits<std::size_t>::max());
  const auto wanted = [&fields](const std::string &name) {
    return std::find(fields.begin(), fields.end(), name) != fields.end();
  };
  p.local_strain = variant != "mean strain";
  p.mean_strain  = variant != "local strain";
  p.fields       = {wanted(names[0]), wanted(names[1]), wanted(names[2])};
}

void bind_position(Keys &keys, std::vector<double> &position)
{
  keys.bind_list("Position", position, Range::any(),
                 "x, y and in three dimensions z: on a grid from the lower left corner, "
                 "on a mesh in its coordinates; has to be given [m]",
                 0, 3);
  keys.require(position.size() > 1, "Position",
               "a number is missing; give x, y and in three dimensions z in m, in a "
               "subsection of that name");
}

void bind_probes(Keys &keys, LocalizationParameters &p)
{
  const auto section = keys.section("Probes");
  std::vector<std::string> names;
  keys.bind_list("Of the run", p.run_probes, {},
                 "Probes of the homogeneous run whose stress is localized: all, or their "
                 "names; empty: none");
  keys.bind_names("Further", names, "probe",
                  "Names of further probes, each with a subsection of that name; their "
                  "strain is that of their cells in the snapshots");
  for (const std::string &name : names)
    {
      const auto probe = keys.section(name);
      p.further_probes.push_back({name, {}});
      bind_position(keys, p.further_probes.back().position);
    }
}

void bind_points(Keys &keys, LocalizationParameters &p)
{
  const auto section = keys.section("Volume element");
  std::vector<std::string> names;
  keys.bind_names("Points", names, "point",
                  "Names of points of a body that is larger than the volume of the RVE "
                  "file, each with a subsection of that name: the strain of the "
                  "homogeneous run at the point gives the fields in the whole volume");
  for (const std::string &name : names)
    {
      const auto point = keys.section(name);
      p.points.push_back({name, {}});
      bind_position(keys, p.points.back().position);
    }
}

/** Checks the path in a key; a folder is replaced by the file @p name in it. */
void check_input(std::string &path,
                 const std::string &key,
                 const std::string &name,
                 const std::string &hint)
{
  if (path.empty())
    throw UserError("Input/" + key + " is empty; give a " + name + " (" + hint + ")");
  path = file_or_in_folder(path, name);
  require_readable_file("'Input/" + key + "': ", path, hint);
}
} // namespace

void LocalizationParameters::bind(Keys &keys)
{
  bind_input(keys, *this);
  bind_localization(keys, *this);
  {
    const auto section = keys.section("Window");
    keys.bind_or_auto(
      "From", from, Range::any(),
      "Time at which the averages begin; auto: when both runs are steady, as "
      "their dynamics.h5 tell [s]");
    keys.bind_or_auto("To", to, Range::any(),
                      "Time at which the averages end; auto: the end of the runs [s]");
  }
  bind_probes(keys, *this);
  bind_points(keys, *this);
  const auto section = keys.section("Comparison");
  keys.bind(
    "Surface depth", surface_depth, Range::non_negative(),
    "Distance from the contact up to which the centres of cells belong to the region "
    "surface; the other cells are the region bulk [m]");
  keys.bind(
    "Edge distance", edge_distance, Range::non_negative(),
    "Distance from the edges of the body up to which the centres of cells are left "
    "out of the region interior [m]");
}

// An empty Direct run or Fields switches off keys of an otherwise complete file, so these
// are no errors.
void LocalizationParameters::check_keys(const Keys &keys)
{
  const auto fields    = split_list(keys.value("Localization/Fields"));
  const bool von_mises = std::count(fields.begin(), fields.end(), "mean von Mises") > 0;
  keys.only_if(fields.empty() || von_mises, {"Localization/Out-of-plane ratio"},
               "the von Mises stress is not asked for",
               "add mean von Mises to Localization/Fields");
  keys.only_if(!keys.value("Input/Direct run").empty() ||
                 keys.is_typed("Input/Direct run"),
               {"Comparison/", "Input/Allow different loads"},
               "there is no direct run to compare with", "name one in Input/Direct run");
}

void LocalizationParameters::check()
{
  check_input(rve_file, "RVE file", "rve.h5", "run rve_homogenization first");
  check_input(homogeneous_run, "Homogeneous run", "dynamics.h5",
              "run contact_dynamics with the homogeneous body first");
  if (!direct_run.empty())
    check_input(
      direct_run, "Direct run", "dynamics.h5",
      "run contact_dynamics with the heterogeneous body first, or leave it empty");
  if (heating != 0. && !direct_run.empty())
    throw UserError(
      "Localization/Temperature change is " + to_text(heating) +
      ", but contact_dynamics knows no heat, so that stresses of the direct run "
      "have no thermal part; remove it or Input/Direct run");
  if (heating != 0. && !out_of_plane_ratio.empty())
    throw UserError(
      "Localization/Out-of-plane ratio and Temperature change are both given; "
      "stresses of heat are those of plane strain, whose sigma_zz is known: "
      "remove the ratio");
  if (from > to)
    throw UserError("Window/From: " + to_text(from) + " s lies after To, " + to_text(to) +
                    " s");
  if (!points.empty() && !fields.any())
    throw UserError("Localization/Fields is empty, but Volume element/Points asks for "
                    "the fields of the volume; name some");
  if (!fields.any() && run_probes.empty() && further_probes.empty())
    throw UserError(
      "Localization/Fields, Probes/Of the run and Probes/Further are all empty: "
      "nothing is asked for");
}
} // namespace mesoslip
