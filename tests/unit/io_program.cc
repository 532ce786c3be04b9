#include "io/errors.h"
#include "io/parameters.h"
#include "io/program.h"
#include "io/raw_parameters.h"
#include "io/run_context.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/solver_control.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>

/**
 * A program without any physics, to test from outside what all programs share. The key
 * `Behaviour` makes it fail in the ways a program can.
 */
namespace
{
using namespace mesoslip;

void declare(dealii::ParameterHandler &prm, const RawParameters &raw)
{
  declare_integer(prm, "Dimension", 2, 2, 3, "Space dimension [-]");
  declare_selection(prm, "Behaviour", "succeed",
                    {"succeed", "nan", "fail", "logic", "wait", "one rank", "solver"},
                    "What the run does");
  {
    const ParameterSection section(prm, "Time step");
    declare_double(prm, "Fraction", 1. / 3., Range::left_open(0., 1.),
                   "Of the limit [-]");
    declare_double_or_auto(prm, "Size", "auto", Range::positive(), "Time step [s]");
    declare_bool(prm, "Adaptive", false, "Whether to adapt");
  }
  const auto names = raw.get_list("Phases/Names", {"matrix"});
  {
    const ParameterSection section(prm, "Phases");
    declare_word_list(prm, "Names", {"matrix"}, {}, "Names of the phases");
  }
  for (const std::string &name : names)
    {
      const ParameterSection section(prm, "Phases/" + name);
      declare_double(prm, "Density", 1200., Range::positive(), "Density [kg/m^3]");
    }
  const ParameterSection section(prm, "Input");
  declare_input_file(prm, "Image file", "", "Picture of the phases");
  declare_double_list(prm, "Levels", {0., 0.1}, Range::any(), "Levels [m]", 1, 3);
}

Need check(dealii::ParameterHandler &prm)
{
  const ParameterSection section(prm, "Input");
  if (!get_string(prm, "Image file").empty())
    get_input_file(prm, "Image file", "draw one first");
  return {};
}

void run(dealii::ParameterHandler &prm, RunContext &context)
{
  if (context.resume())
    context.begin();
  const auto scope            = context.timer().scope("Work");
  const std::string behaviour = get_string(prm, "Behaviour");
  context.summary()["dim"]    = get_integer(prm, "Dimension");
  if (behaviour == "nan")
    context.summary()["speed"]["mean"] = std::nan("");
  if (behaviour == "fail")
    throw NumericalFailure("the velocity is not finite", 12, 1.5e-6, "node (3, 4)");
  if (behaviour == "logic")
    get_double(prm, "Undeclared");
  if (behaviour == "solver")
    throw dealii::SolverControl::NoConvergence(7, 0.5);
  if (behaviour == "one rank" && context.rank() == context.n_ranks() - 1)
    throw UserError("only this rank is in trouble");
  if (behaviour != "wait")
    return;
  context.progress().start("waiting", 1000);
  for (unsigned int step = 1; step <= 1000; ++step)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      context.progress().update(step, 1.e-6 * step);
      if (context.stop_requested())
        throw Interrupted("stopped after step " + std::to_string(step));
    }
}
} // namespace

int main(int argc, char **argv)
{
  // Assertions of deal.II, where they are compiled in, are seen as exceptions.
  dealii::deal_II_exceptions::disable_abort_on_exception();
  Program program;
  program.name        = "io_program";
  program.description = "Tests what all programs share.";
  program.declare     = declare;
  program.check       = check;
  program.estimate    = [](dealii::ParameterHandler &, std::ostream &report) {
    report << "memory 1 MB\n";
  };
  program.run       = run;
  program.resumable = [](dealii::ParameterHandler &) { return true; };
  return mesoslip::run_program(argc, argv, program);
}
