// Statics and modes of layers on meshes whose opposite points move together. Runs on any
// number of ranks.

#include "../mesh_sliding/mesh_sliding.h"
#include "base/exchange.h"
#include "body/mesh/mesh_body.h"
#include "body/rigid_motions.h"
#include "contact/static_contact_solver.h"
#include "divided_body.h"
#include "eigenvalues/vibration_modes.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace mesoslip;

namespace
{
const dealii::Point<3> layer_size(1.6, 1.2, 1.);
constexpr double layer_density       = 1.5;
const VoigtMatrix<3> layer_stiffness = isotropic_stiffness<3>(2., 0.3);

/** @p n cells over the height, periodic along x and, if wanted, y. */
MeshBodyInput<3>
layer_of(const unsigned int n, const verification::Cells &kind, const bool along_y = true)
{
  verification::MeshCase<3> c;
  c.mesh = verification::brick<3>({{3 * n / 2, n, n}},
                                  {{layer_size[0], layer_size[1], layer_size[2]}}, kind);
  c.join(0);
  if (along_y)
    c.join(1);
  MeshBodyInput<3> body;
  body.mesh        = c.mesh;
  body.mesh.phases = {"layer"};
  body.phases      = {{layer_stiffness, layer_density}};
  body.periodicity = {true, along_y};
  return body;
}

/** With all points at the height @p z held. */
DofMask
held_at(const ElasticBody<3> &body, const double z, const unsigned int n_components)
{
  DofMask mask(body.n_columns(), 1);
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    for (unsigned int c = 0; c < n_components; ++c)
      if (std::fabs(body.point({i, 0})[2] - z) < 1e-9)
        mask.constrain(c, {i, 0});
  return mask;
}

/** u_c of a wave sin(pi z / 2 H) cos(2 pi n x / L), along x or y, or sin(...). */
struct LayerWave
{
  unsigned int component; ///< that moves
  unsigned int axis;      ///< along which it changes
  double number;          ///< of waves in the layer

  double at(const std::array<double, 3> &p, const double phase) const
  {
    return std::sin(0.5 * M_PI * p[2] / layer_size[2]) *
           std::cos(2. * M_PI * number * p[axis] / layer_size[axis] - phase);
  }

  /** Hz, of shear waves or, where the layer moves along z, of pressure waves. */
  double frequency() const
  {
    const double modulus = component == 2 ? layer_stiffness(2, 2) : layer_stiffness(3, 3);
    const double k       = 2. * M_PI * number / layer_size[axis];
    return std::sqrt(modulus / layer_density) *
           std::hypot(k, 0.5 * M_PI / layer_size[2]) / (2. * M_PI);
  }
};

/** Share of a shape that is such a wave, of any phase; where nothing changes along the flat,
 * in any direction along it. */
double likeness(const ElasticBody<3> &body,
                const NodalField<double> &shape,
                const LayerWave &wave)
{
  if (wave.number == 0. && wave.component == 0)
    return likeness(body, shape, {0, 0, 1e-9}) + likeness(body, shape, {1, 0, 1e-9});
  double share = 0., all = 0.;
  for (const double phase : {0., 0.5 * M_PI})
    {
      std::vector<double> sums(3, 0.);
      for (unsigned int i = 0; i < body.n_columns(); ++i)
        if (body.is_counted({i, 0}))
          {
            const double w = wave.at(body.point({i, 0}), phase);
            sums[0] += w * shape.row(wave.component, 0)[i];
            sums[1] += w * w;
            for (unsigned int c = 0; c < 3; ++c)
              sums[2] += shape.row(c, 0)[i] * shape.row(c, 0)[i];
          }
      sum_over_ranks(sums, body.communicator());
      const double product = sums[0], of_wave = sums[1];
      all = sums[2];
      share += of_wave > 1e-9 ? product * product / of_wave : 0.;
    }
  return share / all;
}

/** Relative errors of the modes that are such a wave, of which there have to be some. */
double error_of(const ElasticBody<3> &body,
                const VibrationModes<3> &found,
                const LayerWave &wave,
                const unsigned int expected)
{
  double error   = 0.;
  unsigned int n = 0;
  for (const VibrationMode<3> &mode : found.modes)
    if (likeness(body, mode.shape, wave) > 0.9)
      {
        error = std::max(error, std::fabs(mode.frequency / wave.frequency() - 1.));
        ++n;
      }
  EXPECT_EQ(n, expected) << "component " << wave.component << " along " << wave.axis;
  return error;
}

/** Loads and motions of a layer under the pressure 1 that a flat drags along. */
StaticContactSolution pressed(const ElasticBody<3> &body, const int sliding)
{
  StaticContactProblem problem;
  problem.constrained  = held_at(body, layer_size[2], 2);
  problem.displacement = body.zero_field();
  problem.force        = body.zero_field();
  const auto &top      = body.surface(ElasticBody<3>::top);
  for (std::size_t k = 0; k < top.nodes.size(); ++k)
    problem.force(2, top.nodes[k]) = -top.normal_area[top.place(k)][2];
  problem.friction_coefficient.assign(
    body.surface(ElasticBody<3>::bottom).normal_area.size(), 0.3);
  problem.sliding        = sliding;
  problem.flat_direction = {{-0.6, 0.8}};
  StaticContactOptions options;
  options.tolerance = 1e-11;
  return solve_static_contact<3>(body, problem, options);
}
} // namespace

// On a held bottom: thickness modes c / 4H along each axis, and shear waves along x and y,
// two of each wave length. Order two, on cubes and distorted cells.
TEST(PeriodicLayer, ModesConvergeToThoseOfWaves)
{
  const std::pair<LayerWave, unsigned int> waves[] = {
    {{0, 0, 0.}, 2}, {{2, 0, 0.}, 1}, {{1, 0, 1.}, 2}, {{0, 1, 1.}, 2}};
  for (const verification::Cells kind :
       {verification::Cells{false, 0.}, verification::Cells{false, 0.15}})
    {
      std::array<std::vector<double>, 2> errors;
      for (const unsigned int k : {0U, 1U})
        {
          const auto owner        = verification::divided(layer_of(k == 0 ? 4 : 8, kind));
          const MeshBody<3> &body = *owner;
          VibrationModesOptions options;
          options.n_modes  = 16;
          const auto found = vibration_modes<3>(body, held_at(body, 0., 3), options);
          EXPECT_EQ(found.n_rigid_motions, 0);
          for (const auto &[wave, n] : waves)
            errors[k].push_back(error_of(body, found, wave, n));
        }
      for (std::size_t w = 0; w < errors[0].size(); ++w)
        {
          const double order = std::log2(errors[0][w] / errors[1][w]);
          std::cout << "wave " << w << ": errors " << errors[0][w] << ", " << errors[1][w]
                    << ", order " << order << '\n';
          EXPECT_NEAR(order, 2., 0.15) << w;
          EXPECT_LT(errors[1][w], 0.04) << w;
        }
    }
}

// Along one axis the layer may still turn about that axis. Whatever is left free, loads in
// equilibrium are borne.
TEST(PeriodicLayer, FreeMotionsAndLoads)
{
  for (const bool along_y : {false, true})
    for (const bool simplices : {false, true})
      {
        MeshBodyInput<3> input =
          layer_of(2, {simplices, simplices ? 0.05 : 0.2}, along_y);
        for (auto &p : input.mesh.points) // with no lower side that could support it
          p[2] += along_y ? 0. : 0.5 * std::fabs(p[1] - 0.6);
        const auto owner        = verification::divided(input);
        const MeshBody<3> &body = *owner;
        const DofMask free(body.n_columns(), 1);
        const auto motions    = free_rigid_motions<3>(body, free);
        NodalField<double> Ku = body.zero_field(), force(Ku), u(Ku);
        EXPECT_EQ(motions.size(), along_y ? 3U : 4U);
        for (const NodalField<double> &motion : motions)
          {
            body.vmult(Ku, motion);
            for (const double x : {*std::max_element(Ku.begin(), Ku.begin() + Ku.size()),
                                   *std::min_element(Ku.begin(), Ku.begin() + Ku.size())})
              EXPECT_NEAR(x, 0., 1e-12);
          }
        std::mt19937 generator(7);
        std::uniform_real_distribution<> random(-1., 1.);
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int i = 0; i < body.n_columns(); ++i)
            u.row(c, 0)[i] = random(generator);
        body.update_copies(u);
        body.vmult(force, u);
        const auto solver = body.make_solver();
        solver->set_constrained(free);
        u.set_zero();
        solver->solve(u, force, 1e-12);
        body.vmult(Ku, u);
        double difference = 0., largest = 0.;
        for (std::size_t k = 0; k < Ku.size(); ++k)
          {
            difference =
              std::max(difference, std::fabs(Ku.begin()[k] - force.begin()[k]));
            largest = std::max(largest, std::fabs(force.begin()[k]));
          }
        EXPECT_LT(difference, 1e-10 * largest);
      }
}

// Uniaxial strain under the pressure, and the shear of friction that drags at an angle.
TEST(PeriodicLayer, PressedOnASlidingFlatIsUniform)
{
  for (const bool along_y : {false, true})
    for (const bool simplices : {false, true})
      for (const int sliding : {0, 1, -1})
        {
          if (!along_y && sliding != 0)
            continue; // it shears along y, where the sides are free
          MeshBodyInput<3> input =
            layer_of(4, {simplices, simplices ? 0.03 : 0.2}, along_y);
          if (!along_y) // nor do they stay plane
            input.phases[0].stiffness = isotropic_stiffness<3>(2., 0.);
          const auto owner        = verification::divided(input);
          const MeshBody<3> &body = *owner;
          const VoigtMatrix<3> &D = body.phases()[0].stiffness;
          const auto found        = pressed(body, sliding);
          for (unsigned int i = 0; i < body.n_columns(); ++i)
            {
              const double z     = body.point({i, 0})[2],
                           shear = sliding * 0.3 * (layer_size[2] - z) / D(3, 3);
              ASSERT_NEAR(found.displacement(0, {i, 0}), -0.6 * shear, 1e-9);
              ASSERT_NEAR(found.displacement(1, {i, 0}), 0.8 * shear, 1e-9);
              ASSERT_NEAR(found.displacement(2, {i, 0}), -z / D(2, 2), 1e-9);
            }
          const auto &bottom = body.surface(ElasticBody<3>::bottom);
          for (std::size_t k = 0; k < bottom.normal_area.size(); ++k)
            {
              ASSERT_NEAR(found.normal_force[k], -bottom.normal_area[k][2], 1e-9);
              EXPECT_EQ(found.state[k],
                        sliding == 0 ? ContactState::stick : ContactState::slip);
            }
        }
}
