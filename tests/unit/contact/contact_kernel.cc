#include "contact/contact_kernel.h"

#include "contact_testing.h"

#include <cstring>
#include <gtest/gtest.h>
#include <random>

using namespace contact_testing;

namespace
{
constexpr unsigned int seed = 20241203;

/** One node as doc/theory.md, section 3, has it, branch by branch. */
struct ReferenceNode
{
  double m, mu, gap, delta;
  double ux, uy, wx, wy;
  double memory = 0., target_before = 0., ux_before = 0., uy_before = 0.;
  double friction_energy = 0., impact_energy = 0.;
  enum
  {
    separated,
    sticks,
    slips
  } status   = separated;
  double f_n = 0., f_t = 0.;

  void advance(const double fx,
               const double fy,
               const StepParameters &p,
               const double V,
               const double V_before)
  {
    const double dt = p.dt, b = p.beta2, kappa = dt * dt * (0.5 + b) / m;
    const double ax = -fx / m, ay = -fy / m;
    const double du = dt * (wx + dt * ax) + (b - 0.5) * dt * dt * ax;
    const double g  = gap + uy + dt * (wy + dt * ay) + (b - 0.5) * dt * dt * ay;
    f_n = f_t               = 0.;
    status                  = separated;
    const double target_old = target_before;
    target_before           = 0.;
    if (g < 0.)
      {
        f_n                 = -g / kappa;
        const double fstick = (V * dt - du) / kappa;
        const double target = std::copysign(mu * f_n, fstick);
        target_before       = target;
        if (std::abs(fstick) <= mu * f_n)
          {
            status = sticks;
            f_t    = fstick;
          }
        else
          {
            status         = slips;
            const double x = dt / delta, q = std::exp(-x), mean = (1. - q) / x;
            f_t = delta > 0. ? q * memory + (mean - q) * target_old + (1. - mean) * target
                             : target;
            if (f_t * fstick > 0. && std::abs(f_t) > std::abs(fstick))
              f_t = fstick;
          }
      }
    memory         = f_t;
    const double x = ux, y = uy;
    wx += dt * (ax + f_t / m);
    wy += dt * (ay + f_n / m);
    ux += dt * wx + (b - 0.5) * dt * dt * (ax + f_t / m);
    uy += dt * wy + (b - 0.5) * dt * dt * (ay + f_n / m);
    friction_energy += f_t * 0.5 * ((V + V_before) * dt - (ux - ux_before));
    impact_energy -= f_n * 0.5 * (uy - uy_before);
    ux_before = x;
    uy_before = y;
  }
};
} // namespace

TEST(ContactKernel, EqualsTheBranchesNodeByNode)
{
  SCOPED_TRACE(seed);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> random(0., 1.);
  for (const double delta : {0., 3e-2})
    for (const double b : {0.5, 0.9})
      for (const unsigned int n : {1u, 7u, 8u, 9u, 31u})
        {
          const StepParameters p = step_of(1e-2, b);
          ContactSetup setup     = contact_setup(n, 0., 0., delta);
          setup.gap              = 0.001;
          setup.flat_velocity    = LoadHistory(1., "0.3*sin(3*t)");
          std::vector<double> masses;
          for (unsigned int i = 0; i < n; ++i)
            {
              masses.push_back(0.5 + random(generator));
              setup.friction_coefficient[i] = random(generator);
            }
          Points points(setup, p, masses);
          std::vector<ReferenceNode> reference;
          for (unsigned int i = 0; i < n; ++i)
            {
              const double x = random(generator) - 0.5, y = 0.01 * random(generator);
              const double vx = random(generator) - 0.5, vy = random(generator) - 0.5;
              points.u.row(0, 0)[i] = x;
              points.u.row(1, 0)[i] = y;
              points.w.row(0, 0)[i] = vx;
              points.w.row(1, 0)[i] = vy;
              ReferenceNode node{
                masses[i], setup.friction_coefficient[i], setup.gap, delta, x, y, vx, vy};
              node.ux_before = x - p.dt * vx;
              node.uy_before = y - p.dt * vy;
              reference.push_back(node);
            }
          std::vector<std::array<unsigned int, 3>> count(n);
          for (unsigned int k = 0; k < 2000; ++k)
            {
              double friction = 0., impact = 0., normal = 0., tangential = 0.;
              std::array<unsigned int, 3> states = {};
              for (unsigned int i = 0; i < n; ++i)
                {
                  const double t = k * p.dt, right = std::sin(2. * t + i);
                  const double down = 1. + 1.5 * std::sin(1.3 * t + 0.7 * i);
                  points.load(i, right, down);
                  reference[i].advance(-right, down, p, 0.3 * std::sin(3. * t),
                                       0.3 * std::sin(3. * std::max(0., t - p.dt)));
                  friction += reference[i].friction_energy;
                  impact += reference[i].impact_energy;
                  normal += reference[i].f_n;
                  tangential += reference[i].f_t;
                  ++states[reference[i].status];
                  ++count[i][reference[i].status];
                }
              points.advance();
              const auto &h = points.history();
              for (unsigned int i = 0; i < n; ++i)
                {
                  ASSERT_NEAR(points.u.row(0, 0)[i], reference[i].ux, 1e-9);
                  ASSERT_NEAR(points.u.row(1, 0)[i], reference[i].uy, 1e-9);
                  ASSERT_NEAR(points.pressing(i), reference[i].f_n, 1e-7);
                  ASSERT_NEAR(points.friction(i), reference[i].f_t, 1e-7);
                }
              ASSERT_EQ(h.separated.back(), states[0]) << k;
              ASSERT_EQ(h.sticking.back(), states[1]) << k;
              ASSERT_EQ(h.slipping.back(), states[2]) << k;
              ASSERT_NEAR(h.normal_force.back(), normal, 1e-6);
              ASSERT_NEAR(h.tangential_force.back(), tangential, 1e-6);
              ASSERT_NEAR(points.contact.work().friction, friction, 1e-8);
              ASSERT_NEAR(points.contact.work().impact, impact, 1e-8);
            }
          const NodeCounts counts          = points.counts();
          std::array<unsigned int, 3> seen = {};
          for (unsigned int i = 0; i < n; ++i)
            {
              EXPECT_EQ(counts.stick[i], count[i][1]);
              EXPECT_EQ(counts.slip[i], count[i][2]);
              for (unsigned int s = 0; s < 3; ++s)
                seen[s] += count[i][s];
            }
          for (unsigned int s = 0; s < 3 && n > 1; ++s)
            EXPECT_GT(seen[s], 20u) << "status " << s << " hardly seen";
        }
}

template <int dim>
void expect_the_same_bits(const bool profile)
{
  SCOPED_TRACE(seed);
  constexpr std::size_t n = 40;
  const auto advanced     = [&](const InstructionSet isa, ContactSums &sums) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> random(-1., 1.);
    using Arrays = ContactArrays;
    NodalField<double> values(n, 1, 27 + Arrays::n_columns);
    unsigned int next = 0;
    const auto row    = [&](const double centre, const double width) {
      double *r = values.row(next++, 0);
      for (std::size_t i = 0; i < n; ++i)
        r[i] = centre + width * random(generator);
      return r;
    };
    Arrays a = {};
    a.n      = n;
    for (const unsigned int c : {0u, 1u, 2u})
      {
        a.force[c]        = row(5. * (c == 1), 10.);
        a.inverse_mass[c] = row(1., 0.3);
        a.u[c]            = row(0., 1e-3);
        a.w[c]            = row(0., 0.1);
      }
    for (double *&column : a.column)
      column = row(0.5, 0.5);
    a.column[Arrays::gap] = row(0., 1e-4);
    for (const auto c : {Arrays::rise, Arrays::rise_before})
      a.column[c] = row(0., 1e-4);
    for (const auto c : {Arrays::softness, Arrays::slackness})
      {
        a.column[c] = row(1e-4, 1e-4); // about that of the nodes, or none
        for (std::size_t i = c % 2; i < n; i += 3)
          a.column[c][i] = 0.;
      }
    for (const auto c : {Arrays::stretch, Arrays::stretch_before, Arrays::lateral_stretch,
                         Arrays::lateral_stretch_before})
      a.column[c] = row(0., 1e-4);
    for (const auto c : {Arrays::increment_x, Arrays::increment_y})
      a.column[c] = row(0., 1e-3);
    for (const auto c : {Arrays::tangential_force, Arrays::target, Arrays::lateral_force,
                         Arrays::lateral_target})
      a.column[c] = row(0., 5.);
    for (std::size_t i = 0; i < n; ++i)
      {
        a.column[Arrays::decided][i] = i % 7 == 3 ? 0. : i % 7 == 5 ? 1. : -1.;
        a.column[Arrays::friction_coefficient][i] *= 4.; // so that some stick
      }
    for (unsigned int k = 0; k < 5; ++k)
      contact_function<dim>(isa, profile)(a, {1e-2, 0.7, {1e-3, -4e-4}, {0.6, 0.8}},
                                          sums);
    return values;
  };
  ContactSums first;
  const NodalField<double> expected = advanced(InstructionSet::baseline, first);
  EXPECT_GT(first.sticking, 0.);
  EXPECT_GT(first.slipping, 0.);
  EXPECT_LT(first.sticking + first.slipping, n);
  for (const InstructionSet isa : available_instruction_sets())
    {
      ContactSums sums;
      const NodalField<double> found = advanced(isa, sums);
      EXPECT_TRUE(
        std::equal(expected.begin(), expected.begin() + expected.size(), found.begin()))
        << to_string(isa);
      EXPECT_EQ(std::memcmp(&sums, &first, sizeof sums), 0) << to_string(isa);
    }
}

TEST(ContactKernel, TheSameBitsFromEveryInstructionSet)
{
  for (const bool profile : {false, true})
    {
      expect_the_same_bits<2>(profile);
      expect_the_same_bits<3>(profile);
    }
}

TEST(ContactKernel, NaNDoesNotHide)
{
  Points points(contact_setup(3, 0.3, 1., 0.), step_of(1e-3), {1., 1., 1.});
  for (unsigned int i = 0; i < 3; ++i)
    points.load(i, 0., 1.);
  points.advance();
  EXPECT_TRUE(std::isfinite(points.contact.work().friction));
  points.w.row(0, 0)[1] = std::nan("");
  points.advance();
  EXPECT_TRUE(std::isnan(points.contact.work().friction));
}
