// Static contact: closed forms, balances of forces and moments, complementarity.

#include "base/errors.h"
#include "elasticity/uniform_grid_operator.h"
#include "material/stiffness.h"
#include "sliding/analyses/static_contact.h"
#include "sliding/given_grid.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <Eigen/Dense>

#include <cmath>
#include <numeric>
#include <vector>

using namespace mesoslip;

namespace
{
constexpr double P = 5e5;

/** An elastic rectangle under the pressure P; by default free of friction. */
struct Case
{
  ContactParameters parameters;
  BodyDescription body;
  StaticContactOptions options;

  Case(const std::array<double, 2> &size,
       const std::array<unsigned int, 2> &cells,
       const bool platen)
  {
    body.grid                = {cells, {{size[0] / cells[0], size[1] / cells[1]}}};
    body.phases              = {phase(30e9, 0.2)};
    parameters.analysis      = ContactAnalysis::static_contact;
    parameters.top.is_platen = platen;
    parameters.top.pressure  = LoadHistory(P);
    set_friction(0., 0.);
    options.tolerance = 1e-10;
  }

  static Phase<2> phase(const double E, const double nu)
  {
    Phase<2> result;
    result.name      = "E" + std::to_string(static_cast<int>(E * 1e-9));
    result.stiffness = isotropic_stiffness<2>(E, nu);
    result.density   = 1770.;
    return result;
  }

  void set_friction(const double mu, const double velocity)
  {
    parameters.friction.coefficient  = mu;
    parameters.contact.flat_velocity = LoadHistory(velocity);
    body.node_friction.assign(body.grid.cells[0] + 1, mu);
  }

  /** Fibres one cell wide, as in the paper. */
  void add_fibres()
  {
    const unsigned int nx = body.grid.cells[0], ny = body.grid.cells[1];
    body.phases.push_back(phase(240e9, 0.2));
    body.phase_id.assign(body.grid.n_cells(), 0);
    for (unsigned int i = 3; i < nx; i += 7)
      for (unsigned int j = (i * 5) % 11; j < ny; ++j)
        if ((i + j / 12) % 3 != 0 || j < 12)
          body.phase_id[j * nx + i] = 1;
    for (unsigned int i = 3; i < nx; i += 14)
      for (unsigned int j = 0; j < 10; ++j)
        body.phase_id[j * nx + i] = 1;
  }

  StaticContactResult<2> run() const
  {
    GivenGrid given(parameters, body);
    check_static_load(given.parameters, given.facts());
    given.make_elastic(MPI_COMM_SELF, false);
    return compute_static_contact<2>(given, options);
  }

  double moment_of_normal_forces(const StaticContactResult<2> &result) const
  {
    double moment = 0.;
    for (std::size_t i = 0; i < result.solution.state.size(); ++i)
      moment += result.solution.normal_force[i] * i * body.grid.spacing[0];
    return moment;
  }
};

/** Signorini's conditions, and Coulomb's with the slip direction @p sliding. */
void expect_contact_conditions(const Case &c,
                               const StaticContactResult<2> &result,
                               const int sliding)
{
  const StaticContactSolution &s = result.solution;
  const double mean = result.normal_force / static_cast<double>(s.state.size());
  for (std::size_t i = 0; i < s.state.size(); ++i)
    {
      const double mu = c.body.node_friction[i], fn = s.normal_force[i],
                   ft = s.tangential_force[i];
      if (s.state[i] == ContactState::separated)
        {
          EXPECT_GE(s.displacement.row(1, 0)[i], 0.);
          EXPECT_EQ(fn, 0.);
          EXPECT_EQ(ft, 0.);
          continue;
        }
      EXPECT_EQ(s.displacement.row(1, 0)[i], 0.);
      EXPECT_GE(fn, -1e-9 * mean);
      if (s.state[i] == ContactState::stick)
        {
          EXPECT_EQ(s.displacement.row(0, 0)[i], 0.);
          EXPECT_LE(std::fabs(ft), mu * fn + 1e-9 * mean);
        }
      else if (sliding != 0)
        EXPECT_NEAR(ft, sliding * mu * fn, 1e-8 * mean) << "node " << i;
      else
        {
          EXPECT_NEAR(std::fabs(ft), mu * fn, 1e-8 * mean);
          EXPECT_LE(ft * s.displacement.row(0, 0)[i], 1e-9 * mean * 1e-6);
        }
    }
}
} // namespace

// sigma_yy = -P, nothing else.
TEST(StaticContact, UniformCompression)
{
  for (const auto kind : {StaticSolverKind::multigrid, StaticSolverKind::jacobi})
    {
      Case c({{7e-3, 2e-3}}, {{35, 10}}, false);
      c.parameters.static_solver = kind;
      const auto result          = c.run();
      for (const double p : result.node_pressure)
        EXPECT_NEAR(p / P, 1., 1e-8);
      for (const double p : result.cell_pressure)
        EXPECT_NEAR(p / P, 1., 1e-8);
      const VoigtVector<2> strain =
        c.body.phases[0].stiffness.inverse() * VoigtVector<2>(0., -P, 0.);
      const NodalField<double> &u = result.solution.displacement;
      EXPECT_NEAR(u.row(1, 10)[7] / (strain[1] * 2e-3), 1., 1e-8);
      EXPECT_NEAR((u.row(0, 5)[35] - u.row(0, 5)[0]) / (strain[0] * 7e-3), 1., 1e-8);
      EXPECT_NEAR(result.normal_force / (P * 7e-3), 1., 1e-9);
      EXPECT_NEAR(*result.phases.pressure[0] / P, 1., 1e-8);
      EXPECT_NEAR(*result.phases.repartition[0] / P, 1., 1e-12);
    }
}

// Periodic layer below a platen on a sliding flat: u_y = -P y / D22,
// u_x = +- mu P (H - y) / G.
TEST(StaticContact, SlidingLayer)
{
  const double H = 2e-3, mu = 0.4;
  for (const double velocity : {2., -1.})
    {
      Case c({{7e-3, H}}, {{21, 6}}, true);
      c.parameters.periodic = true;
      c.set_friction(mu, velocity);
      const auto result           = c.run();
      const auto &D               = c.body.phases[0].stiffness;
      const NodalField<double> &u = result.solution.displacement;
      const double sign           = velocity > 0. ? 1. : -1.;
      for (unsigned int i = 0; i < 22; i += 7)
        {
          EXPECT_NEAR(u.row(1, 6)[i] / (-P * H / D(1, 1)), 1., 1e-8);
          EXPECT_NEAR(u.row(0, 0)[i] / (sign * mu * P * H / D(2, 2)), 1., 1e-8);
          EXPECT_NEAR(result.node_shear[0][i] / (sign * mu * P), 1., 1e-8);
        }
      EXPECT_NEAR(result.tangential_force[0] / (sign * mu * P * 7e-3), 1., 1e-8);
    }
}

// Columns of two materials without lateral contraction are compressed alike: the
// hypothesis of eq. (18) holds exactly.
TEST(StaticContact, LaminateUnderPlaten)
{
  Case c({{5e-3, 2e-3}}, {{50, 20}}, true);
  c.body.phases = {Case::phase(30e9, 0.), Case::phase(240e9, 0.)};
  c.body.phase_id.assign(c.body.grid.n_cells(), 0);
  for (unsigned int j = 0; j < 20; ++j)
    for (unsigned int i = 4; i < 50; i += 10)
      c.body.phase_id[j * 50 + i] = 1;
  const auto result = c.run();
  EXPECT_NEAR(result.phases.surface_fraction[1], 0.1, 1e-12);
  for (unsigned int p = 0; p < 2; ++p)
    EXPECT_NEAR(*result.phases.pressure[p] / *result.phases.repartition[p], 1., 1e-8);
  // Table 4: 2.35 and 0.29 MPa.
  EXPECT_NEAR(*result.phases.pressure[1], 2.353e6, 1e3);
  EXPECT_NEAR(*result.phases.pressure[0], 0.294e6, 1e3);
}

TEST(StaticContact, FibresUnderPlatenBalance)
{
  Case c({{14e-3, 4e-3}}, {{70, 20}}, true);
  c.add_fibres();
  c.set_friction(0.25, 2.);
  const auto result = c.run();
  expect_contact_conditions(c, result, 1);
  EXPECT_NEAR(result.normal_force / (P * 14e-3), 1., 1e-12);
  EXPECT_NEAR(result.tangential_force[0] / (0.25 * P * 14e-3), 1., 1e-8);
  EXPECT_LT(result.phases.imbalance, 1e-8);
  EXPECT_GT(*result.phases.pressure[1], 2. * *result.phases.pressure[0]);
  double mean = 0.;
  for (unsigned int p = 0; p < 2; ++p)
    mean += result.phases.surface_fraction[p] * *result.phases.pressure[p];
  EXPECT_NEAR(mean / P, 1., 1e-8);

  // The platen takes the friction up.
  const UniformMaterial material = make_material(c.body, MeanDilatation::never, false);
  NodalField<double> Ku(71, 21);
  UniformGridOperator(material).vmult(Ku, result.solution.displacement);
  EXPECT_NEAR(std::accumulate(Ku.row(0, 20), Ku.row(0, 20) + 71, 0.) /
                result.tangential_force[0],
              -1., 1e-7);
  EXPECT_NEAR(std::accumulate(Ku.row(1, 20), Ku.row(1, 20) + 71, 0.) / (P * 14e-3), -1.,
              1e-8);
}

TEST(StaticContact, MirroredSliding)
{
  Case c({{8e-3, 4e-3}}, {{32, 16}}, true);
  c.set_friction(0.5, 1.);
  const auto right = c.run();
  c.set_friction(0.5, -3.);
  const auto left = c.run();
  for (unsigned int i = 0; i <= 32; ++i)
    {
      EXPECT_NEAR(right.node_pressure[i], left.node_pressure[32 - i], 1e-6 * P);
      EXPECT_EQ(right.solution.state[i], left.solution.state[32 - i]);
    }
}

// A narrow body held in u_x on its top: friction opens the contact behind. The top's
// reactions have no moment about points on it, so sum x f_n = P L^2/2 - T H.
TEST(StaticContact, PartialSeparation)
{
  const double L = 4e-3, H = 6e-3;
  Case c({{L, H}}, {{40, 60}}, false);
  c.parameters.top.held = {{true, true, false}};
  c.set_friction(0.22, 2.);
  const auto result = c.run();
  expect_contact_conditions(c, result, 1);
  std::size_t separated = 0;
  for (const ContactState s : result.solution.state)
    separated += s == ContactState::separated;
  EXPECT_GT(separated, 5u);
  EXPECT_LT(separated, 35u);
  EXPECT_NEAR(result.normal_force / (P * L), 1., 1e-8);
  EXPECT_NEAR(c.moment_of_normal_forces(result) / (P * L),
              0.5 * L - result.tangential_force[0] / (P * L) * H, 1e-8 * L);

  c.set_friction(0.4, 2.);
  EXPECT_THROW(c.run(), UserError) << "mu H > L / 2: it tips over";
}

// On a flat at rest nodes stick up to mu f_n; the pressed body spreads.
TEST(StaticContact, RestingFlat)
{
  Case c({{8e-3, 4e-3}}, {{32, 16}}, false);
  std::array<std::size_t, 4> sticking = {};
  const std::array<double, 4> mu      = {{0., 0.05, 0.15, 10.}};
  for (unsigned int k = 0; k < 4; ++k)
    {
      c.set_friction(mu[k], 0.);
      const auto result = c.run();
      expect_contact_conditions(c, result, 0);
      EXPECT_NEAR(result.tangential_force[0] / (P * 8e-3), 0., 1e-7);
      for (const ContactState s : result.solution.state)
        sticking[k] += s == ContactState::stick;
    }
  EXPECT_EQ(sticking[0], 0u);
  EXPECT_GT(sticking[1], 0u);
  EXPECT_LT(sticking[1], sticking[2]);
  EXPECT_LE(sticking[2], sticking[3]);
}

TEST(StaticContact, Gravity)
{
  Case c({{4e-3, 2e-3}}, {{8, 4}}, false);
  c.parameters.step.acceleration = {{0., -9.81e6}};
  const auto result              = c.run();
  EXPECT_NEAR(result.normal_force / (P * 4e-3 + 9.81e6 * 1770. * 8e-6), 1., 1e-8);
}
