#include "localization/localization_program.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "localization/mesh/mesh_localization.h"
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

/** Dimension of the volume; 0: volume and body are one rectangle of equal cells. Of rank
 * 0, for all. */
unsigned int mesh_dimension(const LocalizationParameters &parameters)
{
  unsigned int dim = 0;
  on_root(MPI_COMM_WORLD, [&]() {
    const std::string hint = "run rve_homogenization first",
                      run  = parameters.homogeneous_run;
    dim                    = dimension_of_file(parameters.rve_file, hint);
    if (dim == 2 && parameters.points.empty() &&
        Hdf5File::open(parameters.rve_file, hint).exists("/grid") &&
        !Hdf5File::open(run, "run contact_dynamics first").exists("/mesh"))
      dim = 0;
  });
  return dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, dim);
}

/** Works on rank 0 alone: reading the snapshots takes longer than the arithmetic on them,
 * and handing rows to other ranks would cost as much again. */
class StressLocalization : public Analysis
{
public:
  StressLocalization(const LocalizationParameters &parameters,
                     const std::string &canonical_text)
    : canonical(canonical_text)
  {
    on_root(MPI_COMM_WORLD,
            [&]() { input = std::make_unique<LocalizationInput>(parameters); });
  }

  void describe(std::ostream &out) const override
  {
    if (input)
      input->describe(out);
  }

  ResourceNeed need() const override
  {
    return input ? input->need() : ResourceNeed();
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
    const auto scope                = context.timer().scope("Output");
    const LocalizationOrigin origin = origin_of(*input);
    write_localization(origin, result, canonical, context.output_folder());
    summarize_localization(origin, result, context.summary());
  }

  const std::string canonical;
  std::unique_ptr<LocalizationInput> input; ///< on rank 0
};

std::unique_ptr<Analysis> build_localization(Keys &keys)
{
  const std::string canonical =
    canonical_parameters(keys, {"Output folder", "Input/RVE file",
                                "Input/Homogeneous run", "Input/Direct run"});
  LocalizationParameters parameters;
  parameters.bind(keys);
  parameters.check();
  switch (mesh_dimension(parameters))
    {
    case 0:
      return std::make_unique<StressLocalization>(parameters, canonical);
    case 2:
      return make_mesh_localization<2>(parameters, canonical);
    default:
      return make_mesh_localization<3>(parameters, canonical);
    }
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
