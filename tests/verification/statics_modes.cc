// Free vibrations: exact frequencies, rigid motions, orthogonality; the paper's pin.

#include "../measured.h"
#include "body/grid_body.h"
#include "eigenvalues/vibration_modes.h"
#include "elasticity/uniform_grid_operator.h"
#include "material/stiffness.h"
#include "sliding/analyses/modal_cases.h"
#include "sliding/given_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace mesoslip;

namespace
{
constexpr double E = 30e9, nu = 0.2, density = 1770.;

double c_L()
{
  return std::sqrt(isotropic_stiffness<2>(E, nu)(0, 0) / density);
}

double c_T()
{
  return std::sqrt(isotropic_stiffness<2>(E, nu)(2, 2) / density);
}

UniformMaterial isotropic_body(const std::array<double, 2> &size,
                               const std::array<unsigned int, 2> &cells,
                               const bool periodic = false)
{
  const UniformGrid<2> grid{cells, {{size[0] / cells[0], size[1] / cells[1]}}};
  return UniformMaterial(grid, {{isotropic_stiffness<2>(E, nu), density}}, {},
                         {periodic, false});
}

/** A platen of this mass on the top of a grid, which moves along its normal. */
Platen platen_on(const UniformMaterial &material, const double mass)
{
  Platen platen;
  platen.moves = {{false, true, false}};
  platen.mass  = mass;
  for (unsigned int i = 0; i < material.n_columns(); ++i)
    platen.nodes.push_back({i, material.n_rows() - 1});
  return platen;
}

VibrationModes<2> modes(const UniformMaterial &material,
                        const DofMask &held,
                        const unsigned int n_modes,
                        const std::vector<Platen> &platens = {})
{
  VibrationModesOptions options;
  options.n_modes = n_modes;
  options.platens = platens;
  return vibration_modes<2>(GridBody<2>(material), held, options);
}

/** The zero of @p f between @p a and @p b, where it changes its sign. */
double zero_between(double a, double b, const std::function<double(double)> &f)
{
  for (unsigned int k = 0; k < 100; ++k)
    {
      const double middle                       = 0.5 * (a + b);
      ((f(a) > 0.) == (f(middle) > 0.) ? a : b) = middle;
    }
  return a;
}

DofMask nothing_held(const UniformMaterial &material)
{
  return DofMask(material.n_columns(), material.n_rows());
}
} // namespace

// Sides u_x = 0, top u_x = 0, bottom u_y = 0, nothing else:
// f = c/2 sqrt((m/L)^2 + ((2 n + 1) / (2 H))^2), c = c_L (m >= 0) or c_T (m >= 1).
TEST(Modes, OfTheRectangleConvergeWithOrderTwo)
{
  const double L = 56e-3, H = 16e-3;
  std::vector<double> exact;
  for (unsigned int m = 0; m < 8; ++m)
    for (unsigned int n = 0; n < 4; ++n)
      {
        const double k = 0.5 * std::hypot(m / L, (2 * n + 1) / (2. * H));
        exact.push_back(c_L() * k);
        if (m > 0)
          exact.push_back(c_T() * k);
      }
  std::sort(exact.begin(), exact.end());

  constexpr unsigned int n_modes = 6;
  std::array<std::array<double, n_modes>, 2> error;
  for (unsigned int level = 0; level < 2; ++level)
    {
      const auto material = isotropic_body({{L, H}}, {{56u << level, 16u << level}});
      DofMask held        = nothing_held(material);
      held.constrain_column(0, 0);
      held.constrain_column(0, material.n_columns() - 1);
      held.constrain_row(0, material.n_rows() - 1);
      held.constrain_row(1, 0);
      const VibrationModes<2> result = modes(material, held, n_modes);
      EXPECT_EQ(result.n_rigid_motions, 0u);
      for (unsigned int k = 0; k < n_modes; ++k)
        error[level][k] = result.modes[k].frequency / exact[k] - 1.;
    }
  for (unsigned int k = 0; k < n_modes; ++k)
    {
      EXPECT_LT(std::fabs(error[0][k]), 5e-3) << "mode " << k + 1;
      EXPECT_NEAR(error[0][k] / error[1][k], 4., 0.1) << "mode " << k + 1;
      for (unsigned int level = 0; level < 2; ++level)
        measured::error("modal analysis, mode " + std::to_string(k + 1), 16u << level,
                        error[level][k]);
    }
}

// Lame's mode of the free square is exact for every Poisson ratio: f = c_T / (sqrt(2) a).
TEST(Modes, OfTheFreeSquare)
{
  const double a      = 10e-3;
  const auto material = isotropic_body({{a, a}}, {{40, 40}});
  const auto result   = modes(material, nothing_held(material), 6);
  EXPECT_EQ(result.n_rigid_motions, 3u);
  double nearest = 1.;
  for (const VibrationMode<2> &mode : result.modes)
    {
      EXPECT_GT(mode.frequency, 0.3 * c_T() / a) << "no rigid motion among the modes";
      nearest =
        std::min(nearest, std::fabs(mode.frequency * std::sqrt(2.) * a / c_T() - 1.));
      // A free body's momentum is at rest.
      EXPECT_LT(mode.effective_mass[0] + mode.effective_mass[1], 1e-14);
    }
  EXPECT_LT(nearest, 2e-3);
}

TEST(Modes, CountRigidMotions)
{
  const auto body = isotropic_body({{2., 1.}}, {{24, 12}});
  DofMask held    = nothing_held(body);
  held.constrain_row(0, 12);
  EXPECT_EQ(modes(body, held, 1).n_rigid_motions, 2u) << "up, and a turn about the top";
  held = nothing_held(body);
  held.constrain_row(1, 0);
  EXPECT_EQ(modes(body, held, 1).n_rigid_motions, 1u) << "along x";
  held.constrain(0, {3, 3});
  EXPECT_EQ(modes(body, held, 1).n_rigid_motions, 0u);

  const auto layer = isotropic_body({{2., 1.}}, {{24, 12}}, true);
  EXPECT_EQ(modes(layer, nothing_held(layer), 1).n_rigid_motions, 2u);
}

// Layer periodic in x on a smooth flat, u_x = 0 on top: the lowest modes of width zero
// are those of a bar, c (2 n + 1) / (4 H); sines and cosines along x come in pairs.
TEST(Modes, OfThePeriodicLayer)
{
  const double L = 1., H = 1.;
  const auto layer = isotropic_body({{L, H}}, {{32, 32}}, true);
  DofMask held     = nothing_held(layer);
  held.constrain_row(0, layer.n_rows() - 1);
  held.constrain_row(1, 0);
  const auto result = modes(layer, held, 6);
  EXPECT_NEAR(result.modes[0].frequency / (c_T() / (4. * H)), 1., 1e-3);
  EXPECT_NEAR(result.modes[1].frequency / (c_L() / (4. * H)), 1., 1e-3);
  EXPECT_NEAR(result.modes[3].frequency /
                (0.5 * c_T() * std::hypot(2. / L, 1. / (2. * H))),
              1., 6e-3);
}

// Sides u_x = 0: a column of mass m under a platen of mass r m moves along y alone, so
// that with a = 2 pi f H / c_L, and the platen's M u'' = -D22 W u_y',
//   bottom held, u = sin(a y / H):   r a tan a = 1
//   bottom free, u = cos(a y / H):   r a + tan a = 0, and the rigid motion
TEST(Modes, OfAColumnUnderAPlatenWithMass)
{
  const double H = 16e-3, W = 0.5e-3, m = density * W * H, r = 0.7;
  for (const bool free : {false, true})
    {
      std::vector<double> exact;
      for (unsigned int n = 0; n < 3; ++n)
        {
          const double low  = free ? (n + 0.5) * M_PI : n * M_PI,
                       high = free ? (n + 1.) * M_PI : (n + 0.5) * M_PI;
          exact.push_back(zero_between(low + 1e-9, high - 1e-9,
                                       [&](const double a) {
                                         return free ? r * a + std::tan(a)
                                                     : r * a * std::tan(a) - 1.;
                                       }) *
                          c_L() / (2. * M_PI * H));
        }
      std::array<std::array<double, 3>, 2> error;
      for (unsigned int level = 0; level < 2; ++level)
        {
          const auto column = isotropic_body({{W, H}}, {{2, 32u << level}});
          DofMask held      = nothing_held(column);
          held.constrain_column(0, 0);
          held.constrain_column(0, 2);
          for (unsigned int c = 0; c < 2; ++c)
            held.constrain_row(c, column.n_rows() - 1);
          if (!free)
            held.constrain_row(1, 0);
          const auto result = modes(column, held, 3, {platen_on(column, r * m)});
          EXPECT_EQ(result.n_rigid_motions, free ? 1u : 0u);
          for (unsigned int k = 0; k < 3; ++k)
            error[level][k] = result.modes[k].frequency / exact[k] - 1.;
          // The first mode moves most of body and platen along y, as one if r is large.
          const double y = result.modes[0].effective_mass[1];
          EXPECT_TRUE(free ? y < 1e-12 : y > 0.8 && y < 1.) << y;
        }
      for (unsigned int k = 0; k < 3; ++k)
        {
          EXPECT_LT(std::fabs(error[0][k]), 1e-2) << free << " mode " << k + 1;
          EXPECT_NEAR(error[0][k] / error[1][k], 4., 0.1) << free << " mode " << k + 1;
        }
    }
}

// 40,037 and 41,589 Hz at h = 0.1 mm; the error falls as h^2. The platen of a run moves
// along y, which changes the modes that are even in x: 54,842 Hz for 55,817 Hz under a
// top that is held, and one more at 81,018 Hz.
TEST(Modes, OfThePaperPin)
{
  ContactParameters parameters;
  BodyDescription body;
  body.grid = {{{140, 40}}, {{4e-4, 4e-4}}};
  Phase<2> phase;
  phase.stiffness = stiffness_from_coefficients<2>({36.54e9, 9.1e9, 47.26e9, 13.785e9});
  phase.density   = 1770.;
  body.phases     = {phase};

  const auto material = make_material(body, MeanDilatation::never, false);
  const double free =
    modes(material,
          held_by_supports(material, parameters.sides, top_at_start(parameters), false),
          1)
      .modes[0]
      .frequency;
  const double held =
    modes(material,
          held_by_supports(material, parameters.sides, top_at_start(parameters), true), 1)
      .modes[0]
      .frequency;
  EXPECT_NEAR(free / 40037., 1., 1e-3);
  measured::number("bottom free (Hz), paper", 40000., free);
  measured::number("bottom held (Hz), paper", 41580., held);
  EXPECT_NEAR(held / 41589., 1., 1e-3);

  VibrationModesOptions options = parameters.modal;
  options.n_modes               = 3;
  options.platens               = {platen_on(material, parameters.top.platen_mass)};
  const auto platen             = vibration_modes<2>(
    GridBody<2>(material),
    held_by_supports(material, parameters.sides, top_at_start(parameters), true),
    options);
  EXPECT_NEAR(platen.modes[0].frequency / held, 1., 1e-6);
  EXPECT_NEAR(platen.modes[1].frequency / 54842., 1., 2e-3);
  EXPECT_NEAR(platen.modes[2].frequency / 81018., 1., 2e-3);

  parameters.top.hold_from = 0.;
  EXPECT_FALSE(top_at_start(parameters).is_platen) << "held from the start";
  options.platens.clear();
  const auto fixed = vibration_modes<2>(
    GridBody<2>(material),
    held_by_supports(material, parameters.sides, top_at_start(parameters), true),
    options);
  EXPECT_NEAR(fixed.modes[1].frequency / 55817., 1., 2e-3);
}
