#include "base/exchange.h"
#include "io/json.h"
#include "io/table.h"
#include "localization/localization_program.h"
#include "parameters/parameters.h"
#include "program/run_context.h"

#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

namespace mesoslip
{
namespace
{
using json = nlohmann::json;

std::vector<std::string> stress_names(const unsigned int dim)
{
  std::vector<std::string> names;
  for (unsigned int c = 0; c < dim * (dim + 1) / 2; ++c)
    names.push_back(std::string("sigma_") +
                    (dim == 2 ? voigt_names<2>[c] : voigt_names<3>[c]));
  return names;
}

/** A comparison result of a probe series, in summary.json and probes.csv. */
struct Comparison
{
  const char *name, *heading;
  double ComponentStatistics::*value;
};

const Comparison comparisons[] = {
  {"mean", "mean [Pa]", &ComponentStatistics::mean},
  {"std", "standard deviation [Pa]", &ComponentStatistics::deviation},
  {"direct_mean", "direct mean [Pa]", &ComponentStatistics::direct_mean},
  {"direct_std", "direct standard deviation [Pa]",
   &ComponentStatistics::direct_deviation},
  {"error_mean", "error of mean [-]", &ComponentStatistics::error_mean},
  {"error_std", "error of standard deviation [-]", &ComponentStatistics::error_deviation},
  {"rms_difference", "rms difference [-]", &ComponentStatistics::rms_difference}};

/** Fields that are written together. */
struct FieldGroup
{
  std::string name;           ///< group in localization.h5
  const StressFields *fields; ///< fields of this rank
};

/** Groups of fields, with the same order on all ranks. */
std::vector<FieldGroup> field_groups(const LocalizationResult &result)
{
  std::vector<FieldGroup> groups;
  for (std::size_t v = 0; v < result.variants.size(); ++v)
    {
      const std::string name = v == 0 ? "" : "/mean_strain_variant";
      groups.push_back({name, &result.variants[v].fields});
      if (result.is_compared)
        groups.push_back({name + "/difference", &result.variants[v].difference});
      if (v == 0 && result.is_compared)
        groups.push_back({"/direct", &result.direct});
    }
  for (const PointResult &point : result.points)
    groups.push_back({"/points/" + point.name, &point.fields});
  return groups;
}

/** Writes all data except the numbers of the fields. */
void write_frame(LocalizationFile &file,
                 const LocalizationOrigin &origin,
                 const LocalizationResult &result)
{
  file.write_attribute("/", "concentration", origin.concentration);
  file.write_attribute("/", "temperature_change", origin.heating);
  if (std::isfinite(result.window.begin))
    file.write_attribute("/", "window",
                         std::array<double, 2>{{result.window.begin, result.window.end}});
  if (!result.variants.empty())
    file.write_attribute("/", "variant", result.variants[0].name);
  for (const PointResult &point : result.points)
    file.write_attribute("/points/" + point.name, "position", point.position);
  for (const FieldGroup &group : field_groups(result))
    file.reserve_fields(result.fields, group.name);
  for (std::size_t v = 0; v < result.variants.size(); ++v)
    for (const ProbeResult &probe : result.variants[v].probes)
      file.write_probe(probe, v == 0 ? "" : "/mean_strain_variant");
}

void write_probe_table(const unsigned int dim,
                       const LocalizationResult &result,
                       const std::string &path)
{
  std::vector<std::string> headings = {"variant", "probe", "x [m]", "y [m]"};
  if (dim == 3)
    headings.emplace_back("z [m]");
  headings.insert(headings.end(), {"phase", "component"});
  for (const Comparison &comparison : comparisons)
    headings.emplace_back(comparison.heading);
  TableWriter table(path, headings);
  for (const VariantResult &variant : result.variants)
    for (const ProbeResult &probe : variant.probes)
      for (unsigned int c = 0; c < probe.statistics.size(); ++c)
        {
          std::vector<std::string> row = {variant.name, probe.name};
          for (const double x : probe.position)
            row.push_back(to_text(x));
          row.insert(row.end(), {probe.phase_name, stress_names(dim)[c]});
          for (const Comparison &comparison : comparisons)
            row.push_back(table.cell(probe.statistics[c].*comparison.value));
          table.add_row(row);
        }
  table.flush();
}

void write_error_table(const LocalizationResult &result, const std::string &path)
{
  TableWriter table(path, {"variant", "quantity", "region", "cells [-]", "rms [Pa]",
                           "direct rms [Pa]", "relative L2 difference [-]"});
  for (const VariantResult &variant : result.variants)
    for (const FieldError &error : variant.errors)
      table.add_row(std::vector<std::string>{
        variant.name, error.quantity, error.region, std::to_string(error.n_cells),
        table.cell(error.rms), table.cell(error.direct_rms), table.cell(error.relative)});
  table.flush();
}

/** [{condition, homogeneous, direct, of_load}] */
json differences_json(const LocalizationOrigin &origin)
{
  json list = json::array();
  for (const ConditionDifference &d : origin.differences)
    list.push_back({{"condition", d.name},
                    {"homogeneous", d.first},
                    {"direct", d.second},
                    {"of_load", d.of_load}});
  return list;
}

json probe_json(const ProbeResult &probe)
{
  const auto dim = static_cast<unsigned int>(probe.position.size());
  json entry     = {{"name", probe.name},
                    {"x", probe.position[0]},
                    {"y", probe.position[1]},
                    {"phase", probe.phase_name},
                    {"samples", probe.time.size()}};
  if (dim == 3)
    entry["z"] = probe.position[2];
  for (unsigned int c = 0; c < probe.statistics.size(); ++c)
    for (const Comparison &comparison : comparisons)
      entry[stress_names(dim)[c]][comparison.name] =
        number_or_null(probe.statistics[c].*comparison.value);
  return entry;
}

/** {probes, field_errors {quantity {region: relative L2}}} of a variant. */
json variant_json(const VariantResult &variant)
{
  json entry = {{"probes", json::array()}, {"field_errors", nullptr}};
  for (const ProbeResult &probe : variant.probes)
    entry["probes"].push_back(probe_json(probe));
  for (const FieldError &error : variant.errors)
    entry["field_errors"][error.quantity][error.region] = number_or_null(error.relative);
  return entry;
}
} // namespace

template <int dim>
LocalizationOrigin origin_of(const LocalizationInput<dim> &input)
{
  const LocalizationFiles<dim> &files = input.files;
  LocalizationOrigin origin;
  origin.dim = dim;
  origin.digest.add(files.rve.digest)
    .add(files.homogeneous.digest)
    .add(files.direct ? files.direct->digest : "");
  origin.n_cells          = input.volume.n_cells();
  origin.n_dofs           = dim * input.body.n_points();
  origin.phases           = files.phase_names();
  origin.concentration    = input.parameters.concentration;
  origin.heating          = input.parameters.heating;
  origin.snapshots        = input.plan.snapshots.count;
  origin.direct_snapshots = input.plan.direct_snapshots.count;
  origin.differences      = input.differences;
  origin.create_file      = [&volume = input.volume](const std::string &path,
                                                const std::string &digest) {
    return volume.is_grid ? LocalizationFile::create(path, digest, volume.grid)
                               : LocalizationFile::create(path, digest, volume.mesh);
  };
  return origin;
}

template LocalizationOrigin origin_of(const LocalizationInput<2> &);
template LocalizationOrigin origin_of(const LocalizationInput<3> &);

void write_localization(const LocalizationOrigin &origin,
                        const LocalizationResult &result,
                        const std::string &parameters,
                        const std::string &folder)
{
  const std::string path = folder + "/localization.h5";
  std::optional<LocalizationFile> file;
  on_root(result.communicator, [&]() {
    file.emplace(origin.create_file(path, Digest(origin.digest).add(parameters).hex()));
    write_frame(*file, origin, result);
    file->leave();
  });
  for (const FieldGroup &group : field_groups(result))
    write_fields(path, origin.dim, result.fields, *group.fields, group.name,
                 result.first_row, result.communicator);
  on_root(result.communicator, [&]() {
    file->complete();
    write_probe_table(origin.dim, result, folder + "/probes.csv");
    if (!result.variants.empty() && !result.variants[0].errors.empty())
      write_error_table(result, folder + "/field_errors.csv");
  });
}

void summarize_localization(const LocalizationOrigin &origin,
                            const LocalizationResult &result,
                            json &summary)
{
  summary["dim"]                     = origin.dim;
  summary["cells"]                   = origin.n_cells;
  summary["dofs"]                    = origin.n_dofs;
  summary["phases"]                  = origin.phases;
  summary["concentration"]           = origin.concentration;
  summary["temperature_change"]      = origin.heating;
  summary["window"]                  = {number_or_null(result.window.begin),
                                        number_or_null(result.window.end)};
  summary["snapshots"]               = origin.snapshots;
  summary["direct_snapshots"]        = origin.direct_snapshots;
  summary["differences_of_the_runs"] = differences_json(origin);
  summary["field_errors"]            = nullptr;
  if (!result.variants.empty())
    {
      summary["variant"] = result.variants[0].name;
      summary.update(variant_json(result.variants[0]));
    }
  if (result.variants.size() > 1)
    summary["mean_strain_variant"] = variant_json(result.variants[1]);
  for (const PointResult &point : result.points)
    summary["points"].push_back({{"name", point.name}, {"position", point.position}});
}

namespace
{
/** "surface 5 % (without its ends 3 %)": the error of a region and of its part away from the
 * sides, "" without a number. */
std::string error_words(const json &errors,
                        const std::string &region,
                        const std::string &inner,
                        const char *what)
{
  const auto percent = [&](const std::string &name) -> std::string {
    const auto error = errors.find(name);
    if (error == errors.end() || !error->is_number())
      return "";
    std::ostringstream text;
    text << std::setprecision(3) << 100. * error->get<double>() << " %";
    return text.str();
  };
  const std::string whole = percent(region), part = percent(inner);
  if (whole.empty())
    return "";
  return region + ' ' + whole +
         (part.empty() ? "" : std::string(" (") + what + ' ' + part + ')');
}
} // namespace

void log_key_numbers(RunContext &context)
{
  const json &summary = context.summary();
  if (!summary.contains("field_errors"))
    return;
  // Along the normal of the flat, which in 3D is z.
  const bool is_solid = summary["field_errors"].contains("mean_sigma_zz");
  for (const char *quantity :
       {"mean_von_mises", is_solid ? "mean_sigma_zz" : "mean_sigma_yy"})
    {
      const auto field = summary["field_errors"].find(quantity);
      if (field == summary["field_errors"].end())
        continue;
      // Free sides may affect the grains that they cut; regions away from sides show the
      // rest.
      std::vector<std::string> regions = {
        error_words(*field, "interior", "", ""),
        error_words(*field, "surface", "surface_inner", "without its ends")};
      for (const std::string phase : summary["phases"])
        regions.push_back(error_words(*field, phase, phase + "_interior", "interior"));
      std::string line;
      for (const std::string &region : regions)
        if (!region.empty())
          line += (line.empty() ? " " : ", ") + region;
      context.log(std::string(quantity) +
                  " against the direct run (relative L2):" + line);
    }
  const json &errors = summary["field_errors"];
  if (errors.contains("mean_von_mises") &&
      error_words(errors["mean_von_mises"], "interior", "", "").empty())
    context.warn("no cell is Comparison/Edge distance away from all edges, so that there "
                 "is no error of the interior; set about the size of a grain, in m");
}
} // namespace mesoslip
