#include "localization/localization_program.h"

#include "base/collective.h"
#include "base/errors.h"
#include "localization/localization_output.h"
#include "localization/localize.h"
#include "parameters/keys.h"
#include "program/run_context.h"

#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

namespace mesoslip
{
namespace
{
LocalizationMonitor make_monitor(RunContext &context)
{
  LocalizationMonitor monitor;
  monitor.log   = [&context](const std::string &line) { context.log(line); };
  monitor.timer = &context.timer();
  monitor.warn  = [&context](const std::string &line) { context.warn(line); };
  monitor.begin = [&context]() {
    context.remove_results(
      {"localization.h5", "localization.xdmf", "probes.csv", "field_errors.csv"});
  };
  monitor.start = [&context](const std::string &activity, const std::size_t steps) {
    context.progress().finish();
    context.progress().start(activity, steps);
  };
  monitor.update = [&context](const std::size_t done) {
    context.progress().update(done);
    // Local to the process: the other ranks wait for the outcome.
    if (context.stop_requested_here())
      throw Interrupted("stopped before anything was written; start the run again");
  };
  return monitor;
}

/** The errors that a user looks for first, in per cent. */
void log_key_numbers(RunContext &context)
{
  const nlohmann::json &summary = context.summary();
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
    parameters.bind(keys);
    parameters.check();
  }

  void describe(std::ostream &out) const override
  {
    on_root(MPI_COMM_WORLD, [&]() { out << describe_localization(parameters); });
  }

  void run(RunContext &context) override
  {
    if (context.n_ranks() > 1)
      context.log("one process works, the others wait: reading is what takes the time");
    on_root(context.communicator(), [&]() { run_on_root(context); });
    if (context.root())
      log_key_numbers(context);
  }

private:
  void run_on_root(RunContext &context) const
  {
    const LocalizationMonitor monitor = make_monitor(context);
    const auto localized              = [&]() {
      const auto scope = context.timer().scope("Localization");
      return localize(parameters, monitor);
    }();
    const auto scope = context.timer().scope("Output");
    write_localization(localized, parameters, canonical, context.output_folder());
    summarize_localization(localized, context.summary());
    context.summary()["concentration"] = parameters.concentration;
  }

  LocalizationParameters parameters;
  const std::string canonical;
};
} // namespace

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
