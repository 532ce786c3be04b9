#include "../../unit/elasticity/elasticity_testing.h"
#include "../sliding/sliding_body.h"
#include "material/stiffness.h"

#include <gtest/gtest.h>

using namespace verification;
using elasticity_testing::Random;

namespace
{
constexpr unsigned int nx = 23, ny = 14;

/** Cells of three anisotropic materials, not square. */
BodySetup upright(Random &random)
{
  BodySetup s;
  s.cells   = {{nx, ny}};
  s.spacing = {{1e-3, 0.6e-3}};
  for (unsigned int k = 0; k < 3; ++k)
    s.classes.push_back({1e10 * random.stiffness(true), random(1000., 3000.)});
  for (unsigned int k = 0; k < nx * ny; ++k)
    s.ids.push_back(random.integer(0, 2));
  s.step.beta2 = 0.6;
  s.step.beta  = 1e-8;
  s.choose_time_step(0.9);
  return s;
}

/** A quarter turn counter-clockwise: cell (i, j) goes to (ny - 1 - j, i). */
BodySetup turned(const BodySetup &s)
{
  BodySetup t = s;
  t.cells     = {{ny, nx}};
  t.spacing   = {{s.spacing[1], s.spacing[0]}};
  for (ElasticPhase<2> &c : t.classes)
    c.stiffness = rotate_stiffness<2>(c.stiffness, M_PI / 2.);
  for (unsigned int j = 0; j < ny; ++j)
    for (unsigned int i = 0; i < nx; ++i)
      t.ids[i * ny + ny - 1 - j] = s.ids[j * nx + i];
  return t;
}

NodalField<double> turned(const NodalField<double> &u)
{
  NodalField<double> t(ny + 1, nx + 1);
  for (unsigned int j = 0; j <= ny; ++j)
    for (unsigned int i = 0; i <= nx; ++i)
      {
        t.row(0, i)[ny - j] = -u.row(1, j)[i];
        t.row(1, i)[ny - j] = u.row(0, j)[i];
      }
  return t;
}

void vibrate(const BodySetup &s, NodalField<double> &u, NodalField<double> &w)
{
  const UniformMaterial material = s.material();
  ExplicitStepper stepper({material, s.step, u, w}, s.sides);
  stepper.advance(1000);
}
} // namespace

TEST(Symmetry, TurnedBodyVibratesTurned)
{
  Random random;
  SCOPED_TRACE(elasticity_testing::seed);
  const BodySetup s = upright(random), t  = turned(s);
  NodalField<double> u(nx + 1, ny + 1), w = u;
  random.fill(u);
  NodalField<double> u_turned = turned(u), w_turned = turned(w);
  const NodalField<double> start = u;
  vibrate(s, u, w);
  vibrate(t, u_turned, w_turned);
  EXPECT_LT(relative_difference(u_turned, turned(u)), 1e-11);
  EXPECT_LT(relative_difference(w_turned, turned(w)), 1e-11);
  EXPECT_GT(relative_difference(start, u), 0.1);
}
