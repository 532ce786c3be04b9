// Friction with two components: a mass on the flat under a constant force.

#include "contact/contact_surface.h"
#include "contact/laws/slip_weakening.h"
#include "contact/laws/stribeck.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

using namespace mesoslip;

namespace
{
constexpr double point_mass = 2., weight = 6., point_mu = 0.25; // kg, N

using Vector = std::array<double, 2>;

/** Relaxes in a constant time (s). */
FrictionLaw relaxing_in(const double delta)
{
  FrictionLaw law;
  law.time = delta;
  return law;
}

/** @p v turned by the angle (rad). */
Vector turned_by(const double angle, const Vector &v)
{
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c * v[0] - s * v[1], s * v[0] + c * v[1]}};
}

/** A point on the flat, which moves with its velocity along its direction. */
class Point
{
public:
  Point(const double dt,
        const FrictionLaw &law,
        const double flat_velocity,
        const Vector &velocity,
        const Vector &direction = {{1., 0.}})
    : u(1, 1, 3)
    , w(u)
    , force(u)
    , inverse_mass(u)
    , contact(setup(law, flat_velocity, direction), step(dt))
  {
    for (unsigned int c = 0; c < 3; ++c)
      {
        inverse_mass.row(c, 0)[0] = 1. / point_mass;
        w.row(c, 0)[0]            = c < 2 ? velocity[c] : 0.;
        view.u[c]                 = u.row(c, 0);
        view.w[c]                 = w.row(c, 0);
        view.force[c]             = force.row(c, 0);
        view.inverse_mass[c]      = inverse_mass.row(c, 0);
      }
    view.n = 1;
  }

  /** Pulls along the flat, besides this share of its weight. */
  void
  advance(const double pull_x = 0., const double pull_y = 0., const double share = 1.)
  {
    force.row(0, 0)[0] = -pull_x;
    force.row(1, 0)[0] = -pull_y;
    force.row(2, 0)[0] = share * weight;
    contact.advance(view);
    ++view.step;
  }

  NodalField<double> u, w, force, inverse_mass;
  ContactSurface<3> contact;

private:
  static ContactSetup
  setup(const FrictionLaw &law, const double flat_velocity, const Vector &direction)
  {
    ContactSetup s;
    s.law                  = law;
    s.friction_coefficient = {point_mu};
    s.flat_velocity        = LoadHistory(flat_velocity);
    s.flat_direction       = direction;
    return s;
  }

  static StepParameters step(const double dt)
  {
    StepParameters p;
    p.dt = dt;
    return p;
  }

  SurfaceView<3> view;
};
} // namespace

// Coulomb's force is along the slip and of constant size, so the slip keeps its direction
// and ends after |s| m / (mu F): on a moving flat, too.
TEST(FrictionVector, SlipGoesStraightAndEnds)
{
  const double V = 0.7, vx = 0.1, vy = 0.8, dt = 1e-4;
  const double slip         = std::hypot(V - vx, vy),
               deceleration = point_mu * weight / point_mass;
  Point p(dt, relaxing_in(0.), V, {{vx, vy}});
  const double end         = slip / deceleration;
  const unsigned int n_end = static_cast<unsigned int>(end / dt);
  for (unsigned int n = 1; n < n_end; ++n)
    {
      p.advance();
      const double left = 1. - n * dt / end;
      ASSERT_NEAR(p.w.row(0, 0)[0], V - (V - vx) * left, 1e-12) << n;
      ASSERT_NEAR(p.w.row(1, 0)[0], vy * left, 1e-12) << n;
      ASSERT_NEAR(p.contact.tangential_force()[0], point_mu * weight * (V - vx) / slip,
                  1e-10);
      ASSERT_NEAR(p.contact.lateral_force()[0], -point_mu * weight * vy / slip, 1e-10);
    }
  for (unsigned int n = 0; n < 10; ++n)
    p.advance();
  EXPECT_NEAR(p.w.row(0, 0)[0], V, 1e-12);
  EXPECT_NEAR(p.w.row(1, 0)[0], 0., 1e-12);
  EXPECT_EQ(p.contact.sums().sticking, 1.);
  // What friction took: in the frame of the flat all there was.
  EXPECT_NEAR(p.contact.work().friction, 0.5 * point_mass * slip * slip, 1e-3);
}

namespace
{
/** No direction is special: what happens along x happens along any. */
void expect_turned(const FrictionLaw &law, const double flat_velocity, const double angle)
{
  Point straight(1e-2, law, flat_velocity, {{0.6, 0.2}});
  Point turned(1e-2, law, flat_velocity, turned_by(angle, {{0.6, 0.2}}),
               turned_by(angle, {{1., 0.}}));
  bool stuck = false, slipped = false;
  for (unsigned int n = 0; n < 500; ++n)
    {
      const Vector pull  = {{2. * std::sin(0.05 * n), 1.3 * std::sin(0.11 * n + 1.)}},
                   askew = turned_by(angle, pull);
      straight.advance(pull[0], pull[1]);
      turned.advance(askew[0], askew[1]);
      const Vector u =
        turned_by(angle, {{straight.u.row(0, 0)[0], straight.u.row(1, 0)[0]}});
      ASSERT_NEAR(turned.u.row(0, 0)[0], u[0], 1e-11) << n;
      ASSERT_NEAR(turned.u.row(1, 0)[0], u[1], 1e-11) << n;
      ASSERT_NEAR(turned.contact.sums().tangential_force,
                  straight.contact.sums().tangential_force, 1e-9)
        << n;
      (straight.contact.sums().sticking > 0. ? stuck : slipped) = true;
    }
  EXPECT_TRUE(slipped);
  EXPECT_TRUE(stuck || law.coefficient_law); // rests too shortly where friction falls
  const BoundaryWork expected = straight.contact.work(), found = turned.contact.work();
  EXPECT_NEAR(found.friction, expected.friction, 1e-10);
  EXPECT_NEAR(found.external, expected.external, 1e-10);
  EXPECT_EQ(std::fabs(expected.external) > 1e-2, flat_velocity != 0.);
}
} // namespace

TEST(FrictionVector, TurnsWithPullAndFlat)
{
  FrictionLaw slip_rate;
  slip_rate.node_law = std::make_shared<SlipRateRegularization>(0.01, 0.1);
  FrictionLaw curve = relaxing_in(0.), weakening = relaxing_in(0.03);
  curve.coefficient_law =
    std::make_shared<Stribeck>(Stribeck::Constants{point_mu, 0.2, 0.3, 2., 0.02});
  weakening.coefficient_law = std::make_shared<SlipWeakening>(
    SlipWeakening::Constants{point_mu, 0.2, 0.2, true, {Healing::Kind::sticking, 0.}});
  weakening.normal_stress = {0.02, 0., 0.};
  for (FrictionLaw *law : {&curve, &weakening})
    law->reference = point_mu;
  for (const FrictionLaw &law :
       {relaxing_in(0.), relaxing_in(0.03), slip_rate, curve, weakening})
    for (const double flat_velocity : {0., 0.5})
      for (const double angle : {0.4, M_PI / 2., 1.3, 2.9, -2.2})
        expect_turned(law, flat_velocity, angle);
}

// Along any direction the law is that of the slip rate along it.
TEST(FrictionVector, SlowsDownAsTheLawSaysInAnyDirection)
{
  const Stribeck law({point_mu, 0.1, 0.3, 1., 0.});
  FrictionLaw friction     = relaxing_in(0.);
  friction.coefficient_law = std::make_shared<Stribeck>(law);
  friction.reference       = point_mu;
  const double v0 = 0.8, dt = 1e-4, g = weight / point_mass,
               ratio = (point_mu - 0.1) / 0.1;
  for (const double angle : {0., 0.7, M_PI / 2., 2.5})
    {
      Point p(dt, friction, 0., turned_by(angle, {{v0, 0.}}));
      for (unsigned int n = 0; n < 4000; ++n)
        p.advance();
      // exp(v / V_c) obeys a linear equation; w began half a step before.
      const double t = (4000. - 0.5) * dt + 0.5 * dt,
                   y =
                     (std::exp(v0 / 0.3) + ratio) * std::exp(-g * 0.1 * t / 0.3) - ratio;
      EXPECT_NEAR(std::hypot(p.w.row(0, 0)[0], p.w.row(1, 0)[0]), 0.3 * std::log(y),
                  1e-7);
      EXPECT_NEAR(
        std::remainder(std::atan2(p.w.row(1, 0)[0], p.w.row(0, 0)[0]) - angle, 2. * M_PI),
        0., 1e-12);
    }
}

// Against a slip that turns by a right angle the vector follows with its time delta
// (eq. 7): exp(-t / delta) of the old direction is left.
TEST(FrictionVector, RelaxesTowardsTheNewDirection)
{
  const double delta = 0.05, dt = 1e-4, v = 1e3; // too fast to change its direction
  Point p(dt, relaxing_in(delta), 0., {{v, 0.}});
  for (unsigned int n = 0; n < 20000; ++n)
    p.advance();
  EXPECT_NEAR(p.contact.tangential_force()[0], -point_mu * weight, 1e-10);
  p.w.row(0, 0)[0] = 0.;
  p.w.row(1, 0)[0] = v;
  for (unsigned int n = 0; n < 2; ++n)
    p.advance(); // the target turns by half where the velocity jumps, then by the rest
  const double first[] = {p.contact.tangential_force()[0], p.contact.lateral_force()[0]};
  for (unsigned int n = 1; n <= 1000; ++n)
    {
      p.advance();
      const double left = std::exp(-(n * dt) / delta);
      ASSERT_NEAR(p.contact.tangential_force()[0], first[0] * left, 1e-4) << n;
      ASSERT_NEAR(p.contact.lateral_force()[0],
                  -point_mu * weight + (first[1] + point_mu * weight) * left, 1e-4)
        << n;
    }
}

namespace
{
/** Where the point is after 0.4 s of a slip that turns, in so many steps. Its weight grows. */
Vector turned_in(const unsigned int n_steps, const double delta)
{
  const double dt   = 0.4 / n_steps;
  const Vector pull = {{0.4, 1.9}};
  // A velocity is that half a step before.
  Point p(
    dt, relaxing_in(delta), 0.5,
    {{0.1 - 0.5 * dt * pull[0] / point_mass, 0.6 - 0.5 * dt * pull[1] / point_mass}});
  for (unsigned int n = 0; n < n_steps; ++n)
    p.advance(pull[0], pull[1], double(n) / n_steps);
  EXPECT_EQ(p.contact.sums().sticking, 0.);
  return {{p.u.row(0, 0)[0], p.u.row(1, 0)[0]}};
}
} // namespace

TEST(FrictionVector, TurnsToSecondOrder)
{
  for (const double delta : {0., 0.03})
    {
      const Vector coarse = turned_in(100, delta), middle = turned_in(200, delta),
                   fine = turned_in(400, delta);
      for (unsigned int k = 0; k < 2; ++k)
        EXPECT_NEAR((middle[k] - coarse[k]) / (fine[k] - middle[k]), 4., 0.2)
          << "delta " << delta << ", component " << k;
    }
}
