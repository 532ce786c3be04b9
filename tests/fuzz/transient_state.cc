// The state in a checkpoint: a run is restored from a changed one and goes on to its end.
#include "byte_edits.h"
#include "fuzzing.h"

#include "io/checkpoint.h"
#include "io/keys.h"
#include "io/run_context.h"
#include "simulation/transient_run.h"
#include "simulation/transient_summary.h"

#include <deal.II/base/mpi.h>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
ContactParameters parameters_to(const std::string &end_time, const bool keep)
{
  RawParameters raw = RawParameters::parse(R"(
subsection Body
  set Stiffness = 36.54e9, 9.1e9, 47.26e9, 13.785e9
  set Density   = 1770
  set Size      = 4e-4, 3e-4
  set Cells     = 4, 3
  set Initial velocity = 0.5, 0
end
subsection Time
  set Time step     = 5e-9
  set Rayleigh beta = 1e-9
end
subsection Observation
  set Probes          = A
  set Energy interval = 3
  subsection A
    set Position = 2e-4, 0
  end
end
)",
                                           "fuzz.prm");
  raw.override_with("Time/End time=" + end_time);
  raw.override_with(std::string("Checkpoints/Keep=") + (keep ? "true" : "false"));
  Keys keys(raw);
  ContactParameters().bind(keys);
  keys.apply();
  ContactParameters parameters;
  parameters.bind(keys);
  parameters.check();
  return parameters;
}

/** What a run needs and no checkpoint changes; the critical time step takes longer than a
 * run. */
struct Body
{
  explicit Body(const ContactParameters &p)
    : parameters(p)
    , scene(make_scene(parameters))
    , material(scene.make_material(false))
    , time(choose_time_step(parameters, material))
  {
  }

  const ContactParameters parameters;
  const Scene scene;
  const UniformMaterial material;
  const TimeStepChoice time;
};

/** A run with all that it refers to. */
struct Transient
{
  Transient(const Body &b, RunContext &context)
    : body(b)
    , checkpoint(context, body.parameters.checkpoints, "a = 1\n")
    , file(context, body.parameters, body.scene, 0)
    , run(
        body.parameters, body.scene, body.time, body.material, checkpoint, file, context)
  {
  }

  const Body &body;
  TransientCheckpoint checkpoint;
  DynamicsFile file;
  TransientRun run;
};

RunOptions options_in(const std::string &folder, const bool resume)
{
  RunOptions options;
  options.program       = "contact_dynamics";
  options.output_folder = folder;
  options.resume        = resume;
  options.quiet         = true;
  return options;
}

/** What a checkpoint after 40 steps holds. */
std::string valid_state(const InputFile &file)
{
  RunContext context(options_in(file.folder, false), MPI_COMM_SELF, "", "");
  const Body body(parameters_to("200e-9", true));
  Transient(body, context).run.run();
  return read_checkpoint(file.path, TransientCheckpoint::header());
}

void restore_and_go_on(const Body &body, RunContext &context)
{
  Transient transient(body, context);
  if (transient.checkpoint.find(body.time.n_steps) != TransientCheckpoint::Found::state)
    return;
  transient.run.restore();
  try
    {
      summarize_transient(body.parameters, body.scene, transient.run.run());
    }
  catch (const NumericalFailure &)
    {
      // What a changed displacement may well lead to.
    }
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static int argc    = 0;
  static char **argv = nullptr;
  static dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  static InputFile file("contact_dynamics.checkpoint");
  static const std::string valid = valid_state(file);
  static const Body body(parameters_to("250e-9", false));
  static RunContext context(options_in(file.folder, true), MPI_COMM_SELF, "", "");
  Choices choices(data, size);
  write_checkpoint(file.path, TransientCheckpoint::header(),
                   {edit_bytes(valid, choices)});
  accepted_or_refused([&]() { restore_and_go_on(body, context); });
  return 0;
}
