#include "localization/localization_parameters.h"

#include "io/errors.h"
#include "io/key_use.h"
#include "io/parameters.h"
#include "io/raw_parameters.h"

#include <algorithm>
#include <filesystem>

namespace mesoslip
{
namespace
{
using Handler = dealii::ParameterHandler;

void declare_input(Handler &prm)
{
  const ParameterSection section(prm, "Input");
  declare_input_file(prm, "RVE file", "", "rve.h5 of rve_homogenization");
  declare_input_file(prm, "Homogeneous run", "",
                     "dynamics.h5 of contact_dynamics with the homogenized body");
  declare_input_file(
    prm, "Direct run", "",
    "dynamics.h5 of the same run with the heterogeneous body, to compare "
    "with; empty: no comparison");
  declare_bool(
    prm, "Allow different loads", false,
    "Compare with a direct run under other loads, supports or friction "
    "coefficients as well; the difference is then not the error of localization");
}

void declare_localization(Handler &prm)
{
  const ParameterSection section(prm, "Localization");
  declare_selection(prm, "Concentration", "KUBC", {"KUBC", "PBC"},
                    "Boundary conditions of the concentration tensors L");
  declare_selection(prm, "Variant", "local strain",
                    {"local strain", "mean strain", "both"},
                    "L is applied to the homogeneous run's strain at the place (eq. 24), "
                    "its mean over the body (eq. 23), or both in turn");
  declare_word_list(prm, "Fields",
                    {"mean von Mises", "mean stress", "deviation of stress"},
                    {"mean von Mises", "mean stress", "deviation of stress"},
                    "Statistics over time for each cell; empty: none");
  declare_double_list(
    prm, "Out-of-plane ratio", {}, Range::closed(-100., 100.),
    "sigma_zz / (sigma_xx + sigma_yy) of each phase (or one for all) in the von "
    "Mises stress; empty: Poisson's ratio of the isotropic solid closest to "
    "the phase, exact for isotropic phases in plane strain; 0: plane stress [-]");
}

void declare_window(Handler &prm)
{
  const ParameterSection section(prm, "Window");
  declare_double_or_auto(
    prm, "From", "auto", Range::any(),
    "Begin of the averages; auto: from when on the runs are steady, as "
    "their dynamics.h5 tell (the later one) [s]");
  declare_double_or_auto(prm, "To", "auto", Range::any(),
                         "End of the averages; auto: the end of the runs [s]");
}

void declare_probes(Handler &prm, const RawParameters &raw)
{
  const ParameterSection section(prm, "Probes");
  declare_word_list(
    prm, "Of the run", {"all"}, {},
    "Which probes of the homogeneous run: all, their names, or empty: none");
  declare_word_list(prm, "Further", {}, {},
                    "Names of further probes, each with a subsection; they are followed "
                    "through the snapshots");
  for (const std::string &name : raw.section_names("Probes/Further", {}, "probe"))
    {
      const ParameterSection probe(prm, name);
      declare_double_list(prm, "Position", {0., 0.}, Range::non_negative(),
                          "x and y from the lower left corner [m]", 2, 2);
    }
}

void declare_comparison(Handler &prm)
{
  const ParameterSection section(prm, "Comparison");
  declare_double(prm, "Surface depth", 0.4e-3, Range::non_negative(),
                 "Cells whose centres are nearer to the contact are the surface, the "
                 "others the bulk [m]");
  declare_double(
    prm, "Edge distance", 1.6e-3, Range::non_negative(),
    "Cells nearer to an edge are left out in the errors of the interior [m]");
}

/** The path in a key; for a folder, that of the file @p name in it. */
std::string input_path(Handler &prm,
                       const std::string &key,
                       const std::string &name,
                       const std::string &hint)
{
  std::string path = get_string(prm, key);
  if (path.empty())
    throw UserError("Input/" + key + " is empty; give a " + name + " (" + hint + ")");
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    path = (std::filesystem::path(path) / name).string();
  require_input_file("'Input/" + key + "': ", path, hint);
  return path;
}

void parse_input(Handler &prm, LocalizationParameters &p)
{
  const ParameterSection section(prm, "Input");
  p.rve_file = input_path(prm, "RVE file", "rve.h5", "run rve_homogenization first");
  p.homogeneous_run = input_path(prm, "Homogeneous run", "dynamics.h5",
                                 "run contact_dynamics with the homogeneous body first");
  if (!get_string(prm, "Direct run").empty())
    p.direct_run = input_path(
      prm, "Direct run", "dynamics.h5",
      "run contact_dynamics with the heterogeneous body first, or leave it empty");
  p.allow_different_loads = get_bool(prm, "Allow different loads");
}

void parse_localization(Handler &prm, LocalizationParameters &p)
{
  const ParameterSection section(prm, "Localization");
  p.concentration           = get_string(prm, "Concentration");
  const std::string variant = get_string(prm, "Variant");
  p.local_strain            = variant != "mean strain";
  p.mean_strain             = variant != "local strain";
  const auto fields         = get_word_list(prm, "Fields");
  const auto wanted         = [&fields](const char *name) {
    return std::find(fields.begin(), fields.end(), name) != fields.end();
  };
  p.fields.von_mises   = wanted("mean von Mises");
  p.fields.mean        = wanted("mean stress");
  p.fields.deviation   = wanted("deviation of stress");
  p.out_of_plane_ratio = get_double_list(prm, "Out-of-plane ratio");
}

void parse_probes(Handler &prm, LocalizationParameters &p)
{
  const ParameterSection section(prm, "Probes");
  p.run_probes     = get_word_list(prm, "Of the run");
  p.all_run_probes = p.run_probes == std::vector<std::string>{"all"};
  for (const std::string &name : get_word_list(prm, "Further"))
    {
      const ParameterSection probe(prm, name);
      const auto position = get_double_list(prm, "Position");
      for (const ProbeRequest &other : p.further_probes)
        if (other.name == name)
          throw UserError("Probes/Further names '" + name + "' twice");
      p.further_probes.push_back({name, {{position[0], position[1]}}});
    }
}
} // namespace

void LocalizationParameters::declare(dealii::ParameterHandler &prm,
                                     const RawParameters &raw)
{
  declare_input(prm);
  declare_localization(prm);
  declare_window(prm);
  declare_probes(prm, raw);
  declare_comparison(prm);
}

// Direct run = and Fields = switch off what an otherwise complete file asks for.
void LocalizationParameters::check_keys(const KeyUse &use)
{
  const auto fields    = split_list(use.value("Localization/Fields"));
  const bool von_mises = std::count(fields.begin(), fields.end(), "mean von Mises") > 0;
  use.only_if(fields.empty() || von_mises, {"Localization/Out-of-plane ratio"},
              "the von Mises stress is not asked for",
              "add mean von Mises to Localization/Fields");
  use.only_if(!use.value("Input/Direct run").empty() || use.is_typed("Input/Direct run"),
              {"Comparison/", "Input/Allow different loads"},
              "there is no direct run to compare with", "name one in Input/Direct run");
}

LocalizationParameters LocalizationParameters::parse(dealii::ParameterHandler &prm)
{
  LocalizationParameters p;
  parse_input(prm, p);
  parse_localization(prm, p);
  {
    const ParameterSection section(prm, "Window");
    p.from = get_double_or_auto(prm, "From");
    p.to   = get_double_or_auto(prm, "To");
    if (p.from > p.to)
      throw UserError("Window/From: " + to_text(p.from) + " s lies after To, " +
                      to_text(p.to) + " s");
  }
  parse_probes(prm, p);
  if (!p.fields.any() && p.run_probes.empty() && p.further_probes.empty())
    throw UserError(
      "Localization/Fields, Probes/Of the run and Probes/Further are all empty: "
      "nothing is asked for");
  const ParameterSection section(prm, "Comparison");
  p.surface_depth = get_double(prm, "Surface depth");
  p.edge_distance = get_double(prm, "Edge distance");
  return p;
}
} // namespace mesoslip
