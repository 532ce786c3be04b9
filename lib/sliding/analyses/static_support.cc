#include "sliding/analyses/static_support.h"

#include "base/errors.h"
#include "program/run_context.h"
#include "statics/static_solver.h"

namespace mesoslip
{
DofMask held_by_supports(const UniformMaterial &material,
                         const SideConstraints &sides,
                         const TopSetup &top)
{
  const unsigned int last_column = material.n_columns() - 1,
                     last_row    = material.n_rows() - 1;
  const bool rigid               = top.kind != TopSetup::Kind::pressure;
  DofMask held(last_column + 1, last_row + 1);
  for (unsigned int c = 0; c < 2; ++c)
    {
      if (sides.left_held[c])
        held.constrain_column(c, 0);
      if (sides.right_held[c])
        held.constrain_column(c, last_column);
      if (rigid || (c == 0 && top.lateral_held))
        held.constrain_row(c, last_row);
    }
  return held;
}

std::function<void(unsigned int)> stop_or_report(RunContext &context,
                                                 const std::string &activity)
{
  return [&context, activity](const unsigned int n) {
    if (context.stop_requested())
      throw Interrupted("stopped on request in " + activity + " " +
                        std::to_string(n + 1) + "; there is no result yet");
  };
}

void with_advice(const std::string &advice, const std::function<void()> &action)
{
  try
    {
      action();
    }
  catch (const NotConverged &e)
    {
      throw NumericalFailure(std::string(e.what()) + "; " + advice);
    }
}
} // namespace mesoslip
