#include "localization/localization_program.h"

#include "io/collective.h"
#include "io/errors.h"
#include "io/interrupt.h"
#include "io/parameters.h"
#include "io/raw_parameters.h"
#include "io/run_context.h"
#include "localization/localization_output.h"
#include "localization/localize.h"

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
  monitor.start = [&context](const std::string &activity, const std::size_t steps) {
    context.progress().finish();
    context.progress().start(activity, steps);
  };
  monitor.update = [&context](const std::size_t done) {
    context.progress().update(done);
    // Local to the process: the other ranks wait for the outcome.
    if (interrupt_received() || terminate_file_exists(context.output_folder()))
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

/**
 * All on rank 0: reading the snapshots takes longer than the arithmetic on them, and
 * handing rows to other ranks would cost as much again.
 */
void run(dealii::ParameterHandler &prm, RunContext &context)
{
  const LocalizationParameters parameters = LocalizationParameters::parse(prm);
  const std::string canonical =
    canonical_parameters(prm, {"Output folder", "Input/RVE file", "Input/Homogeneous run",
                               "Input/Direct run"});
  if (context.n_ranks() > 1)
    context.log("one process works, the others wait: reading is what takes the time");
  on_root(context.communicator(), [&]() {
    const LocalizationMonitor monitor = make_monitor(context);
    const auto localized              = [&]() {
      const auto scope = context.timer().scope("Localization");
      return localize(parameters, monitor);
    }();
    const auto scope = context.timer().scope("Output");
    write_localization(localized, parameters, canonical, context.output_folder());
    summarize_localization(localized, context.summary());
    context.summary()["concentration"] = parameters.concentration;
  });
  if (context.root())
    log_key_numbers(context);
}

void estimate(dealii::ParameterHandler &prm, std::ostream &report)
{
  const LocalizationParameters parameters = LocalizationParameters::parse(prm);
  on_root(MPI_COMM_WORLD, [&]() { report << describe_localization(parameters); });
}
} // namespace

Program stress_localization_program()
{
  Program program;
  program.name = "stress_localization";
  program.description =
    "Stresses in fibres and matrix from a run of the homogenized body.";
  program.declare    = LocalizationParameters::declare;
  program.check_keys = LocalizationParameters::check_keys;
  program.check      = [](dealii::ParameterHandler &prm) {
    LocalizationParameters::parse(prm);
    return Need();
  };
  program.estimate = estimate;
  program.run      = run;
  return program;
}
} // namespace mesoslip
