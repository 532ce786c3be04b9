#include "dynamics/critical_time_step.h"
#include "dynamics/grid/explicit_stepper.h"
#include "elasticity_testing.h"
#include "material/stiffness.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

using namespace elasticity_testing;

namespace
{
/** Largest omega by the dense matrix of the reference product. */
double dense_largest_frequency(const UniformMaterial &material)
{
  const unsigned int columns = material.n_columns(), rows = material.n_rows();
  const unsigned int n = 2 * columns * rows;
  Eigen::MatrixXd A(n, n);
  Eigen::VectorXd scale(n);
  NodalField<double> u(columns, rows);
  const auto value = [&](const NodalField<double> &f, const unsigned int k) {
    return f.row(k % 2, k / 2 / columns) + k / 2 % columns;
  };
  std::vector<double> mass(columns);
  for (unsigned int k = 0; k < n; ++k)
    {
      material.mass_row(k / 2 / columns, mass.data());
      scale(k) = 1. / std::sqrt(mass[k / 2 % columns]);
      u.set_zero();
      *const_cast<double *>(value(u, k)) = 1.;
      const NodalField<double> f         = reference_product(material, u);
      for (unsigned int l = 0; l < n; ++l)
        A(l, k) = *value(f, l);
    }
  A = scale.asDiagonal() * A * scale.asDiagonal();
  return std::sqrt(
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly)
      .eigenvalues()[n - 1]);
}

/** Growth of the largest entry from a random start over many steps. */
bool stays_bounded(const UniformMaterial &material, const StepParameters &p)
{
  Random random;
  NodalField<double> u(material.n_columns(), material.n_rows()), w(u);
  random.fill(u);
  ExplicitStepper stepper({material, p, u, w});
  stepper.advance(3000);
  return std::all_of(u.begin(), u.begin() + u.size(),
                     [](const double x) { return std::abs(x) < 1e3; });
}
} // namespace

TEST(CriticalTimeStep, Formula)
{
  EXPECT_NEAR(critical_time_step(3., 0.5, 0.) * 3., 2., 1e-14);
  EXPECT_NEAR(critical_time_step(3., 1., 0.) * 3., std::sqrt(2.), 1e-14);
  const double b = 0.7, beta = 0.1, omega = 5., xi = beta * omega / 2.;
  const double W = critical_time_step(omega, b, beta) * omega;
  EXPECT_NEAR(b * W * W + 2. * xi * W - 2., 0., 1e-14);
  EXPECT_THROW(critical_time_step(std::nan(""), 0.5, 0.), std::invalid_argument);
}

TEST(CriticalTimeStep, ElementBoundOfTheSquare)
{
  const UniformGrid<2> grid{{{4, 4}}, {{0.1, 0.1}}};
  const double lambda = 2., mu = 1., rho = 3.;
  EXPECT_NEAR(
    element_frequency_bound(UniformMaterial(grid, {{plane_strain(lambda, mu), rho}})),
    std::sqrt(8. * (lambda + mu) / rho) / 0.1, 1e-10);
}

TEST(CriticalTimeStep, LanczosAgainstDenseEigenvalues)
{
  Random random;
  SCOPED_TRACE(seed);
  for (const auto &cells :
       {std::array<unsigned int, 2>{{1, 1}}, {{1, 6}}, {{5, 4}}, {{9, 7}}, {{14, 11}}})
    for (const unsigned int n_classes : {1, 2, 7})
      {
        const UniformMaterial material =
          random_material(random, cells, n_classes, true, false);
        const double exact               = dense_largest_frequency(material);
        const FrequencyEstimate estimate = largest_frequency(material);
        EXPECT_LE(estimate.lower, exact * (1. + 1e-12));
        EXPECT_GE(estimate.upper, exact * (1. - 1e-12));
        EXPECT_LE(estimate.upper, exact * 1.005) << "after " << estimate.iterations;
        EXPECT_LE(exact, element_frequency_bound(material) * (1. + 1e-12));
      }
}

TEST(CriticalTimeStep, FineHomogeneousGrid)
{
  // An infinite mesh of squares has 2 c_L / h.
  const UniformGrid<2> grid{{{120, 80}}, {{1e-4, 1e-4}}};
  const double lambda = 8.3e9, mu = 12.5e9, rho = 1500.;
  const UniformMaterial material(grid, {{plane_strain(lambda, mu), rho}});
  const double limit = 2. * std::sqrt((lambda + 2. * mu) / rho) / 1e-4;
  const auto found   = largest_frequency(material);
  EXPECT_GT(found.upper, limit * 0.999);
  EXPECT_LT(found.upper, limit * 1.06);
  EXPECT_LT(found.upper, found.lower * 1.005) << "after " << found.iterations;
}

// Never below the largest frequency of the box, found by a long iteration, and hardly above.
TEST(CriticalTimeStep, BlocksBoundAHomogeneousBox)
{
  VoigtMatrix<3> any = isotropic_stiffness<3>(40e9, 0.3);
  any(0, 3) = any(3, 0) = 4e9;
  any(1, 5) = any(5, 1) = -6e9;
  any(2, 2) += 50e9;
  for (const VoigtMatrix<3> &stiffness : {isotropic_stiffness<3>(3e9, 0.45), any})
    for (const auto &cells : {std::array<unsigned int, 3>{{25, 37, 13}}, {{40, 3, 14}}})
      {
        const BrickBox box{{cells, {{1e-3, 0.7e-3, 1.2e-3}}, {}}, {}};
        const ElasticPhase<3> phase = {stiffness, 1770.};
        const BrickOperator op(divide_box(
                                 box,
                                 [](const CellBlock<3> &block) {
                                   return std::vector<std::uint16_t>(block.n_cells());
                                 },
                                 1, MPI_COMM_SELF),
                               {phase}, MPI_COMM_SELF);
        const FrequencyEstimate exact = largest_frequency(op, 1e-6, 600),
                                found = largest_frequency_of_blocks(
                                  box.grid, phase, InstructionSet::automatic);
        EXPECT_LE(exact.upper, (1. + 1e-5) * exact.lower);
        EXPECT_GE(found.upper, (1. - 1e-6) * exact.lower);
        EXPECT_LE(found.upper, 1.004 * exact.lower);
      }
}

TEST(CriticalTimeStep, ObservedStability)
{
  Random random;
  for (const auto &cells : {std::array<unsigned int, 2>{{1, 1}}, {{13, 9}}})
    for (const double beta : {0., 0.05})
      for (const double beta2 : {0.5, 0.7, 1.})
        {
          const UniformMaterial material =
            random_material(random, cells, 2, false, false);
          const double exact =
            critical_time_step(dense_largest_frequency(material), beta2, beta);
          StepParameters p;
          p.beta  = beta;
          p.beta2 = beta2;
          p.dt    = 0.9999 * critical_time_step(material, beta2, beta);
          EXPECT_TRUE(stays_bounded(material, p)) << beta2 << " " << beta;
          EXPECT_GT(p.dt, 0.99 * exact);
          p.dt = 1.01 * exact;
          EXPECT_FALSE(stays_bounded(material, p)) << beta2 << " " << beta;
        }
}
