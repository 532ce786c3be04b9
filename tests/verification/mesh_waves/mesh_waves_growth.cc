// Growth of steady sliding of a layer on meshes, as sliding_growth.cc on grids.

#include "../../measured.h"
#include "mesh_layer.h"

#include <gtest/gtest.h>

using namespace verification;
using namespace verification::sliding_layer;

namespace
{
MeshCase<2> layer_case(const Layer &layer, const unsigned int n, const Cells &kind)
{
  const BodySetup grid = layer_setup(layer, n);
  MeshCase<2> c;
  c.mesh           = brick<2>(grid.cells, {{2. * M_PI / layer.k(), H}}, kind);
  c.phases         = {layer_material<2>()};
  c.friction       = layer.mu;
  c.setup          = grid;
  c.setup.periodic = false; // LayerRun is
  return c;
}

/** The wave on the lowest points every ten steps, of a seed of this size (m). */
std::vector<Complex>
history(const Layer &layer, const MeshCase<2> &body, const Complex s, const double seed)
{
  LayerRun<2> run(body);
  const double dt   = run.setup.step.dt;
  const auto &D     = layer_material<2>().stiffness;
  const auto steady = [&](const double y, const unsigned int c) {
    return c == 0 ? layer.mu * P / D(2, 2) * (H - y) : -P / D(1, 1) * y;
  };
  const auto wave = [&](const auto &p, const unsigned int c, const Complex factor) {
    return seed *
           (factor * layer.shape(s, p[1], c) * std::exp(I * layer.k() * p[0])).real();
  };
  run.set(
    [&](const auto &p, const unsigned int c) { return steady(p[1], c) + wave(p, c, 1.); },
    [&](const auto &p, const unsigned int c) {
      return wave(p, c, s * std::exp(-0.5 * dt * s));
    });
  std::vector<Complex> amplitudes;
  while (10 * amplitudes.size() * dt < 400e-6)
    {
      amplitudes.push_back(
        run.sum_below(0, [&](const auto &p) { return std::exp(-I * layer.k() * p[0]); }));
      run.run(10);
    }
  EXPECT_TRUE(run.slipping);
  return amplitudes;
}

/** What the seed makes of a run: sliding begins without friction, and what that sets in
 * motion an irregular mesh scatters into all waves. */
Complex growth(const Layer &layer, const MeshCase<2> &c, const Complex s, const double dt)
{
  const auto with = history(layer, c, s, 1e-11), without = history(layer, c, s, 0.);
  Amplitude amplitude;
  for (std::size_t m = 0; m < with.size(); ++m)
    amplitude.add(10 * m * dt, with[m] - without[m]);
  return amplitude.rate(150e-6);
}

void expect_growth(const Cells &kind,
                   const std::string &name,
                   const std::vector<unsigned int> &sizes)
{
  const Layer layer = {1., 0.25, 1.5e-6, 4.4e-9};
  const Complex s   = layer.fastest();
  EXPECT_NEAR(s.real(), 23574.532, 2e-3);
  std::vector<double> errors;
  for (const unsigned int n : sizes)
    {
      const MeshCase<2> c = layer_case(layer, n, kind);
      Layer discrete      = layer;
      discrete.dt         = LayerRun<2>(c).setup.step.dt;
      const Complex found = growth(layer, c, s, discrete.dt);
      errors.push_back(std::abs(found - discrete.root(s)) / std::abs(s));
      measured::error("growth on a mesh of " + name, n, errors.back());
      std::printf("%s, H/%u: growth %.1f 1/s at %.2f Hz; error %.5f %% of s\n",
                  name.c_str(), n, found.real(), std::abs(found.imag()) / (2. * M_PI),
                  100. * errors.back());
    }
  EXPECT_LT(errors.back(), 2e-4);
  EXPECT_NEAR(orders(errors).back(), 2., 0.3);
}
} // namespace

TEST(MeshGrowth, OnQuadrilaterals)
{
  expect_growth({false, 0.2}, "distorted quadrilaterals", {20, 40});
}

TEST(MeshGrowth, OnTriangles)
{
  expect_growth({true, 0.1}, "distorted triangles", {10, 20});
}
