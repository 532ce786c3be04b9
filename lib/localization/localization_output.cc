#include "localization/localization_output.h"

#include "base/digest.h"
#include "exchange/datasets.h"
#include "io/json.h"
#include "io/table.h"
#include "parameters/parameters.h"

#include <cmath>

namespace mesoslip
{
namespace
{
using json = nlohmann::json;

const char *const component_names[] = {"sigma_xx", "sigma_yy", "sigma_xy"};

/** A number that compares the series of a probe, in summary.json and in probes.csv. */
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

const std::string &phase_name(const LocalizationInput &input, const PlannedProbe &probe)
{
  return input.rve.phases[input.phase_id[probe.cell_number]].name;
}

/** localization.h5, and what of it ParaView is to show. */
struct Writer
{
  const LocalizationInput &input;
  Hdf5File file;
  std::vector<XdmfField> shown = {};

  /** @p group is "" or "/direct". */
  void write_fields(const StressFields &fields, const std::string &group)
  {
    for (const StressField &field : stress_fields())
      if (!(fields.*field.values).empty())
        write_field(group + "/" + field.name, fields.*field.values,
                    field.quantities.size());
  }

  void write_variant(const VariantResult &variant, const std::string &group)
  {
    write_fields(variant.fields, group);
    write_fields(variant.difference, group + "/difference");
    for (std::size_t k = 0; k < variant.probes.size(); ++k)
      write_probe(input.probes[k], variant.probes[k],
                  group + "/probes/" + input.probes[k].name);
  }

  void write_field(const std::string &name,
                   const std::vector<double> &values,
                   const std::size_t components)
  {
    Shape shape = {input.rve.grid.cells[1], input.rve.grid.cells[0]};
    XdmfField field;
    field.name    = name.substr(1);
    field.file    = "localization.h5";
    field.dataset = name;
    field.centre  = XdmfField::Centre::cell;
    if (components == 3)
      {
        shape.push_back(components);
        field.components      = 3;
        field.component_names = {"xx", "yy", "xy"};
      }
    write_dataset(file, name, shape, values, "Pa");
    shown.push_back(field);
  }

  void write_probe(const PlannedProbe &probe,
                   const ProbeResult &result,
                   const std::string &group)
  {
    write_series(file, group,
                 {{"time", "s", &result.time}, {"stress", "Pa", &result.stress, 3}});
    if (!result.direct_stress.empty())
      write_series(file, group, {{"direct_stress", "Pa", &result.direct_stress, 3}});
    file.write_attribute(group, "position",
                         std::vector(probe.position.begin(), probe.position.end()));
    file.write_attribute(group, "cell",
                         std::vector(probe.cell.begin(), probe.cell.end()));
    file.write_attribute<unsigned int>(group, "phase", input.phase_id[probe.cell_number]);
    file.write_attribute(group, "phase_name", phase_name(input, probe));
  }
};

std::string digest_of(const LocalizationInput &input, const std::string &parameters)
{
  Digest digest;
  digest.add(input.rve.digest).add(input.homogeneous.digest);
  digest.add(input.direct ? input.direct->digest : "");
  return digest.add(parameters).hex();
}

void write_probe_table(const LocalizationInput &input,
                       const LocalizationResult &result,
                       const std::string &path)
{
  std::vector<std::string> headings = {"variant", "probe", "x [m]",
                                       "y [m]",   "phase", "component"};
  for (const Comparison &comparison : comparisons)
    headings.emplace_back(comparison.heading);
  TableWriter table(path, headings);
  for (const VariantResult &variant : result.variants)
    for (std::size_t k = 0; k < variant.probes.size(); ++k)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const PlannedProbe &probe    = input.probes[k];
          std::vector<std::string> row = {variant.name,
                                          probe.name,
                                          to_text(probe.position[0]),
                                          to_text(probe.position[1]),
                                          phase_name(input, probe),
                                          component_names[c]};
          for (const Comparison &comparison : comparisons)
            row.push_back(table.cell(variant.probes[k].statistics[c].*comparison.value));
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
json differences_json(const LocalizationInput &input)
{
  json list = json::array();
  for (const ConditionDifference &d : input.differences)
    list.push_back({{"condition", d.name},
                    {"homogeneous", d.first},
                    {"direct", d.second},
                    {"of_load", d.of_load}});
  return list;
}

json probe_json(const LocalizationInput &input,
                const PlannedProbe &probe,
                const ProbeResult &result)
{
  json entry = {{"name", probe.name},
                {"x", probe.position[0]},
                {"y", probe.position[1]},
                {"phase", phase_name(input, probe)},
                {"samples", result.time.size()}};
  for (unsigned int c = 0; c < 3; ++c)
    for (const Comparison &comparison : comparisons)
      entry[component_names[c]][comparison.name] =
        number_or_null(result.statistics[c].*comparison.value);
  return entry;
}

/** {probes, field_errors {quantity {region: relative L2}}} of a variant. */
json variant_json(const LocalizationInput &input, const VariantResult &variant)
{
  json entry = {{"probes", json::array()}, {"field_errors", nullptr}};
  for (std::size_t k = 0; k < variant.probes.size(); ++k)
    entry["probes"].push_back(probe_json(input, input.probes[k], variant.probes[k]));
  for (const FieldError &error : variant.errors)
    entry["field_errors"][error.quantity][error.region] = number_or_null(error.relative);
  return entry;
}
} // namespace

void write_localization(const LocalizationInput &input,
                        const LocalizationResult &result,
                        const std::string &parameters,
                        const std::string &folder)
{
  Writer writer  = {input, Hdf5File::create(folder + "/localization.h5")};
  Hdf5File &file = writer.file;
  file.write_header("mesoslip-localization", 1, 2, digest_of(input, parameters));
  file.write_attribute("/", "concentration", input.parameters.concentration);
  file.write_attribute("/", "variant", result.variants[0].name);
  write_grid(file, input.rve.grid);
  if (std::isfinite(result.window.begin))
    file.write_attribute("/", "window",
                         std::vector<double>{result.window.begin, result.window.end});
  writer.write_variant(result.variants[0], "");
  writer.write_fields(result.direct, "/direct");
  if (result.variants.size() > 1)
    writer.write_variant(result.variants[1], "/mean_strain_variant");
  file.close();
  if (!writer.shown.empty())
    write_xdmf(folder + "/localization.xdmf", xdmf_grid(input.rve.grid), writer.shown);
  write_probe_table(input, result, folder + "/probes.csv");
  if (!result.variants[0].errors.empty())
    write_error_table(result, folder + "/field_errors.csv");
}

void summarize_localization(const LocalizationInput &input,
                            const LocalizationResult &result,
                            json &summary)
{
  summary["dim"]    = 2;
  summary["cells"]  = input.rve.grid.n_cells();
  summary["dofs"]   = 2 * input.homogeneous.grid.n_nodes();
  summary["phases"] = json::array();
  for (const Phase<2> &phase : input.rve.phases)
    summary["phases"].push_back(phase.name);
  summary["variant"]                 = result.variants[0].name;
  summary["concentration"]           = input.parameters.concentration;
  summary["window"]                  = {number_or_null(result.window.begin),
                                        number_or_null(result.window.end)};
  summary["snapshots"]               = input.snapshots.count;
  summary["direct_snapshots"]        = input.direct_snapshots.count;
  summary["differences_of_the_runs"] = differences_json(input);
  summary.update(variant_json(input, result.variants[0]));
  if (result.variants.size() > 1)
    summary["mean_strain_variant"] = variant_json(input, result.variants[1]);
}
} // namespace mesoslip
