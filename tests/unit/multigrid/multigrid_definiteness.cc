// Whether the preconditioner is positive definite, by dense matrices.
#include "material/stiffness.h"
#include "multigrid_testing.h"
#include "statics/grid_solver.h"
#include "statics/multigrid/galerkin.h"
#include "statics/multigrid/multigrid.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <limits>

using namespace multigrid_testing;

namespace
{
/** Materials, and numbers. */
struct Draw : elasticity_testing::Random
{
  Draw()
    : Random(multigrid_testing::seed)
  {
  }

  /** Isotropic up to nu = 0.4999, turned orthotropic, or anything positive definite. */
  VoigtMatrix<2> stiffness(const double contrast)
  {
    const double modulus = scale(1., contrast);
    switch (integer(0, 2))
      {
      case 0:
        return isotropic_stiffness<2>(modulus, 0.5 - scale(1e-4, 1.4));
      case 1:
        return rotate_stiffness<2>(
          stiffness_from_coefficients<2>(
            {100. * modulus, 0.3 * modulus, modulus, scale(0.1, 10.) * modulus}),
          (*this)(0., M_PI));
      default:
        return any_stiffness(modulus);
      }
  }

  /** Three classes, each cell by itself. */
  UniformMaterial material(const unsigned int nx,
                           const unsigned int ny,
                           const double contrast,
                           const double flat,
                           const Periodicity periodicity)
  {
    std::vector<ElasticPhase<2>> classes(3);
    for (ElasticPhase<2> &c : classes)
      c = {stiffness(contrast), 1.};
    std::vector<std::uint8_t> id(static_cast<std::size_t>(nx) * ny);
    for (std::uint8_t &c : id)
      c = static_cast<std::uint8_t>(integer(0, 2));
    return UniformMaterial(make_grid(nx, ny, 1., flat), classes, id, periodicity);
  }
};

/** K, and what of it the lines are made of, summed over cells. */
struct Assembly
{
  explicit Assembly(const UniformMaterial &material)
    : nx(material.n_columns() - material.periodicity().x)
    , ny(material.n_rows() - material.periodicity().y)
    , blocks(nx, ny, 11)
    , K(Eigen::MatrixXd::Zero(2 * nx * ny, 2 * nx * ny))
  {
    const UniformGrid<2> &grid = material.grid();
    for (unsigned int j = 0; j < grid.cells[1]; ++j)
      for (unsigned int i = 0; i < grid.cells[0]; ++i)
        add(cell_stiffness(material.phases()[material.phase_of(i, j)],
                           {{1., grid.spacing[1] / grid.spacing[0]}}),
            i, j);
  }

  void
  add(const Eigen::Matrix<double, 8, 8> &cell, const unsigned int i, const unsigned int j)
  {
    const auto column = [&](const unsigned int n) { return (i + n % 2) % nx; };
    const auto row    = [&](const unsigned int n) { return (j + n / 2) % ny; };
    for (unsigned int m = 0; m < 4; ++m)
      for (unsigned int n = 0; n < 4; ++n)
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int d = 0; d < 2; ++d)
            {
              const double value = cell(2 * m + c, 2 * n + d);
              K(2 * (row(m) * nx + column(m)) + c, 2 * (row(n) * nx + column(n)) + d) +=
                value;
              double *to = nullptr;
              if (m == n && c <= d)
                to = blocks.row(c + d, static_cast<int>(row(m)));
              else if (m % 2 == 0 && n == m + 1)
                to = blocks.row(3 + 2 * c + d, static_cast<int>(row(m)));
              else if (n == m + 2)
                to = blocks.row(7 + 2 * c + d, static_cast<int>(row(m)));
              if (to != nullptr)
                to[column(m)] += value;
            }
  }

  unsigned int nx, ny;
  NodalField<double> blocks;
  Eigen::MatrixXd K;
};

template <typename Field>
void set_unit(Field &field, const Assembly &a, const unsigned int k)
{
  field.row(k % 2, k / 2 / a.nx)[k / 2 % a.nx] = 1.;
}

template <typename Field>
Eigen::VectorXd vector_of(const Field &field, const Assembly &a)
{
  Eigen::VectorXd vector(a.K.rows());
  for (unsigned int k = 0; k < vector.size(); ++k)
    vector[k] = field.row(k % 2, k / 2 / a.nx)[k / 2 % a.nx];
  return vector;
}

/** T^-1, T holding the columns or the rows alone. */
Eigen::MatrixXd inverse_of_lines(const Assembly &a, const bool columns)
{
  multigrid::LineSmoother<2, double> smoother(a.nx, a.ny, [&a](const unsigned int row) {
    const int j = static_cast<int>(row);
    return multigrid::LineBlocks<double>{a.blocks.row(0, j), a.blocks.row(3, j),
                                         a.blocks.row(7, j), a.blocks.component_stride()};
  });
  smoother.damping = 1.;
  Eigen::MatrixXd inverse(a.K.rows(), a.K.rows());
  for (unsigned int k = 0; k < inverse.cols(); ++k)
    {
      NodalField<double> r(a.nx, a.ny), x(r);
      set_unit(r, a, k);
      if (columns)
        smoother.columns(r, x, false);
      else
        smoother.rows(r, x);
      inverse.col(k) = vector_of(x, a);
    }
  return inverse;
}

/** Of A^-1 K, symmetric A^-1; not a number unless A^-1 is positive definite. */
double largest_eigenvalue(const Eigen::MatrixXd &inverse, const Eigen::MatrixXd &K)
{
  const Eigen::LLT<Eigen::MatrixXd> factors(0.5 * (inverse + inverse.transpose()));
  if (factors.info() != Eigen::Success)
    return std::numeric_limits<double>::quiet_NaN();
  const Eigen::MatrixXd L = factors.matrixL();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(L.transpose() * K * L,
                                                        Eigen::EigenvaluesOnly)
    .eigenvalues()
    .tail(1)[0];
}
} // namespace

// T of each cell alone has K <= 2 T, see LineSmoother. Damping by 0.8 converges
// below 2.5.
TEST(LineSmoother, NoEigenvalueExceedsTwo)
{
  Draw draw;
  double largest = 0.;
  for (unsigned int n = 0; n < 400; ++n)
    {
      const unsigned int nx = draw.integer(1, 7), ny = draw.integer(1, 7);
      const Periodicity periodicity = {n % 2 == 1, n / 2 % 2 == 1};
      const Assembly a(draw.material(nx, ny, n % 3 == 0 ? 2. : 1e6,
                                     n % 5 == 0 ? 1. : draw.scale(1. / 60., 60.),
                                     periodicity));
      for (const bool columns : {false, true})
        {
          const double eigenvalue = largest_eigenvalue(inverse_of_lines(a, columns), a.K);
          EXPECT_LE(eigenvalue, 2. + 1e-6)
            << nx << " x " << ny << ", periodic " << periodicity.x << periodicity.y
            << ", volume " << n << " of seed " << seed;
          largest = std::max(largest, eigenvalue);
        }
    }
  EXPECT_GT(largest, 1.99); // the bound is sharp
}

// Convergent smoothers and P^T K P on coarse grids: no eigenvalue of M^-1 K exceeds 1.
TEST(Multigrid, IsPositiveDefiniteForAnyMaterial)
{
  Draw draw;
  for (unsigned int n = 0; n < 12; ++n)
    {
      const unsigned int nx = n % 4 == 3 ? draw.integer(1, 2) : draw.integer(3, 18),
                         ny = n % 4 == 3 ? draw.integer(60, 80) : draw.integer(12, 16);
      const Periodicity periodicity = {n % 3 < 2, n % 3 == 0};
      const UniformMaterial material =
        draw.material(nx, ny, n % 2 == 0 ? 2. : 1e3,
                      n % 5 == 0 ? 1. : draw.scale(0.2, 5.), periodicity);
      const Assembly a(material);
      const UniformGridOperator K(material);
      multigrid::Multigrid<double> cycle(material, K);
      cycle.set_constrained(DofMask(material.n_columns(), material.n_rows()));
      Eigen::MatrixXd inverse(a.K.rows(), a.K.rows());
      for (unsigned int k = 0; k < inverse.cols(); ++k)
        {
          NodalField<double> b = nodal_field(material), x = b;
          set_unit(b, a, k);
          cycle.vmult(x, b);
          inverse.col(k) = vector_of(x, a);
        }
      EXPECT_LT((inverse - inverse.transpose()).norm(), 1e-7 * inverse.norm());
      EXPECT_LE(largest_eigenvalue(inverse, a.K), 1. + 1e-6)
        << nx << " x " << ny << ", periodic " << periodicity.x << periodicity.y
        << ", volume " << n << " of seed " << seed;
    }
}

// Nearly incompressible, periodic: single precision takes more than 100 iterations.
TEST(GridSolver, GoesOnInDoublePrecision)
{
  const std::vector<ElasticPhase<2>> rubber = {
    {isotropic_stiffness<2>(1e6, 0.4999999), 1.},
    {isotropic_stiffness<2>(1e7, 0.4999999), 1.}};
  const UniformMaterial material(make_grid(24, 24), rubber, noise(24, 24, 2),
                                 {true, true});
  const NodalField<double> f = balanced_forces(material);
  NodalField<double> u = nodal_field(material), Ku = u;
  GridSolver solver(material);
  const SolverReport report = solver.solve(u, f, 1e-10);
  EXPECT_EQ(report.single_iterations.value_or(0), 100U);
  EXPECT_LT(report.residual, 1e-10);
  UniformGridOperator(material).vmult(Ku, u);
  EXPECT_LT(difference(Ku, f), 1e-8);
  // Further load cases start in double precision.
  NodalField<double> v = nodal_field(material);
  EXPECT_EQ(solver.solve(v, f, 1e-10).single_iterations.value_or(1), 0U);
}
