#include "sliding_body.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

using namespace verification;

namespace
{
double largest_dense_frequency(const UniformMaterial &material, std::vector<double> *all)
{
  const unsigned int columns = material.n_columns(), n = 2 * columns * material.n_rows();
  const UniformGridOperator op(material);
  NodalField<double> x(columns, material.n_rows()), y = x;
  std::vector<double> mass(columns);
  Eigen::MatrixXd A(n, n);
  const auto entry = [&](NodalField<double> &f, const unsigned int k) -> double & {
    return f.row(k % 2, k / 2 / columns)[k / 2 % columns];
  };
  const auto root_mass = [&](const unsigned int k) {
    material.mass_row(k / 2 / columns, mass.data());
    return std::sqrt(mass[k / 2 % columns]);
  };
  for (unsigned int k = 0; k < n; ++k)
    {
      x.set_zero();
      entry(x, k) = 1. / root_mass(k);
      op.vmult(y, x);
      for (unsigned int l = 0; l < n; ++l)
        A(l, k) = entry(y, l) / root_mass(l);
    }
  const Eigen::VectorXd squares =
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly)
      .eigenvalues();
  if (all != nullptr)
    all->assign(squares.data(), squares.data() + n);
  return std::sqrt(squares(n - 1));
}

/** Largest displacement after many steps from a small start. */
double growth(const BodySetup &setup)
{
  const UniformMaterial material = setup.material();
  NodalField<double> u(material.n_columns(), material.n_rows()), w = u;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < u.n_rows(); ++j)
      for (unsigned int i = 0; i < u.n_columns(); ++i)
        u.row(c, j)[i] = std::sin(3. * i * i + 7. * j + 11. * i * j + 5. * c);
  ExplicitStepper stepper({material, setup.step, u, w});
  stepper.advance(4000);
  return largest(u.begin(), u.size());
}

/** Stable just below the limit of the frequency, not just above. The library's limit is
 * not above it and not needlessly below. */
void expect_limit(BodySetup setup, const double omega)
{
  for (const double b : {0.5, 0.7, 1.})
    for (const double beta : {0., 4.4e-9, 5e-8})
      {
        const double xi        = 0.5 * beta * omega;
        const double predicted = (std::sqrt(xi * xi + 2. * b) - xi) / b / omega;
        setup.step.beta2       = b;
        setup.step.beta        = beta;
        setup.step.dt          = 0.99 * predicted;
        EXPECT_LT(growth(setup), 50.) << "beta2 " << b << " beta " << beta;
        setup.step.dt = 1.01 * predicted;
        EXPECT_GT(growth(setup), 1e6) << "beta2 " << b << " beta " << beta;
        const double chosen = critical_time_step(setup.material(), b, beta);
        EXPECT_LE(chosen, predicted * (1. + 1e-12));
        EXPECT_GE(chosen, predicted * 0.99);
      }
}
} // namespace

TEST(Stability, SingleCell)
{
  // Eigenvalues of the square with its own quarter masses, times rho h^2.
  BodySetup setup;
  setup.cells         = {{1, 1}};
  setup.spacing       = {{2e-4, 2e-4}};
  setup.classes       = {resin()};
  const double mu     = setup.classes[0].stiffness(2, 2);
  const double lambda = setup.classes[0].stiffness(0, 1);
  std::vector<double> squares;
  const double omega           = largest_dense_frequency(setup.material(), &squares);
  std::vector<double> expected = {0.,
                                  0.,
                                  0.,
                                  8. * mu,
                                  8. * mu,
                                  8. * (lambda + mu),
                                  4. * (lambda + 3. * mu) / 3.,
                                  4. * (lambda + 3. * mu) / 3.};
  std::sort(expected.begin(), expected.end());
  for (unsigned int k = 0; k < 8; ++k)
    EXPECT_NEAR(squares[k] * setup.classes[0].density * 4e-8, expected[k], 1e-9 * mu);

  expect_limit(setup, omega);
}

TEST(Stability, TwoPhases)
{
  BodySetup setup;
  setup.cells   = {{12, 9}};
  setup.spacing = {{1e-4, 1.3e-4}};
  setup.classes = {resin(), {isotropic_stiffness<2>(2.4e11, 0.2), 2500.}};
  for (unsigned int c = 0; c < 12 * 9; ++c)
    setup.ids.push_back(c % 5 == 2 || c % 7 == 3);
  const double omega = largest_dense_frequency(setup.material(), nullptr);
  expect_limit(setup, omega);
}
