// Every law of the coefficient with every regularization of the friction (Law) and of the
// normal stress: a point mass on the moving flat under a normal force that changes, against
// the method of Runge and Kutta for the equations of doc/theory.md, section 3.

#include "contact/laws/friction_expression.h"
#include "contact/laws/friction_table.h"
#include "contact/laws/rate_and_state.h"
#include "contact/laws/slip_weakening.h"
#include "contact/laws/stribeck.h"
#include "contact_testing.h"

#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <string>

using namespace contact_testing;

namespace
{
constexpr double mass_on_flat = 0.03, block_area = 2e-6; // kg/m, m
constexpr double speed_of_flat = 2., duration = 0.01;    // m/s, s
constexpr double largest_force = 12.;                    // N/m

/** Pressing force (N/m), which begins with next to nothing: so nothing jumps. */
double pressing_at(const double time)
{
  const double x = std::sin(0.8 * M_PI * time / duration);
  return largest_force * (1e-9 + x * x);
}

/** A relaxation time: constant or length / (V + reference); 0: none. */
struct Lag
{
  std::string name;
  double time = 0., length = 0., reference = 0.;

  double at(const double slip_rate) const
  {
    return length > 0. ? length / (slip_rate + reference) : time;
  }
};

/** A law with mu(V, state, p) and d state/dt, written out once more. */
struct WrittenLaw
{
  std::string name;
  std::shared_ptr<const CoefficientLaw> law;
  std::function<double(double, double, double)> coefficient;
  std::function<double(double, double)> state_rate; ///< of V and the state
  double first_state = 0.;
};

std::vector<WrittenLaw> written_laws()
{
  const auto none           = [](const double, const double) { return 0.; };
  const auto slip           = [](const double V, const double) { return V; };
  const auto rate_and_state = [](const double V, const double theta) {
    return 0.02 *
           std::asinh(V / 2e-3 *
                      std::exp((0.6 + 0.03 * std::log(1e-3 * theta / 2e-3)) / 0.02));
  };
  const Healing never;
  std::vector<WrittenLaw> laws;
  laws.push_back({"constant", nullptr,
                  [](const double, const double, const double) { return 0.4; }, none});
  laws.push_back({"static and kinetic",
                  std::make_shared<Stribeck>(Stribeck::Constants{0.6, 0.3, 0.8, 1., 0.}),
                  [](const double V, const double, const double) {
                    return 0.3 + 0.3 * std::exp(-V / 0.8);
                  },
                  none});
  laws.push_back(
    {"Stribeck",
     std::make_shared<Stribeck>(Stribeck::Constants{0.6, 0.3, 0.8, 2.5, 0.01}),
     [](const double V, const double, const double) {
       return 0.3 + 0.3 * std::exp(-std::pow(V / 0.8, 2.5)) + 0.01 * V;
     },
     none});
  laws.push_back({"linear slip weakening",
                  std::make_shared<SlipWeakening>(
                    SlipWeakening::Constants{0.6, 0.1, 0.03, false, never}),
                  [](const double, const double D, const double) {
                    return 0.1 + 0.5 * std::max(0., 1. - D / 0.03);
                  },
                  slip});
  laws.push_back({"exponential slip weakening",
                  std::make_shared<SlipWeakening>(
                    SlipWeakening::Constants{0.6, 0.1, 8e-3, true, never}),
                  [](const double, const double D, const double) {
                    return 0.1 + 0.5 * std::exp(-D / 8e-3);
                  },
                  slip});
  for (const bool aging : {true, false})
    laws.push_back({aging ? "aging law" : "slip law",
                    std::make_shared<RateAndState>(
                      RateAndState::Constants{0.6, 0.02, 0.03, 2e-3, 1e-3, 0.01, aging}),
                    [rate_and_state](const double V, const double theta, const double) {
                      return rate_and_state(V, theta);
                    },
                    [aging](const double V, const double theta) {
                      const double x = V * theta / 2e-3;
                      return aging ? 1. - x : -x * std::log(x);
                    },
                    0.01});
  laws.push_back({"table",
                  std::make_shared<FrictionTable>(
                    FrictionTable::Points{{0., 4.}, {0., 1e7}, {0.6, 0.4, 0.4, 0.2}}),
                  [](const double V, const double, const double p) {
                    return 0.6 - 0.2 * V / 4. - 0.2 * p / 1e7;
                  },
                  none});
  laws.push_back({"expression",
                  std::make_shared<FrictionExpression>(
                    "0.2 + 0.3*exp(-V/0.8) - 2*D + p/1e8", 2, never),
                  [](const double V, const double D, const double p) {
                    return 0.2 + 0.3 * std::exp(-V / 0.8) - 2. * D + p / 1e8;
                  },
                  slip});
  return laws;
}

/** Velocity of the mass, friction, state of the law, remembered normal force. */
using Motion = std::array<double, 4>;

/** Limits of friction for what is remembered where something is, else for what is. */
double
target_of(const WrittenLaw &law, const Lag &memory, const double t, const Motion &y)
{
  const double N = pressing_at(t), V = speed_of_flat - y[0];
  return law.coefficient(V, y[2], N / block_area) * (memory.at(V) > 0. ? y[3] : N);
}

Motion rates(const WrittenLaw &law,
             const Lag &friction,
             const Lag &memory,
             const double t,
             const Motion &y)
{
  const double V = speed_of_flat - y[0], target = target_of(law, memory, t, y),
               delta = friction.at(V), t_pc = memory.at(V);
  return {{(delta > 0. ? y[1] : target) / mass_on_flat,
           delta > 0. ? (target - y[1]) / delta : 0., law.state_rate(V, y[2]),
           t_pc > 0. ? (pressing_at(t) - y[3]) / t_pc : 0.}};
}

/** Velocity and friction at the end. */
std::array<double, 2>
reference(const WrittenLaw &law, const Lag &friction, const Lag &memory)
{
  constexpr int steps = 4000;
  const double h      = duration / steps;
  const auto f        = [&](const double t, const Motion &y) {
    return rates(law, friction, memory, t, y);
  };
  const auto plus = [](Motion a, const double s, const Motion &b) {
    for (std::size_t k = 0; k < a.size(); ++k)
      a[k] += s * b[k];
    return a;
  };
  Motion y = {{0., 0., law.first_state, 0.}};
  for (int n = 0; n < steps; ++n)
    {
      const double t  = n * h;
      const Motion k1 = f(t, y), k2 = f(t + 0.5 * h, plus(y, 0.5 * h, k1)),
                   k3 = f(t + 0.5 * h, plus(y, 0.5 * h, k2)),
                   k4 = f(t + h, plus(y, h, k3));
      y = plus(plus(plus(plus(y, h / 6., k1), h / 3., k2), h / 3., k3), h / 6., k4);
    }
  return {{y[0], friction.at(speed_of_flat - y[0]) > 0.
                   ? y[1]
                   : target_of(law, memory, duration, y)}};
}

/** The same by the contact of the program in @p steps steps. */
std::array<double, 2>
advanced(const WrittenLaw &law, const Lag &friction, const Lag &memory, const int steps)
{
  const double dt           = duration / steps;
  ContactSetup setup        = contact_setup(1, 0.4, speed_of_flat, friction.time);
  setup.area                = {block_area};
  setup.law.coefficient_law = law.law;
  setup.law.reference       = 0.4;
  if (friction.length > 0.)
    setup.law.node_law =
      std::make_shared<SlipRateRegularization>(friction.length, friction.reference);
  setup.law.normal_stress = {memory.time, memory.length, memory.reference};
  Points block(setup, step_of(dt), {mass_on_flat});
  for (int n = 0; n <= steps; ++n)
    {
      block.load(0, 0., pressing_at(n * dt));
      block.advance();
      EXPECT_NEAR(block.pressing(), pressing_at(n * dt), 1e-9 * largest_force);
    }
  return {{block.history().nodes[0].vx.back(), block.friction()}};
}
} // namespace

TEST(LawRegularization, EveryLawWithEveryRegularization)
{
  const std::array<Lag, 3> frictions = {{{"coulomb", 0., 0., 0.},
                                         {"constant time", 1e-3, 0., 0.},
                                         {"slip rate", 0., 1.5e-3, 0.05}}},
                           memories  = {{{"instant", 0., 0., 0.},
                                         {"constant time", 2e-3, 0., 0.},
                                         {"slip rate", 0., 3e-3, 0.05}}};
  for (const WrittenLaw &law : written_laws())
    for (const Lag &friction : frictions)
      for (const Lag &memory : memories)
        {
          SCOPED_TRACE(law.name + ", Law = " + friction.name +
                       ", Normal stress = " + memory.name);
          const auto exact = reference(law, friction, memory);
          EXPECT_GT(exact[0], 0.2); // of the 2 m/s of the flat
          EXPECT_LT(exact[0], 1.8);
          std::array<double, 2> coarse, fine;
          for (const int steps : {200, 400})
            {
              const auto found = advanced(law, friction, memory, steps);
              for (std::size_t k = 0; k < 2; ++k)
                (steps == 200 ? coarse : fine)[k] = std::fabs(found[k] / exact[k] - 1.);
            }
          for (std::size_t k = 0; k < 2; ++k)
            {
              const char *const what = k == 0 ? "speed" : "friction";
              EXPECT_LT(fine[k], 1.5e-5) << what;
              if (fine[k] > 1e-12) // a constant coefficient alone is exact
                {
                  EXPECT_NEAR(std::log2(coarse[k] / fine[k]), 2., 0.05) << what;
                }
            }
        }
}
