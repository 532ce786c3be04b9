// Waves at an angle to the sliding of a layer in three dimensions: growth and frequency.

#include "../../measured.h"
#include "../sliding/oblique_layer.h"
#include "mesh_layer.h"

#include <gtest/gtest.h>

using namespace verification;
using namespace verification::sliding_layer;

namespace
{
/** @p n cells over the height, as @p bricks or of a mesh; half as many to a length along the
 * flat. */
MeshCase<3>
oblique_case(const ObliqueLayer &layer, const unsigned int n, const bool bricks = false)
{
  const double length   = 2. * M_PI / (layer.k() * layer.along());
  const bool plane      = layer.angle == 0.;
  const double width    = plane ? 2. * H / n : M_PI / (layer.k() * layer.across());
  const unsigned int nx = std::lround(length / H * n / 2.),
                     ny = std::lround(width / H * n / 2.);
  MeshCase<3> c;
  if (bricks)
    c = box_of_bricks({{nx, ny, n}}, {{length / nx, width / ny, H / n}});
  else
    c.mesh = brick<3>({{nx, ny, n}}, {{length, width, H}},
                      {false, plane || layer.delta > 0. ? 0. : 0.15});
  c.phases                                = {layer_material<3>()};
  c.friction                              = layer.mu;
  c.setup.contact.flat_velocity           = LoadHistory(layer.flat_velocity);
  c.setup.contact.law.time                = layer.delta;
  c.setup.contact.normal_spring.stiffness = layer.springs;
  c.setup.top.is_platen                   = false;
  c.setup.top.held                        = {{true, true, false}};
  c.setup.top.pressure                    = LoadHistory(P);
  c.setup.step.alpha                      = layer.alpha;
  c.setup.step.beta                       = layer.beta;
  for (const unsigned int side : {2, 3})
    c.hold(side, 1);
  return c;
}

/** From @p start to @p end (s). */
Complex observed_rate(const ObliqueLayer &layer,
                      LayerRun<3> &run,
                      const Complex s,
                      const double start,
                      const double end)
{
  const double seed = 1e-12, dt = run.setup.step.dt;
  const auto &D     = layer_material<3>().stiffness;
  const auto steady = [&](const double z, const unsigned int c) {
    return c == 0   ? layer.mu * P / D(4, 4) * (H - z)
           : c == 2 ? -P / D(2, 2) * z - P / layer.springs
                    : 0.;
  };
  run.set(
    [&](const auto &p, const unsigned int c) {
      return steady(p[2], c) + seed * layer.displacement(s, p, c).real();
    },
    [&](const auto &p, const unsigned int c) {
      return seed * ((1. - std::exp(-s * dt)) / dt * layer.displacement(s, p, c)).real();
    });
  Amplitude amplitude;
  for (unsigned int m = 0; m * dt < end; m += 2)
    {
      amplitude.add(m * dt, run.sum_below(0, [&](const auto &p) {
        return std::cos(layer.k() * layer.across() * p[1]) *
               std::exp(-I * layer.k() * layer.along() * p[0]);
      }));
      run.run(2);
    }
  EXPECT_TRUE(run.slipping);
  return amplitude.rate(start);
}

/** Of the wave that is the fastest at 0 degrees. */
void expect_growth_at_angles(ObliqueLayer layer,
                             const std::vector<unsigned int> &degrees,
                             const unsigned int n,
                             const double start,
                             const double end,
                             const bool bricks = false)
{
  Complex s = layer.fastest();
  EXPECT_LT(std::abs(layer.root_oblique(s) - s), 1e-6 * std::abs(s));
  unsigned int turned = 0;
  for (const unsigned int degree : degrees)
    {
      for (; turned <= degree; ++turned)
        {
          layer.angle = turned * M_PI / 180.;
          s           = layer.root_oblique(s);
        }
      LayerRun<3> run(oblique_case(layer, n, bricks));
      ObliqueLayer discrete = layer;
      discrete.dt = discrete.scheme_dt = run.setup.step.dt;
      const Complex due                = discrete.root_oblique(s),
                    found              = observed_rate(discrete, run, due, start, end);
      const std::string cells          = bricks ? ", bricks" : "";
      std::printf(
        "at %u degrees%s: growth %.1f (exact %.1f) 1/s at %.2f (%.2f) Hz; error "
        "%.4f %% of s, of the law in steps %.4f %%\n",
        degree, cells.c_str(), found.real(), s.real(), found.imag() / (2. * M_PI),
        s.imag() / (2. * M_PI), 100. * std::abs(found - due) / std::abs(s),
        100. * std::abs(due - s) / std::abs(s));
      measured::number("growth (1/s) of a wave at " + std::to_string(degree) +
                         " degrees" + cells,
                       s.real(), found.real());
      EXPECT_LT(std::abs(found - s), 0.01 * std::abs(s));
      EXPECT_NEAR(found.real(), s.real(), 0.01 * s.real());
    }
}
} // namespace

// The lateral drag counts: without it the wave at 60 degrees grows at another rate.
TEST(MeshWaves, AtAnAngleToTheMotionOfTheFlat)
{
  ObliqueLayer layer;
  static_cast<Layer &>(layer) = {1., 0.4, 0., 2e-8};
  layer.flat_velocity         = 4.;
  expect_growth_at_angles(layer, {0, 30, 45, 60}, 12, 5e-6, 50e-6);
}

TEST(MeshWaves, AtAnAngleOnSprings)
{
  ObliqueLayer layer;
  static_cast<Layer &>(layer) = {1., 0.4, 0., 2e-8};
  layer.springs               = 3e13;
  layer.alpha                 = 2e4;
  layer.flat_velocity         = 4.;
  expect_growth_at_angles(layer, {0, 45}, 12, 5e-6, 50e-6);
  expect_growth_at_angles(layer, {0, 45}, 12, 5e-6, 50e-6, true);
}

// The vector relaxes: friction across the motion lags as that along it does.
TEST(MeshWaves, AtAnAngleUnderFrictionThatLags)
{
  ObliqueLayer layer;
  static_cast<Layer &>(layer) = {1., 0.4, 1.5e-6, 4.4e-9};
  layer.flat_velocity         = 4.;
  // The friction memory that the seed lacks has to fade.
  expect_growth_at_angles(layer, {45}, 8, 150e-6, 300e-6);
}

TEST(BoxWaves, AtAllAngles)
{
  ObliqueLayer layer;
  static_cast<Layer &>(layer) = {1., 0.4, 0., 2e-8};
  layer.flat_velocity         = 4.;
  expect_growth_at_angles(layer, {0, 30, 45, 60}, 12, 5e-6, 50e-6, true);
}

// Bricks refined along all three axes.
TEST(BoxWaves, OfOrderTwoInTheCellSize)
{
  ObliqueLayer layer;
  static_cast<Layer &>(layer) = {1., 0.4, 0., 2e-8};
  layer.flat_velocity         = 4.;
  layer.angle                 = 0.25 * M_PI;
  const Complex s             = fastest_oblique(layer);
  std::vector<double> errors;
  for (const unsigned int n : {6, 12, 24})
    {
      LayerRun<3> run(oblique_case(layer, n, true));
      ObliqueLayer discrete = layer;
      discrete.dt = discrete.scheme_dt = run.setup.step.dt;
      const Complex due                = discrete.root_oblique(s),
                    found              = observed_rate(discrete, run, due, 5e-6, 50e-6);
      errors.push_back(std::abs(found - due) / std::abs(s));
      measured::error("growth of a wave at 45 degrees, box", n, errors.back());
      std::printf("box, H/%u: growth %.1f (exact %.1f) 1/s, error %.4f %% of s\n", n,
                  found.real(), s.real(), 100. * errors.back());
    }
  EXPECT_LT(errors.back(), 1e-3);
  EXPECT_NEAR(orders(errors).back(), 2., 0.2);
}
