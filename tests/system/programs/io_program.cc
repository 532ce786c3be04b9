#include "base/errors.h"
#include "parameters/keys.h"
#include "program/program.h"
#include "program/run_context.h"

#include <deal.II/lac/solver_control.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

/**
 * A program without any physics, to test from outside what all programs share. The key
 * `Behaviour` makes it fail in the ways a program can.
 */
namespace
{
using namespace mesoslip;

class Nothing : public Analysis
{
public:
  void describe(std::ostream &out) const override
  {
    out << "memory 1 MB\n";
  }

  bool resumable() const override
  {
    return true;
  }

  void run(RunContext &context) override;

  void bind(Keys &keys)
  {
    bool adaptive   = false;
    double fraction = 1. / 3., size = std::nan("");
    keys.bind("Dimension", dimension, 2, 3, "Space dimension [-]");
    keys.bind("Behaviour", behaviour,
              {"succeed", "nan", "fail", "logic", "one rank", "solver"},
              "What the run does");
    {
      const auto section = keys.section("Time step");
      keys.bind("Fraction", fraction, Range::left_open(0., 1.), "Of the limit [-]");
      keys.bind_or_auto("Size", size, Range::positive(), "Time step [s]");
      keys.bind("Adaptive", adaptive, "Whether to adapt");
    }
    {
      const auto section             = keys.section("Phases");
      std::vector<std::string> names = {"matrix"};
      keys.bind_names("Names", names, "phase", "Names of the phases");
      for (const std::string &name : names)
        {
          const auto phase = keys.section(name);
          double density   = 1200.;
          keys.bind("Density", density, Range::positive(), "Density [kg/m^3]");
        }
    }
    const auto section         = keys.section("Input");
    std::vector<double> levels = {0., 0.1};
    keys.bind_input("Image file", file, "Picture of the phases");
    keys.bind_list("Levels", levels, Range::any(), "Levels [m]", 1, 3);
  }

  std::string file;

private:
  int dimension         = 2;
  std::string behaviour = "succeed";
};

void Nothing::run(RunContext &context)
{
  if (context.resume())
    context.begin();
  const auto scope         = context.timer().scope("Work");
  context.summary()["dim"] = dimension;
  if (behaviour == "nan")
    context.summary()["speed"]["mean"] = std::nan("");
  if (behaviour == "fail")
    throw NumericalFailure("the velocity is not finite", 12, 1.5e-6, "node (3, 4)");
  if (behaviour == "logic")
    Keys().value("Undeclared");
  if (behaviour == "solver")
    throw dealii::SolverControl::NoConvergence(7, 0.5);
  if (behaviour == "one rank" && context.rank() == context.n_ranks() - 1)
    throw UserError("only this rank is in trouble");
}

std::unique_ptr<Analysis> build(Keys &keys)
{
  auto nothing = std::make_unique<Nothing>();
  nothing->bind(keys);
  if (!nothing->file.empty())
    require_readable_file("Input/Image file: ", nothing->file, "draw one first");
  return nothing;
}
} // namespace

int main(int argc, char **argv)
{
  return run_program(argc, argv,
                     {"io_program", "Tests what all programs share.",
                      [](Keys &keys) { Nothing().bind(keys); }, build});
}
