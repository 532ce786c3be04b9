#include "localization/localization_output.h"

#include "base/digest.h"
#include "exchange/rve_file.h"
#include "io/hdf5_file.h"
#include "io/json.h"
#include "io/table.h"
#include "io/xdmf.h"
#include "parameters/parameters.h"

#include <cmath>

namespace mesoslip
{
namespace
{
using json = nlohmann::json;

const char *const component_names[] = {"sigma_xx", "sigma_yy", "sigma_xy"};

/** localization.h5, and what of it ParaView is to show. */
class Writer
{
public:
  Writer(const LocalizationResult &localized, Hdf5File &target)
    : result(localized)
    , file(target)
  {
  }

  /** @p group is "" or "/direct". */
  void write_fields(const StressFields &fields, const std::string &group)
  {
    write_field(group + "/mean_von_mises", fields.mean_von_mises, 0);
    write_field(group + "/mean_stress", fields.mean_stress, 3);
    write_field(group + "/deviation_stress", fields.deviation_stress, 3);
  }

  void write_variant(const VariantResult &variant, const std::string &group)
  {
    write_fields(variant.fields, group);
    write_fields(variant.difference, group + "/difference");
    for (const ProbeResult &probe : variant.probes)
      write_probe(probe, group + "/probes/" + probe.name);
  }

  void write_xdmf_file(const std::string &path) const
  {
    XdmfGrid grid;
    grid.cells   = {{result.grid.cells[0], result.grid.cells[1], 1}};
    grid.origin  = {{result.grid.origin[0], result.grid.origin[1], 0.}};
    grid.spacing = {{result.grid.spacing[0], result.grid.spacing[1], 1.}};
    if (!shown.empty())
      write_xdmf(path, grid, shown);
  }

private:
  void write_field(const std::string &name,
                   const std::vector<double> &values,
                   const unsigned int components)
  {
    if (values.empty())
      return;
    Shape shape = {result.grid.cells[1], result.grid.cells[0]};
    if (components > 0)
      shape.push_back(components);
    file.write(name, shape, values);
    file.write_unit(name, "Pa");
    XdmfField field;
    field.name       = name.substr(1);
    field.file       = "localization.h5";
    field.dataset    = name;
    field.centre     = XdmfField::Centre::cell;
    field.components = components;
    if (components == 3)
      field.component_names = {"xx", "yy", "xy"};
    shown.push_back(field);
  }

  void write_probe(const ProbeResult &probe, const std::string &group)
  {
    const std::size_t n = probe.time.size();
    file.write(group + "/time", {n}, probe.time);
    file.write(group + "/stress", {n, 3}, probe.stress);
    file.write_unit(group + "/time", "s");
    file.write_unit(group + "/stress", "Pa");
    if (!probe.direct_stress.empty())
      {
        file.write(group + "/direct_stress", {n, 3}, probe.direct_stress);
        file.write_unit(group + "/direct_stress", "Pa");
      }
    file.write_attribute(group, "position",
                         std::vector<double>{probe.position[0], probe.position[1]});
    file.write_attribute(group, "cell",
                         std::vector<unsigned int>{probe.cell[0], probe.cell[1]});
    file.write_attribute(group, "phase", probe.phase);
    file.write_attribute(group, "phase_name", probe.phase_name);
  }

  const LocalizationResult &result;
  Hdf5File &file;
  std::vector<XdmfField> shown;
};

std::string digest_of(const LocalizationResult &result, const std::string &parameters)
{
  Digest digest;
  for (const std::string &input : result.digests)
    digest.add(input);
  return digest.add(parameters).hex();
}

void write_probe_table(const LocalizationResult &result, const std::string &path)
{
  TableWriter table(path, {"variant", "probe", "x [m]", "y [m]", "phase", "component",
                           "mean [Pa]", "standard deviation [Pa]", "direct mean [Pa]",
                           "direct standard deviation [Pa]", "error of mean [-]",
                           "error of standard deviation [-]", "rms difference [-]"});
  const auto text = [&table](const double value) { return table.cell(value); };
  for (const VariantResult &variant : result.variants)
    for (const ProbeResult &probe : variant.probes)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const ComponentStatistics &s = probe.statistics[c];
          table.add_row(std::vector<std::string>{
            variant.name, probe.name, to_text(probe.position[0]),
            to_text(probe.position[1]), probe.phase_name, component_names[c],
            text(s.mean), text(s.deviation), text(s.direct_mean),
            text(s.direct_deviation), text(s.error_mean), text(s.error_deviation),
            text(s.rms_difference)});
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
json differences_json(const LocalizationResult &result)
{
  json list = json::array();
  for (const ConditionDifference &d : result.differences)
    list.push_back({{"condition", d.name},
                    {"homogeneous", d.first},
                    {"direct", d.second},
                    {"of_load", d.of_load}});
  return list;
}

json probe_json(const ProbeResult &probe)
{
  json entry = {{"name", probe.name},
                {"x", probe.position[0]},
                {"y", probe.position[1]},
                {"phase", probe.phase_name},
                {"samples", probe.time.size()}};
  for (unsigned int c = 0; c < 3; ++c)
    {
      const ComponentStatistics &s = probe.statistics[c];
      entry[component_names[c]]    = {{"mean", number_or_null(s.mean)},
                                      {"std", number_or_null(s.deviation)},
                                      {"direct_mean", number_or_null(s.direct_mean)},
                                      {"direct_std", number_or_null(s.direct_deviation)},
                                      {"error_mean", number_or_null(s.error_mean)},
                                      {"error_std", number_or_null(s.error_deviation)},
                                      {"rms_difference", number_or_null(s.rms_difference)}};
    }
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

void write_localization(const LocalizationResult &result,
                        const LocalizationParameters &request,
                        const std::string &parameters,
                        const std::string &folder)
{
  Hdf5File file = Hdf5File::create(folder + "/localization.h5");
  file.write_header("mesoslip-localization", 1, 2, digest_of(result, parameters));
  file.write_attribute("/", "concentration", request.concentration);
  file.write_attribute("/", "variant", result.variants[0].name);
  write_grid(file, result.grid);
  if (std::isfinite(result.window.begin))
    file.write_attribute("/", "window",
                         std::vector<double>{result.window.begin, result.window.end});
  Writer writer(result, file);
  writer.write_variant(result.variants[0], "");
  writer.write_fields(result.direct, "/direct");
  if (result.variants.size() > 1)
    writer.write_variant(result.variants[1], "/mean_strain_variant");
  file.close();
  writer.write_xdmf_file(folder + "/localization.xdmf");
  write_probe_table(result, folder + "/probes.csv");
  if (!result.variants[0].errors.empty())
    write_error_table(result, folder + "/field_errors.csv");
}

void summarize_localization(const LocalizationResult &result, json &summary)
{
  summary["dim"]                     = 2;
  summary["cells"]                   = result.grid.n_cells();
  summary["dofs"]                    = result.dofs;
  summary["phases"]                  = result.phase_names;
  summary["variant"]                 = result.variants[0].name;
  summary["window"]                  = {number_or_null(result.window.begin),
                                        number_or_null(result.window.end)};
  summary["snapshots"]               = result.n_snapshots;
  summary["direct_snapshots"]        = result.n_direct_snapshots;
  summary["differences_of_the_runs"] = differences_json(result);
  summary.update(variant_json(result.variants[0]));
  if (result.variants.size() > 1)
    summary["mean_strain_variant"] = variant_json(result.variants[1]);
}
} // namespace mesoslip
