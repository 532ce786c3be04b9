// A flat that moves along any direction in the plane. Runs on any number of ranks.

#include "contact/laws/slip_weakening.h"
#include "mesh_sliding.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace verification;

namespace
{
/** Cosine and sine, zero where they are meant to be. */
std::array<double, 2> direction_at(const double angle)
{
  const double c = std::cos(angle), s = std::sin(angle);
  return {{std::fabs(c) < 1e-15 ? 0. : c, s}};
}

/** In the plane of the flat. */
dealii::Point<3> turned_by(const double angle, const dealii::Point<3> &p)
{
  const auto [c, s] = direction_at(angle);
  return {c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
}

/** How @p p moves at the start: downwards, turning and along the flat. */
dealii::Point<3> start_velocity(const dealii::Point<3> &p)
{
  return {300. * p[1] + 0.2, 0.4 - 300. * p[0],
          -1.5 + 0.3 * std::sin(900. * p[0] + 400. * p[2])};
}

/** Two phases, thrown on a flat that moves along x and reaches 2 m/s slowly. */
MeshCase<3> thrown_on_x(const bool simplices)
{
  MeshCase<3> c;
  c.mesh =
    brick<3>({{6, 5, 4}}, {{4e-3, 3e-3, 1.6e-3}}, {simplices, simplices ? 0.05 : 0.2});
  for (std::size_t k = 0; k < c.mesh.cells.size(); ++k)
    c.mesh.cells[k].material_id = k % 7 == 2 || k % 11 == 4;
  c.setup.step.dt               = simplices ? 5e-9 : 1.5e-8;
  c.phases                      = two_phases<3>();
  c.friction                    = 0.4;
  c.setup.contact.flat_velocity = LoadHistory(2., Ramp::smooth, 1e-5);
  c.setup.contact.gap           = 2e-7;
  c.setup.top.pressure          = LoadHistory(5e6);
  c.setup.top.is_platen         = false;
  c.setup.step.acceleration     = {{3e4, -5e4, -2e5}};
  c.setup.step.beta             = 2e-8;
  c.setup.energy_interval       = 1;
  c.setup.monitored_nodes       = {0};
  return c;
}

/** The body with flat and loads turned about the normal of the flat. */
MeshCase<3> turned_case(const double angle, MeshCase<3> c)
{
  for (const unsigned int side : {4U, 5U})
    c.sides[side] = c.side(side);
  for (auto &p : c.mesh.points)
    p = turned_by(angle, p);
  auto &acceleration          = c.setup.step.acceleration;
  const dealii::Point<3> pull = turned_by(angle, {acceleration[0], acceleration[1], 0.});
  acceleration                = {{pull[0], pull[1], acceleration[2]}};
  c.setup.contact.flat_direction = direction_at(angle);
  c.setup.top.direction          = c.setup.contact.flat_direction;
  return c;
}

/** After a thousand steps; the body began turned by @p angle. */
std::unique_ptr<MeshRun<3>> moved(const MeshCase<3> &c, const double angle)
{
  auto run = std::make_unique<MeshRun<3>>(c, MPI_COMM_WORLD);
  run->set_w([&](const dealii::Point<3> &p, const unsigned int k) {
    const bool stays = c.setup.top.is_platen && p[2] > 1.59e-3;
    return stays ? (k == 2 ? -1.5 : 0.)
                 : turned_by(angle, start_velocity(turned_by(-angle, p)))[k];
  });
  run->run(1000);
  return run;
}

/** Histories of all ranks. */
ContactHistory contact_of(const MeshRun<3> &run)
{
  ContactHistory all = run.body.contact_recorder.history();
  sum_over_ranks(all, MPI_COMM_WORLD);
  return all;
}

std::vector<double> top_of(const MeshRun<3> &run)
{
  TopHistory all = run.body.top_recorder.history();
  sum_over_ranks(all, MPI_COMM_WORLD);
  return all.tangential_force;
}

void expect_turned(const MeshRun<3> &straight,
                   const MeshRun<3> &askew,
                   const double angle,
                   const bool held)
{
  std::vector<double> expected = straight.whole(straight.body.u);
  for (std::size_t k = 0; k < expected.size(); k += 3)
    {
      const dealii::Point<3> u =
        turned_by(angle, {expected[k], expected[k + 1], expected[k + 2]});
      for (unsigned int d = 0; d < 3; ++d)
        expected[k + d] = u[d];
    }
  const double found = relative_difference(expected, askew.whole(askew.body.u));
  std::cout << "turned by " << angle << ": displacements differ by " << found << '\n';
  EXPECT_LT(found, 1e-12);

  const ContactHistory one = contact_of(straight), two = contact_of(askew);
  EXPECT_LT(relative_difference(one.normal_force, two.normal_force), 1e-10);
  EXPECT_LT(relative_difference(one.tangential_force, two.tangential_force), 1e-10);
  EXPECT_LT(relative_difference(one.friction_energy, two.friction_energy), 1e-10);
  const double of_top = held ? relative_difference(top_of(straight), top_of(askew)) : 0.;
  EXPECT_LT(of_top, 1e-10);
  const EnergyHistory e = askew.body.energy->reduce();
  double scale          = 0.;
  for (const auto *values : {&e.kinetic, &e.elastic, &e.friction, &e.external_work})
    scale = std::max(scale, largest(*values));
  std::cout << "energies close to " << largest(e.residual()) / scale << '\n';
  EXPECT_LT(largest(e.residual()) / scale, 1e-12);
  EXPECT_GT(e.friction.back(), 1e-2 * scale);
}
} // namespace

TEST(FlatAskew, TurnsTheSolution)
{
  for (const bool simplices : {false, true})
    for (const bool platen : {false, true})
      {
        MeshCase<3> c = thrown_on_x(simplices);
        if (platen)
          {
            c.setup.top.is_platen    = true;
            c.setup.contact.law.time = 0.;
          }
        else
          {
            c.setup.contact.law.reference       = c.friction;
            c.setup.contact.law.normal_stress   = {0., 1e-6, 0.1};
            c.setup.contact.law.coefficient_law = std::make_shared<SlipWeakening>(
              SlipWeakening::Constants{c.friction, 0.1, 2e-6, true, Healing()});
          }
        const auto straight = moved(c, 0.);
        for (const double angle : {M_PI / 2., 0.6, -2.2})
          expect_turned(*straight, *moved(turned_case(angle, c), angle), angle, platen);
      }
}

// Nodes that a side holds along the motion of the flat rub across it.
TEST(FlatAskew, TurnsWhatSidesHold)
{
  for (const unsigned int held : {0U, 1U})
    {
      MeshCase<3> c                = thrown_on_x(false);
      c.setup.step.beta2           = 0.8;
      c.setup.step.beta            = 2e-8;
      c.setup.contact.law.time     = 0.;
      c.setup.contact.law.node_law = std::make_shared<SlipRateRegularization>(2e-6, 0.1);
      c.hold(4, held);
      MeshCase<3> right = turned_case(M_PI / 2., c);
      for (HeldComponent &h : right.held)
        h.component = 1 - h.component;
      const auto straight = moved(c, 0.), askew = moved(right, M_PI / 2.);
      expect_turned(*straight, *askew, M_PI / 2., false);
    }
}

// A block at rest on a flat that moves at 45 degrees: it is taken along, after a slip of
// V^2 / (2 mu g), straight and with friction along the motion.
TEST(FlatAskew, BlockIsTakenAlong)
{
  const double mu = 0.3, g = 9.81, V = 0.9, e = std::sqrt(0.5);
  MeshCase<3> c;
  c.mesh                         = brick<3>({{3, 3, 2}}, {{0.03, 0.03, 0.01}});
  c.phases                       = {{isotropic_stiffness<3>(2e7, 0.2), 1000.}};
  c.friction                     = mu;
  c.setup.contact.law.time       = 0.;
  c.setup.contact.flat_velocity  = LoadHistory(V);
  c.setup.contact.flat_direction = {{-e, e}};
  c.setup.top.is_platen          = false;
  c.setup.step.acceleration      = {{0., 0., -g}};
  c.setup.step.beta              = 2e-5;
  MeshRun<3> run(c, MPI_COMM_WORLD);
  const double dt = run.body.setup.step.dt, end = V / (mu * g);
  const auto mean = [&]() {
    const std::vector<double> u = run.whole(run.body.u);
    dealii::Point<3> sum;
    for (std::size_t k = 0; k < u.size(); ++k)
      sum[k % 3] += u[k] * 3. / u.size();
    return sum;
  };
  const auto slip = [&](const dealii::Point<3> &u, const double time) {
    return V * time - e * (u[1] - u[0]);
  };
  const double whole = 0.5 * V * end;
  const auto half    = static_cast<std::uint64_t>(0.5 * end / dt);
  run.run(half);
  EXPECT_NEAR(slip(mean(), half * dt), 0.75 * whole, 2e-3 * whole);
  run.run(2 * half);
  const dealii::Point<3> u = mean();
  std::cout << "slip of the block " << slip(u, 3. * half * dt) << ", theory " << whole
            << " m; across " << u[0] + u[1] << " m\n";
  EXPECT_NEAR(slip(u, 3. * half * dt), whole, 2e-3 * whole);
  EXPECT_LT(std::fabs(u[0] + u[1]), 1e-12 * whole);

  const ContactHistory h = contact_of(run);
  for (std::size_t k = h.time.size() / 8; k < h.time.size() / 4; ++k)
    ASSERT_NEAR(h.tangential_force[k] / h.normal_force[k], mu, 1e-12) << k;
  const double friction =
    dealii::Utilities::MPI::sum(run.body.contact.work().friction, MPI_COMM_WORLD);
  EXPECT_NEAR(friction, mu * 9e-6 * 1000. * g * whole, 2e-3 * friction);
}
