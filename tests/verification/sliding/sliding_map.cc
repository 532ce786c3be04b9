// The map of the contact over time: a wave of the sliding layer travels through it as the
// dispersion relation says, and it takes part in no step.
#include "sliding_layer.h"

#include "../../measured.h"

#include <gtest/gtest.h>

using namespace verification;
using namespace verification::sliding_layer;

namespace
{
constexpr Layer mapped_layer = {1., 0.25, 1.5e-6, 4.4e-9};

/** Growth rate and circular frequency of one wave in @p rows [samples][n + 1]. */
Complex wave_in(const std::vector<double> &rows,
                const unsigned int n,
                const double dt,
                const double from)
{
  Amplitude amplitude;
  const std::size_t n_samples = rows.size() / n;
  for (std::size_t k = 0; k < n_samples; ++k)
    {
      Complex sum = 0.;
      for (unsigned int i = 0; i < n; ++i)
        sum += rows[k * n + i] * std::exp(-2. * M_PI * I * (double(i) / n));
      amplitude.add(static_cast<double>(k) * dt, sum);
    }
  return amplitude.rate(from);
}

BodySetup mapped(BodySetup setup, const std::uint64_t interval)
{
  setup.node_loads             = true;
  setup.contact_map.end        = 1000000;
  setup.contact_map.interval   = interval;
  setup.contact_map.quantities = {MapQuantity::pressure, MapQuantity::traction,
                                  MapQuantity::slip_velocity, MapQuantity::state,
                                  MapQuantity::friction_work};
  return setup;
}
} // namespace

TEST(ContactMap, WavesTravelAsTheDispersionRelationSays)
{
  const Complex s = mapped_layer.fastest();
  std::vector<double> errors;
  for (const unsigned int n : {20u, 40u})
    {
      constexpr unsigned int interval = 5;
      const BodySetup setup           = mapped(layer_setup(mapped_layer, n), interval);
      const double dt                 = setup.step.dt;
      Layer discrete                  = mapped_layer;
      discrete.dt                     = dt;
      const Complex exact             = discrete.root(s);
      Body body(setup);
      start_sliding(body, mapped_layer, s);
      body.run(std::lround(400e-6 / dt));
      const auto fields      = body.contact_map.take();
      const unsigned int n_x = setup.cells[0];
      double worst           = 0.;
      for (const unsigned int f : {0u, 1u, 2u}) // pressure, traction, slip velocity
        {
          const Complex seen = wave_in(fields[f], n_x, interval * dt, 150e-6);
          EXPECT_NEAR(seen.imag(), exact.imag(), 2e-3 * std::abs(exact.imag()));
          EXPECT_NEAR(seen.real(), exact.real(), 2e-2 * std::abs(exact.real()));
          worst = std::max(worst, std::abs(seen - exact) / std::abs(exact));
        }
      for (const double state : fields[3])
        ASSERT_EQ(state, 2.); // all slip
      errors.push_back(worst);
      measured::error("phase velocity of the wave in the map", n, worst);
    }
  EXPECT_NEAR(orders(errors).back(), 2., 0.3);
}

TEST(ContactMap, TakesPartInNoStep)
{
  const BodySetup plain = layer_setup(mapped_layer, 20);
  Body with(mapped(plain, 3)), without(plain);
  for (Body *body : {&with, &without})
    {
      start_sliding(*body, mapped_layer, mapped_layer.fastest());
      body->run(300);
    }
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < with.u.n_rows(); ++j)
      for (unsigned int i = 0; i < with.u.n_columns(); ++i)
        ASSERT_EQ(with.u.row(c, j)[i], without.u.row(c, j)[i]);
  EXPECT_EQ(with.contact.work().friction, without.contact.work().friction);
  double friction = 0.;
  for (const double energy : with.node_loads.loads().friction_energy)
    friction += energy;
  EXPECT_NEAR(friction, with.contact.work().friction,
              1e-12 * with.contact.work().friction);
}
