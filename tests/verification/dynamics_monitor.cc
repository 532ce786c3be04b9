#include "dynamics/stability_monitor.h"

#include "io/errors.h"
#include "sliding_body.h"

#include <gtest/gtest.h>

using namespace verification;

namespace
{
/** A pin that slips and separates, two phases, at @p share of the exact limit. */
BodySetup pin(const double share, const double beta2, const double beta)
{
  BodySetup s;
  s.cells   = {{24, 10}};
  s.spacing = {{1e-3, 1e-3}};
  s.classes = {resin(), {isotropic_stiffness<2>(2.4e11, 0.2), 2500.}};
  for (unsigned int i = 0; i < 240; ++i)
    s.ids.push_back(i % 7 == 2);
  s.friction              = 0.4;
  s.contact.flat_velocity = LoadHistory(2.);
  s.top.pressure          = LoadHistory(5e6);
  s.step.beta2            = beta2;
  s.step.beta             = beta;
  s.choose_time_step(share);
  return s;
}

struct Watched
{
  std::uint64_t step = 0; ///< at which the monitor stopped the run; 0: it did not
  Runaway found;
};

/** Runs @p n_steps under a monitor; @p spoil is called once after 100 steps. */
Watched watch(
  const BodySetup &setup,
  const std::uint64_t n_steps,
  const std::function<void(SlidingBody &)> &spoil = [](SlidingBody &) {})
{
  SlidingBody body(setup);
  Watched result;
  StabilityMonitor monitor(
    body.op, setup.step, body.u, body.w,
    [&]() {
      const ContactWork &work = body.contact.work();
      return BoundaryWork{body.top.work() + work.flat, work.friction, work.impact};
    },
    [&](const Runaway &found, const std::uint64_t n) {
      result = {n, found};
      throw NumericalFailure("stopped");
    },
    MPI_COMM_SELF);
  try
    {
      body.run(100, &monitor);
      spoil(body);
      body.run(n_steps - 100, &monitor);
    }
  catch (const NumericalFailure &)
    {
      EXPECT_GT(result.step, 0u);
    }
  return result;
}
} // namespace

TEST(Monitor, LeavesStableRunsAlone)
{
  for (const double b : {0.5, 0.75, 1.})
    for (const double beta : {0., 4.4e-9, 1e-6})
      for (const double share : {0.2, 0.95, 0.999})
        EXPECT_EQ(watch(pin(share, b, beta), 20000).step, 0u)
          << "beta2 " << b << " beta " << beta << " at " << share;
}

TEST(Monitor, StopsBeforeNumbersOverflow)
{
  for (const double b : {0.5, 0.75, 1.})
    for (const double beta : {0., 4.4e-9, 1e-6})
      for (const double share : {1.03, 1.2})
        {
          const Watched run = watch(pin(share, b, beta), 40000);
          EXPECT_GT(run.step, 0u) << "beta2 " << b << " beta " << beta << " at " << share;
          EXPECT_TRUE(std::isfinite(run.found.energy));
          EXPECT_GT(run.found.energy, 1e6 * run.found.put_in);
          EXPECT_GT(std::abs(run.found.velocity), 1.);
        }
}

TEST(Monitor, NamesTheNodeThatIsNotFinite)
{
  const Watched run = watch(pin(0.9, 0.5, 0.), 2000, [](SlidingBody &body) {
    body.u.row(1, 7)[12] = std::nan("");
  });
  EXPECT_EQ(run.step, 128u);
  EXPECT_FALSE(std::isfinite(run.found.displacement));
  // A NaN reaches one node further in a step: 28 steps, the whole body.
  EXPECT_EQ(run.found.row, 0u);
  EXPECT_EQ(watch(pin(0.9, 0.5, 0.), 2000,
                  [](SlidingBody &body) { body.w.row(0, 3)[5] = HUGE_VAL; })
              .step,
            128u);
}
