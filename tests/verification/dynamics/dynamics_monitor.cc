#include "../sliding/sliding_body.h"
#include "base/errors.h"
#include "dynamics/stability_monitor.h"
#include "dynamics/stepper.h"

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
  const std::function<void(Body &)> &spoil = [](Body &) {})
{
  Body body(setup);
  Watched result;
  StabilityMonitor monitor(
    body.stepper, [&]() { return body.boundary_work(); },
    [&](const Runaway &found, const std::uint64_t n) {
      result = {n, found};
      throw NumericalFailure("stopped");
    });
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
  const Watched run = watch(pin(0.9, 0.5, 0.), 2000,
                            [](Body &body) { body.u.row(1, 7)[12] = std::nan(""); });
  EXPECT_EQ(run.step, 128u);
  EXPECT_FALSE(std::isfinite(run.found.displacement));
  // A NaN reaches one node further in a step: 28 steps, the whole body.
  EXPECT_EQ(run.found.row, 0u);
  EXPECT_EQ(
    watch(pin(0.9, 0.5, 0.), 2000, [](Body &body) { body.w.row(0, 3)[5] = HUGE_VAL; })
      .step,
    128u);
}

namespace
{
constexpr unsigned int n_x = 7, n_y = 5;

UniformGrid<2> deformed_grid()
{
  return {{{n_x, n_y}}, {{0.1, 0.2}}};
}

/** u = (a x + b y, c x + d y). */
NodalField<double>
linear_field(const double a, const double b, const double c, const double d)
{
  NodalField<double> u(n_x + 1, n_y + 1);
  for (unsigned int j = 0; j <= n_y; ++j)
    for (unsigned int i = 0; i <= n_x; ++i)
      {
        const double x = 0.1 * i, y = 0.2 * j;
        u.row(0, j)[i] = a * x + b * y;
        u.row(1, j)[i] = c * x + d * y;
      }
  return u;
}

Deformation deformation(const NodalField<double> &u)
{
  return largest_deformation(deformed_grid(), NodeRows::all(n_y + 1), u, MPI_COMM_SELF);
}
} // namespace

TEST(Deformation, OfALinearField)
{
  const double a = 0.02, b = -0.03, c = 0.05, d = -0.01;
  const Deformation found = deformation(linear_field(a, b, c, d));
  EXPECT_NEAR(found.strain.value, std::sqrt(a * a + d * d + 0.5 * (b + c) * (b + c)),
              1e-14);
  EXPECT_NEAR(found.rotation.value, 0.5 * std::fabs(c - b), 1e-14);
  EXPECT_NEAR(found.jacobian.value, (1. + a) * (1. + d) - b * c, 1e-14);
  // A mirror image has the area -1, and a quarter turn, far from small, that of the body.
  EXPECT_NEAR(deformation(linear_field(-2., 0., 0., 0.)).jacobian.value, -1., 1e-14);
  EXPECT_NEAR(deformation(linear_field(-1., -1., 1., -1.)).jacobian.value, 1., 1e-14);
}

TEST(Deformation, NamesTheCell)
{
  NodalField<double> u = linear_field(0., 0., 0., 0.);
  // A corner of the upper right cell beyond the opposite edge of it.
  u.row(0, n_y)[n_x] = -0.11;
  Deformation found  = deformation(u);
  EXPECT_NEAR(found.jacobian.value, -0.1, 1e-14);
  for (const CellExtreme &cell : {found.strain, found.jacobian, found.rotation})
    {
      EXPECT_EQ(cell.cell, n_x * n_y - 1);
      EXPECT_NEAR(cell.middle[0], 0.1 * (n_x - 0.5), 1e-14);
      EXPECT_NEAR(cell.middle[1], 0.2 * (n_y - 0.5), 1e-14);
    }
  u.row(1, 2)[3] = std::nan("");
  found          = deformation(u);
  EXPECT_EQ(found.strain.value, HUGE_VAL);
  EXPECT_EQ(found.jacobian.value, -HUGE_VAL);
  EXPECT_EQ(found.strain.cell, n_x + 2) << "the first of the four beside the node";
}
