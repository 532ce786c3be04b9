#include "localization/localization_program.h"

#include "base/digest.h"
#include "base/errors.h"
#include "base/exchange.h"
#include "exchange/localization_file.h"
#include "io/json.h"
#include "io/table.h"
#include "parameters/keys.h"
#include "program/run_context.h"

#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

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

void write_variant(LocalizationFile &file,
                   const VariantResult &variant,
                   const std::string &group)
{
  file.write_fields(variant.fields, group);
  file.write_fields(variant.difference, group + "/difference");
  for (const ProbeResult &probe : variant.probes)
    file.write_probe(probe, group);
}

std::string digest_of(const LocalizationInput &input, const std::string &parameters)
{
  Digest digest;
  digest.add(input.rve.digest).add(input.homogeneous.digest);
  digest.add(input.direct ? input.direct->digest : "");
  return digest.add(parameters).hex();
}

void write_probe_table(const LocalizationResult &result, const std::string &path)
{
  std::vector<std::string> headings = {"variant", "probe", "x [m]",
                                       "y [m]",   "phase", "component"};
  for (const Comparison &comparison : comparisons)
    headings.emplace_back(comparison.heading);
  TableWriter table(path, headings);
  for (const VariantResult &variant : result.variants)
    for (const ProbeResult &probe : variant.probes)
      for (unsigned int c = 0; c < 3; ++c)
        {
          std::vector<std::string> row = {variant.name,
                                          probe.name,
                                          to_text(probe.position[0]),
                                          to_text(probe.position[1]),
                                          probe.phase_name,
                                          component_names[c]};
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

json probe_json(const ProbeResult &probe)
{
  json entry = {{"name", probe.name},
                {"x", probe.position[0]},
                {"y", probe.position[1]},
                {"phase", probe.phase_name},
                {"samples", probe.time.size()}};
  for (unsigned int c = 0; c < 3; ++c)
    for (const Comparison &comparison : comparisons)
      entry[component_names[c]][comparison.name] =
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

/** The errors that a user looks for first, in per cent. */
void log_key_numbers(RunContext &context)
{
  const json &summary = context.summary();
  if (!summary.contains("field_errors"))
    return;
  for (const char *quantity : {"mean_von_mises", "mean_sigma_yy"})
    {
      const auto field = summary["field_errors"].find(quantity);
      if (field == summary["field_errors"].end())
        continue;
      std::ostringstream line;
      line.precision(3);
      line << quantity << " against the direct run (relative L2):";
      std::vector<std::string> regions = {"interior", "surface"};
      for (const auto &phase : summary["phases"])
        regions.push_back(phase);
      for (const std::string &region : regions)
        if (field->contains(region) && (*field)[region].is_number())
          line << ' ' << region << ' ' << 100. * (*field)[region].get<double>() << " %";
      context.log(line.str());
    }
}

/** Works on rank 0 alone: reading the snapshots takes longer than the arithmetic on them,
 * and handing rows to other ranks would cost as much again. */
class StressLocalization : public Analysis
{
public:
  explicit StressLocalization(Keys &keys)
    : canonical(canonical_parameters(
        keys,
        {"Output folder", "Input/RVE file", "Input/Homogeneous run", "Input/Direct run"}))
  {
    LocalizationParameters parameters;
    parameters.bind(keys);
    parameters.check();
    on_root(MPI_COMM_WORLD,
            [&]() { input = std::make_unique<LocalizationInput>(parameters); });
  }

  void describe(std::ostream &out) const override
  {
    if (input)
      input->describe(out);
  }

  void run(RunContext &context) override
  {
    context.remove_results(
      {"localization.h5", "localization.xdmf", "probes.csv", "field_errors.csv"});
    if (context.n_ranks() > 1)
      context.log("one process works, the others wait: reading is what takes the time");
    on_root(context.communicator(), [&]() { run_on_root(context); });
    if (context.root())
      log_key_numbers(context);
  }

private:
  /** Tells what there is to be told, once. */
  void tell(RunContext &context)
  {
    for (const std::string &warning : std::exchange(input->warnings, {}))
      context.warn(warning);
    for (const std::string &note : std::exchange(input->notes, {}))
      context.log(note);
  }

  void run_on_root(RunContext &context)
  {
    LocalizationMonitor monitor;
    monitor.timer = &context.timer();
    monitor.start = [&](const std::string &activity, const std::size_t steps) {
      context.progress().finish();
      context.progress().start(activity, steps);
    };
    monitor.update = [&](const std::size_t done) {
      context.progress().update(done);
      // Local to the process: the other ranks wait for the outcome.
      if (context.stop_requested_here())
        throw Interrupted("stopped before anything was written; start the run again");
    };
    tell(context);
    const LocalizationResult result = [&]() {
      const auto scope = context.timer().scope("Localization");
      return localize(*input, monitor);
    }();
    tell(context);
    const auto scope = context.timer().scope("Output");
    write_localization(*input, result, canonical, context.output_folder());
    summarize_localization(*input, result, context.summary());
  }

  const std::string canonical;
  std::unique_ptr<LocalizationInput> input; ///< on rank 0
};
} // namespace

void write_localization(const LocalizationInput &input,
                        const LocalizationResult &result,
                        const std::string &parameters,
                        const std::string &folder)
{
  LocalizationFile file = LocalizationFile::create(
    folder + "/localization.h5", digest_of(input, parameters), input.rve.grid);
  file.write_attribute("/", "concentration", input.parameters.concentration);
  file.write_attribute("/", "variant", result.variants[0].name);
  if (std::isfinite(result.window.begin))
    file.write_attribute("/", "window",
                         std::array<double, 2>{{result.window.begin, result.window.end}});
  write_variant(file, result.variants[0], "");
  file.write_fields(result.direct, "/direct");
  if (result.variants.size() > 1)
    write_variant(file, result.variants[1], "/mean_strain_variant");
  file.complete();
  write_probe_table(result, folder + "/probes.csv");
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
  summary.update(variant_json(result.variants[0]));
  if (result.variants.size() > 1)
    summary["mean_strain_variant"] = variant_json(result.variants[1]);
}

Application stress_localization_program()
{
  return {"stress_localization",
          "Stresses in fibres and matrix from a run of the homogenized body.",
          [](Keys &keys) {
            LocalizationParameters().bind(keys);
            LocalizationParameters::check_keys(keys);
          },
          [](Keys &keys) { return std::make_unique<StressLocalization>(keys); }};
}
} // namespace mesoslip
