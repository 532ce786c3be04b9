// Waves in a layer in three dimensions that slides: those across the motion of the flat.

#include "../../measured.h"
#include "mesh_layer.h"

#include <gtest/gtest.h>

using namespace verification;
using namespace verification::sliding_layer;

namespace
{
/** To waves along y the flat that moves along x is a dashpot mu p / V (theory.md, 3). */
struct LateralLayer : Layer
{
  double flat_velocity;

  /** G (b^2 - k^2) = eta s (k^2 tanh(aH)/a - b tanh(bH)), without the poles of tanh. */
  Complex across(const Complex s) const
  {
    const double k2 = k() * k();
    // Friction is along the slip around its instant; damping acts a step late.
    const bool steps   = scheme_dt > 0.;
    const Complex rate = steps ? std::sinh(s * scheme_dt) / scheme_dt : s,
                  flow = steps ? (1. - std::exp(-s * scheme_dt)) / scheme_dt : s;
    const Complex a = decay(s, c_L()), b = decay(s, c_T);
    const Complex eta = mu * P / (1900. * c_T * c_T * flat_velocity);
    return inertia(s) / (c_T * c_T) * std::cosh(a * H) * std::cosh(b * H) -
           eta * rate / (1. + beta * flow) *
             (k2 * std::sinh(a * H) * std::cosh(b * H) / a -
              b * std::sinh(b * H) * std::cosh(a * H));
  }

  /** The root near @p s by Newton's method. */
  Complex root_across(Complex s) const
  {
    for (unsigned int n = 0; n < 60; ++n)
      {
        const double step = 1e-6 * std::abs(s);
        s -= across(s) * 2. * step / (across(s + step) - across(s - step));
      }
    return s;
  }
};

/** One cell thick and periodic along x, with walls along y half a wave apart. */
MeshCase<3>
lateral_case(const LateralLayer &layer, const unsigned int n, const bool held = false)
{
  const double length   = M_PI / layer.k();
  const unsigned int ny = std::lround(length / H * n);
  MeshCase<3> c;
  c.mesh = brick<3>({{1, ny, n}}, {{H / n, length, H}});
  for (auto &p : c.mesh.points)
    {
      // Distorted, alike on both sides.
      const double inside = std::sin(M_PI * p[1] / length) * std::sin(M_PI * p[2] / H);
      p[1] += 0.3 * inside * H / n * std::sin(7. * p[2] / H + 40. * p[1] / length);
      p[2] += 0.3 * inside * H / n * std::sin(11. * p[2] / H - 50. * p[1] / length);
    }
  c.phases                      = {layer_material<3>()};
  c.friction                    = layer.mu;
  c.setup.contact.flat_velocity = LoadHistory(layer.flat_velocity);
  c.setup.contact.law.time      = 0.;
  c.setup.top.is_platen         = false;
  c.setup.top.held              = {{true, true, false}};
  c.setup.top.pressure          = LoadHistory(P);
  c.setup.step.beta             = layer.beta;
  for (const unsigned int side : {2, 3})
    c.hold(side, 1);
  for (const unsigned int side : {0, 1})
    if (held)
      c.hold(side, 0);
  return c;
}

/** What the standing wave sin(k y) does that starts as the exact one. */
Complex lateral_rate(const LateralLayer &layer, LayerRun<3> &run, const Complex s)
{
  const auto &D  = layer_material<3>().stiffness;
  const double k = layer.k(), seed = 1e-12, dt = run.setup.step.dt;
  const auto wave = [&](const dealii::Point<3> &p, const unsigned int c,
                        const Complex factor) {
    return c == 0 ? 0.
           : c == 1
             ? seed * (I * factor * layer.shape(s, p[2], 0)).real() * std::sin(k * p[1])
             : seed * (factor * layer.shape(s, p[2], 1)).real() * std::cos(k * p[1]);
  };
  const auto steady = [&](const double z, const unsigned int c) {
    return c == 0 ? layer.mu * P / D(4, 4) * (H - z) : c == 2 ? -P / D(2, 2) * z : 0.;
  };
  run.set(
    [&](const auto &p, const unsigned int c) { return steady(p[2], c) + wave(p, c, 1.); },
    [&](const auto &p, const unsigned int c) {
      return wave(p, c, (1. - std::exp(-dt * s)) / dt);
    });
  const unsigned int every = std::lround(0.4 / (std::abs(s.imag()) * dt));
  std::vector<double> samples;
  for (unsigned int m = 0; m < 18; ++m)
    {
      samples.push_back(
        run.sum_below(1, [&](const auto &p) { return std::sin(k * p[1]); }));
      run.run(every);
    }
  EXPECT_TRUE(run.slipping);
  const Complex found = rate_of(samples, every * dt);
  return Complex(found.real(), std::copysign(found.imag(), s.imag()));
}
} // namespace

// Frequency and decay of waves along y under the friction that the flat, moving along x,
// has left for them.
TEST(MeshWaves, AcrossTheMotionOfTheFlat)
{
  for (const double flat_velocity : {4., 2.})
    for (const double beta : {0., 2e-8})
      {
        LateralLayer layer;
        static_cast<Layer &>(layer) = {1., 0.5, 0., beta};
        layer.flat_velocity         = flat_velocity;
        // From the layer without friction, b H = i pi / 2.
        Complex s = I * c_T * std::hypot(layer.k(), 0.5 * M_PI / H);
        for (const double share : {0.25, 0.5, 0.75, 1.})
          {
            layer.flat_velocity = flat_velocity / share;
            s                   = layer.root_across(s);
          }
        std::vector<double> errors;
        for (const unsigned int n : {10, 20})
          {
            LayerRun<3> run(lateral_case(layer, n));
            LateralLayer discrete = layer;
            discrete.scheme_dt    = run.setup.step.dt;
            const Complex due     = discrete.root_across(s),
                          found   = lateral_rate(layer, run, s);
            errors.push_back(std::abs(found - due) / std::abs(s));
            std::printf(
              "V = %g, beta = %g, H/%u: decay %.1f 1/s at %.2f Hz, error %.4f %% of s, "
              "of the law %.4f %%\n",
              flat_velocity, beta, n, -found.real(), found.imag() / (2. * M_PI),
              100. * errors.back(), 100. * std::abs(due - s) / std::abs(s));
          }
        EXPECT_LT(s.real(), -0.02 * std::abs(s));
        EXPECT_LT(errors.back(), 1e-3);
        EXPECT_NEAR(orders(errors).back(), 2., 0.5);
        // The law itself.
        LayerRun<3> fine(lateral_case(layer, 20), 0.2);
        LateralLayer discrete = layer;
        discrete.scheme_dt    = fine.setup.step.dt;
        const Complex found   = lateral_rate(discrete, fine, discrete.root_across(s));
        EXPECT_LT(std::abs(found - s), 1e-3 * std::abs(s));
        measured::number("frequency (Hz) of a wave across the motion, V = " +
                           std::to_string(std::lround(flat_velocity)) + " m/s" +
                           (beta > 0. ? ", damped" : ""),
                         s.imag() / (2. * M_PI), found.imag() / (2. * M_PI));
      }
}

// Whether the body moves along x or not, across it the flat brakes it alike.
TEST(MeshWaves, AcrossTheMotionOfTheFlatWhereTheBodyIsHeldAlongIt)
{
  for (const double flat_velocity : {4., 2., 0.1})
    {
      LateralLayer layer;
      static_cast<Layer &>(layer) = {1., 0.5, 0., 2e-8};
      layer.flat_velocity         = flat_velocity;
      LayerRun<3> run(lateral_case(layer, 10)), held(lateral_case(layer, 10, true));
      const Complex s           = I * c_T * std::hypot(layer.k(), 0.5 * M_PI / H);
      const Complex moving_rate = lateral_rate(layer, run, s),
                    held_rate   = lateral_rate(layer, held, s);
      EXPECT_LT(std::abs(held_rate - moving_rate), 1e-4 * std::abs(s))
        << held_rate << moving_rate;
    }
}
