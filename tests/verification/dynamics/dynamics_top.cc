#include "../sliding/sliding_body.h"

#include <gtest/gtest.h>

using namespace verification;

namespace
{
constexpr double H = 0.016, top_pressure = 5e6;

/** Layers of two materials, sides held in x: uniaxial strain when it is pressed slowly.
 */
BodySetup layers(const bool platen)
{
  BodySetup s;
  s.cells   = {{12, 16}};
  s.spacing = {{1.2e-3, 1e-3}};
  s.classes = {resin(), {isotropic_stiffness<2>(6e10, 0.3), 2600.}};
  for (unsigned int j = 0; j < 16; ++j)
    s.ids.insert(s.ids.end(), 12, j >= 4 && j < 10);
  s.sides.left_held  = {{true, false}};
  s.sides.right_held = {{true, false}};
  s.top.is_platen    = platen;
  s.top.pressure     = LoadHistory(top_pressure, Ramp::smooth, 2e-4);
  s.step.beta        = 2e-7;
  s.choose_time_step(0.9);
  return s;
}

double layers_compression(const BodySetup &s)
{
  return top_pressure *
         (0.010 / s.classes[0].stiffness(1, 1) + 0.006 / s.classes[1].stiffness(1, 1));
}
} // namespace

TEST(Top, SlowPressureGivesTheStaticCompression)
{
  for (const bool platen : {true, false})
    for (const double platen_mass : {0., 0.1})
      {
        if (!platen && platen_mass > 0.)
          continue;
        BodySetup setup       = layers(platen);
        setup.top.platen_mass = platen_mass;
        Body body(setup);
        body.run(std::lround(4e-4 / setup.step.dt));
        const double expected = layers_compression(setup), width = 12 * 1.2e-3;
        const TopHistory &top = body.top_recorder.history();
        EXPECT_NEAR(top.displacement.back(), -expected, 0.002 * expected);
        EXPECT_NEAR(top.normal_force.back(), top_pressure * width,
                    1e-12 * top_pressure * width);
        EXPECT_NEAR(body.contact_recorder.history().normal_force.back(),
                    top_pressure * width, 0.01 * top_pressure * width);
        EXPECT_NEAR(body.top.work(), 0.5 * top_pressure * width * expected,
                    0.01 * top_pressure * width * expected);
        // Half the share of the end nodes, here and there.
        const double *normal = body.contact.normal_force();
        for (unsigned int i = 1; i < 12; ++i)
          EXPECT_NEAR(normal[i], top_pressure * 1.2e-3, 0.01 * top_pressure * 1.2e-3);
        EXPECT_NEAR(normal[0], top_pressure * 0.6e-3, 0.01 * top_pressure * 0.6e-3);
        EXPECT_NEAR(normal[12], top_pressure * 0.6e-3, 0.01 * top_pressure * 0.6e-3);
        for (unsigned int j = 0; j <= 16; ++j)
          {
            const double y     = std::min<double>(j, 4) * 1e-3,
                         rest  = std::max(0., j - 10.) * 1e-3;
            const double stiff = std::clamp(j - 4., 0., 6.) * 1e-3;
            const double uy =
              top_pressure * ((y + rest) / setup.classes[0].stiffness(1, 1) +
                              stiff / setup.classes[1].stiffness(1, 1));
            EXPECT_NEAR(body.u.row(1, j)[5], -uy, 0.002 * expected) << j;
            EXPECT_LT(std::abs(body.u.row(0, j)[5]), 1e-9 * expected) << j;
          }
      }
}

TEST(Top, PlatenIsRigid)
{
  // Free sides and friction: the top would bulge and shear.
  BodySetup setup             = layers(true);
  setup.sides                 = SideConstraints();
  setup.friction              = 0.3;
  setup.contact.flat_velocity = LoadHistory(2.);
  Body body(setup);
  for (unsigned int k = 0; k < 30; ++k)
    {
      body.run(100);
      for (unsigned int i = 0; i <= 12; ++i)
        {
          ASSERT_EQ(body.u.row(0, 16)[i], 0.);
          ASSERT_EQ(body.u.row(1, 16)[i], body.u.row(1, 16)[0]);
        }
    }
  EXPECT_LT(body.u.row(1, 16)[0], -1e-7);
  EXPECT_GT(std::abs(body.u.row(0, 8)[6]), 1e-7);

  setup.top.is_platen = false;
  Body soft(setup);
  soft.run(3000);
  EXPECT_GT(std::abs(soft.u.row(0, 16)[0] - soft.u.row(0, 16)[12]), 1e-9);
  EXPECT_NE(soft.u.row(1, 16)[0], soft.u.row(1, 16)[6]);
}

TEST(Top, HeldTopPressesBack)
{
  // The flat starts 1 um too high.
  BodySetup setup = layers(false);
  setup.top.hold();
  setup.contact.gap = -1e-6;
  Body body(setup);
  body.run(std::lround(4e-4 / setup.step.dt));
  const double force = top_pressure * 12 * 1.2e-3 * 1e-6 / layers_compression(setup);
  EXPECT_NEAR(body.top_recorder.history().normal_force.back(), force, 0.01 * force);
  EXPECT_NEAR(body.contact_recorder.history().normal_force.back(), force, 0.01 * force);
  EXPECT_EQ(body.top.work(), 0.);
  for (unsigned int i = 0; i <= 12; ++i)
    EXPECT_TRUE(body.u.row(0, 16)[i] == 0. && body.u.row(1, 16)[i] == 0.);
}

TEST(Top, HeldSidesStay)
{
  BodySetup setup             = layers(false);
  setup.sides.left_held       = {{true, true}};
  setup.sides.right_held      = {{false, true}};
  setup.friction              = 0.3;
  setup.contact.flat_velocity = LoadHistory(2.);
  Body body(setup);
  body.run(2000);
  for (unsigned int j = 0; j <= 16; ++j)
    {
      EXPECT_TRUE(body.u.row(0, j)[0] == 0. && body.u.row(1, j)[0] == 0.) << j;
      EXPECT_EQ(body.u.row(1, j)[12], 0.) << j;
      EXPECT_NE(body.u.row(0, j)[12], 0.) << j;
    }
  EXPECT_LT(body.u.row(1, 16)[6], -1e-7);
}

TEST(Top, HoldsFromATimeOn)
{
  BodySetup setup     = layers(true);
  setup.top.hold_from = 3e-4;
  Body body(setup);
  body.run(std::lround(3e-4 / setup.step.dt) + 2);
  const double u = body.u.row(1, 16)[0];
  EXPECT_NEAR(u, -layers_compression(setup), 0.002 * layers_compression(setup));
  const double work = body.top.work();
  body.run(1000);
  EXPECT_EQ(body.u.row(1, 16)[0], u);
  EXPECT_EQ(body.w.row(1, 16)[3], 0.);
  EXPECT_EQ(body.top.work(), work);
  EXPECT_NEAR(body.top_recorder.history().normal_force.back(), top_pressure * 12 * 1.2e-3,
              0.01 * top_pressure * 12 * 1.2e-3);
}
