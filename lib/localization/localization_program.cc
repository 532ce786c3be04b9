#include "localization/localization_program.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "localization/localization_needs.h"
#include "parameters/keys.h"
#include "program/run_context.h"

#include <memory>
#include <utility>

namespace mesoslip
{
namespace
{
/** Dimension of volume and body, read on rank 0 and broadcast. */
unsigned int dimension_of(const LocalizationParameters &parameters)
{
  unsigned int dim = 0;
  on_root(MPI_COMM_WORLD, [&]() {
    dim = dimension_of_file(parameters.rve_file, "run rve_homogenization first");
  });
  return mpi::broadcast(dim, 0, MPI_COMM_WORLD);
}

template <int dim>
class StressLocalization : public Analysis
{
public:
  StressLocalization(const LocalizationParameters &p, const std::string &canonical_text)
    : parameters(p)
    , canonical(canonical_text)
  {
    on_root(MPI_COMM_WORLD, [this]() {
      files = std::make_unique<LocalizationFiles<dim>>(parameters, true);
      input = std::make_unique<LocalizationInput<dim>>(parameters, *files);
      plan  = input->plan;
    });
  }

  void describe(std::ostream &out) const override
  {
    if (input)
      input->describe(out);
  }

  ResourceNeed need() const override
  {
    return input ? disk_need(*input) : ResourceNeed();
  }

  void run(RunContext &context) override
  {
    context.remove_results(
      {"localization.h5", "localization.xdmf", "probes.csv", "field_errors.csv"});
    on_all_ranks(context.communicator(), [this]() {
      if (!files)
        files = std::make_unique<LocalizationFiles<dim>>(parameters, false);
    });
    broadcast_object(context.communicator(), plan);
    tell(context);
    const LocalizationResult result = [&]() {
      const auto scope = context.timer().scope("Localization");
      return localize(parameters, *files, plan, input.get(), context.communicator(),
                      monitor_of(context));
    }();
    tell(context);
    const auto scope = context.timer().scope("Output");
    LocalizationOrigin origin;
    origin.dim = dim;
    if (input)
      origin = origin_of(*input);
    write_localization(origin, result, canonical, context.output_folder());
    if (!context.root())
      return;
    summarize_localization(origin, result, context.summary());
    log_key_numbers(context);
  }

private:
  static LocalizationMonitor monitor_of(RunContext &context)
  {
    LocalizationMonitor monitor;
    monitor.timer = &context.timer();
    monitor.start = [&](const std::string &activity, const std::size_t steps) {
      context.progress().finish();
      context.progress().start(activity, steps);
    };
    monitor.update = [&](const std::size_t done) {
      context.progress().update(done);
      if (context.stop_requested())
        throw Interrupted("stopped before anything was written; start the run again");
    };
    return monitor;
  }

  /** Logs pending warnings and notes once. */
  void tell(RunContext &context)
  {
    if (!input)
      return;
    for (const std::string &warning : std::exchange(input->warnings, {}))
      context.warn(warning);
    for (const std::string &note : std::exchange(input->notes, {}))
      context.log(note);
  }

  const LocalizationParameters parameters;
  const std::string canonical;
  std::unique_ptr<LocalizationFiles<dim>> files; ///< on rank 0; in a run on all ranks
  std::unique_ptr<LocalizationInput<dim>> input; ///< on rank 0
  LocalizationPlan<dim> plan;                    ///< made on rank 0, in runs on all
};

std::unique_ptr<Analysis> build_localization(Keys &keys)
{
  const std::string canonical =
    canonical_parameters(keys, {"Output folder", "Input/RVE file",
                                "Input/Homogeneous run", "Input/Direct run"});
  LocalizationParameters parameters;
  parameters.bind(keys);
  parameters.check();
  if (dimension_of(parameters) == 2)
    return std::make_unique<StressLocalization<2>>(parameters, canonical);
  return std::make_unique<StressLocalization<3>>(parameters, canonical);
}
} // namespace

Application stress_localization_program()
{
  return {"stress_localization",
          "Stresses in fibres and matrix from a run of the homogenized body.",
          [](Keys &keys) {
            LocalizationParameters().bind(keys);
            LocalizationParameters::check_keys(keys);
          },
          build_localization};
}
} // namespace mesoslip
