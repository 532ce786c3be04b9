#include "statics/multigrid/multigrid.h"

#include "body/mesh/mesh_body.h"
#include "multigrid_testing.h"
#include "statics/grid_solver.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <limits>

using namespace multigrid_testing;

namespace
{
enum class Support
{
  none,
  boundary,
  top,
  contact,
  one_component
};

DofMask make_mask(const UniformMaterial &material, const Support support)
{
  const unsigned int nx = material.n_columns(), ny = material.n_rows();
  DofMask mask(nx, ny);
  if (support == Support::boundary)
    for (const unsigned int c : {0u, 1u})
      {
        mask.constrain_row(c, 0);
        mask.constrain_row(c, ny - 1);
        mask.constrain_column(c, 0);
        mask.constrain_column(c, nx - 1);
      }
  if (support == Support::top || support == Support::contact)
    {
      mask.constrain_row(0, ny - 1);
      mask.constrain_row(1, ny - 1);
    }
  if (support == Support::contact)
    for (unsigned int i = 0; i < nx; ++i)
      if (i % 5 < 2)
        mask.constrain(1, {i, 0});
  if (support == Support::one_component)
    mask.constrain_row(1, 0);
  return mask;
}

struct Scene
{
  unsigned int nx, ny;
  double hx, hy;
  Periodicity periodicity;
  Support support;
};

class AgainstMl : public testing::TestWithParam<Scene>
{
};
} // namespace

// Another integration, another matrix, another preconditioner.
TEST_P(AgainstMl, SameDisplacements)
{
  const Scene &s = GetParam();
  const UniformMaterial material(make_grid(s.nx, s.ny, s.hx, s.hy), classes(8., true),
                                 noise(s.nx, s.ny, 3), s.periodicity);
  const DofMask mask         = make_mask(material, s.support);
  const NodalField<double> f = balanced_forces(material);
  NodalField<double> prescribed =
    s.periodicity.x ? nodal_field(material) : affine(material, 1e-3, -2e-3, 5e-4);

  GridSolver multigrid(material);
  multigrid.set_constrained(mask);
  NodalField<double> u      = prescribed;
  const SolverReport report = multigrid.solve(u, f, 1e-12);
  const MeshBody<2> body(mesh_of_grid(material), MPI_COMM_SELF);
  const auto ml = body.make_solver();
  ml->set_constrained(mask);
  NodalField<double> v = prescribed;
  ml->solve(v, f, 1e-12);
  EXPECT_LT(difference(u, v), 1e-8) << "seed " << seed;
  EXPECT_LE(report.iterations, 30U);
}

INSTANTIATE_TEST_SUITE_P(
  Scenes,
  AgainstMl,
  testing::Values(Scene{24, 16, 1e-4, 1e-4, {}, Support::boundary},
                  Scene{24, 16, 1e-4, 1e-4, {}, Support::none},
                  Scene{24, 16, 1e-4, 1e-4, {true, true}, Support::none},
                  Scene{24, 16, 1e-4, 1e-4, {true, false}, Support::top},
                  Scene{24, 16, 1e-4, 1e-4, {}, Support::contact},
                  Scene{31, 19, 1e-4, 2e-4, {}, Support::boundary},
                  Scene{31, 19, 1e-4, 2e-4, {}, Support::none},
                  Scene{31, 19, 3e-4, 1e-4, {true, true}, Support::none},
                  Scene{31, 19, 1e-4, 1e-4, {true, false}, Support::contact},
                  Scene{31, 19, 1e-4, 1e-4, {}, Support::contact},
                  Scene{17, 33, 1e-4, 1e-4, {}, Support::one_component},
                  Scene{40, 3, 1e-4, 1e-4, {}, Support::none},
                  Scene{2, 50, 1e-4, 1e-4, {}, Support::top},
                  Scene{1, 1, 1e-4, 1e-4, {}, Support::none},
                  Scene{2, 2, 1e-4, 1e-4, {}, Support::boundary},
                  Scene{3, 5, 1e-4, 1e-4, {true, true}, Support::none},
                  Scene{64, 1, 1e-4, 1e-4, {}, Support::top}));

TEST(Multigrid, IsSymmetricAndPositive)
{
  const UniformMaterial material(make_grid(45, 26), classes(8.), noise(45, 26, 2));
  const UniformGridOperator K(material);
  multigrid::Multigrid<float> preconditioner(material, K);
  const DofMask mask = make_mask(material, Support::contact);
  preconditioner.set_constrained(mask);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> uniform(-1.F, 1.F);
  NodalField<float> a(46, 27), b(46, 27), x(46, 27), y(46, 27);
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < 27; ++j)
      for (unsigned int i = 0; i < 46; ++i)
        if (!mask.is_constrained(c, {i, j}))
          {
            a.row(c, j)[i] = uniform(random);
            b.row(c, j)[i] = uniform(random);
          }
  preconditioner.vmult(x, a);
  preconditioner.vmult(y, b);
  double ay = 0., bx = 0., ax = 0.;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < 27; ++j)
      for (unsigned int i = 0; i < 46; ++i)
        {
          ay += a.row(c, j)[i] * y.row(c, j)[i];
          bx += b.row(c, j)[i] * x.row(c, j)[i];
          ax += a.row(c, j)[i] * x.row(c, j)[i];
          if (mask.is_constrained(c, {i, j}))
            {
              EXPECT_EQ(x.row(c, j)[i], 0.F);
            }
        }
  EXPECT_GT(ax, 0.);
  // Rounding: ten seeds gave differences of both signs up to 2.7e-5.
  EXPECT_NEAR(ay, bx, 1e-4 * ax);
}

namespace
{
/** Iterations for a stretched, sheared boundary (held) or a pulled body (not). */
unsigned int iterations(const unsigned int nx,
                        const unsigned int ny,
                        const double contrast,
                        const bool held,
                        const double hy = 1e-4)
{
  const UniformMaterial material(make_grid(nx, ny, 1e-4, hy), classes(contrast),
                                 fibres(nx, ny));
  GridSolver solver(material);
  NodalField<double> u = nodal_field(material), f = nodal_field(material);
  if (held)
    {
      solver.set_constrained(make_mask(material, Support::boundary));
      u = affine(material, 1e-3, 0., 0.);
    }
  else
    for (unsigned int j = 0; j <= ny; ++j)
      {
        f.row(0, j)[nx] = j == 0 || j == ny ? 0.5 : 1.;
        f.row(0, j)[0]  = -f.row(0, j)[nx];
      }
  return solver.solve(u, f, 1e-8).iterations;
}
} // namespace

TEST(Multigrid, IterationsDoNotGrowWithSize)
{
  for (const bool held : {true, false})
    {
      const unsigned int small = iterations(140, 40, 8., held);
      EXPECT_LE(small, 12U);
      EXPECT_LE(iterations(560, 160, 8., held), small + 2);
      EXPECT_LE(iterations(1120, 320, 8., held), small + 2);
      // Odd sizes.
      EXPECT_LE(iterations(141, 37, 8., held), small + 2);
      EXPECT_LE(iterations(97, 101, 8., held), small + 2);
    }
}

TEST(Multigrid, IterationsHardlyGrowWithContrast)
{
  for (const bool held : {true, false})
    {
      EXPECT_LE(iterations(280, 80, 100., held), 16U);
      // Stiff fibres one cell wide; soft ones, chains of voids almost.
      EXPECT_LE(iterations(280, 80, 1e4, held), held ? 22U : 36U);
      EXPECT_LE(iterations(281, 79, 1e4, held), held ? 22U : 36U);
      EXPECT_LE(iterations(560, 160, 1e4, held), held ? 22U : 36U);
      EXPECT_LE(iterations(280, 80, 1e-4, held), held ? 24U : 54U);
      // Cells four times as tall as wide, and the reverse.
      EXPECT_LE(iterations(280, 80, 8., held, 4e-4), 15U);
      EXPECT_LE(iterations(280, 80, 8., held, 0.25e-4), 20U);
    }
}

TEST(GridSolver, NewMaskIsANewProblem)
{
  const UniformMaterial material(make_grid(33, 20), classes(8.), noise(33, 20, 2));
  const NodalField<double> f = balanced_forces(material);
  GridSolver reused(material);
  for (const Support support : {Support::contact, Support::top, Support::none})
    {
      GridSolver fresh(material);
      NodalField<double> u = nodal_field(material), v = u;
      reused.set_constrained(make_mask(material, support));
      reused.solve(u, f, 1e-12);
      fresh.set_constrained(make_mask(material, support));
      fresh.solve(v, f, 1e-12);
      EXPECT_LT(difference(u, v), 1e-10);
    }
}

TEST(GridSolver, SolutionAsFirstGuessNeedsNoIteration)
{
  const UniformMaterial material(make_grid(33, 20), classes(8.), noise(33, 20, 2));
  const NodalField<double> f = balanced_forces(material);
  GridSolver solver(material);
  solver.set_constrained(make_mask(material, Support::top));
  NodalField<double> u = nodal_field(material);
  EXPECT_GT(solver.solve(u, f, 1e-10).iterations, 1U);
  EXPECT_EQ(solver.solve(u, f, 1e-9).iterations, 0U);
}

TEST(GridSolver, SaysWhenItDoesNotConverge)
{
  const UniformMaterial material(make_grid(33, 20), classes(8.), noise(33, 20, 2));
  NodalField<double> f = balanced_forces(material), u = nodal_field(material);
  GridSolver impatient(material, StaticSolverKind::multigrid, 2);
  EXPECT_THROW(impatient.solve(u, f, 1e-8), NotConverged);
  f.row(1, 7)[5] = std::numeric_limits<double>::quiet_NaN();
  GridSolver solver(material);
  EXPECT_THROW(solver.solve(u, f, 1e-8), NotConverged);
  EXPECT_THROW(solver.set_constrained(DofMask(3, 3)), std::invalid_argument);
}

TEST(RigidModes, AreCounted)
{
  const auto n_modes = [](const Periodicity periodicity, const Support support) {
    const UniformMaterial material(make_grid(12, 7), classes(8.), {}, periodicity);
    return multigrid::RigidModes(material, make_mask(material, support)).modes().size();
  };
  EXPECT_EQ(n_modes({}, Support::none), 3U);
  EXPECT_EQ(n_modes({}, Support::boundary), 0U);
  EXPECT_EQ(n_modes({}, Support::contact), 0U);
  EXPECT_EQ(n_modes({}, Support::one_component), 1U);
  EXPECT_EQ(n_modes({true, false}, Support::none), 2U);
  EXPECT_EQ(n_modes({true, true}, Support::none), 2U);
  // A hinge leaves the rotation about itself.
  const UniformMaterial material(make_grid(12, 7), classes(8.));
  DofMask hinge(13, 8);
  hinge.constrain(0, {3, 2});
  hinge.constrain(1, {3, 2});
  const multigrid::RigidModes modes(material, hinge);
  ASSERT_EQ(modes.modes().size(), 1U);
  const auto &mode = modes.modes()[0];
  EXPECT_NEAR(mode[0] - mode[2] * modes.y(2), 0., 1e-12);
  EXPECT_NEAR(mode[1] + mode[2] * modes.x(3), 0., 1e-12);
}
