#include "localization/localization_program.h"

#include "base/collective.h"
#include "base/errors.h"
#include "localization/localization_output.h"
#include "localization/localize.h"
#include "parameters/keys.h"
#include "program/run_context.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace mesoslip
{
namespace
{
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
