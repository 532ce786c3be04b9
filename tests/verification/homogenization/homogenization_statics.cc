#include "../turns.h"
#include "independent_statics.h"

#include "base/errors.h"
#include "homogenization/ensemble.h"
#include "material/stiffness.h"

#include <gtest/gtest.h>

#include <iostream>
#include <sstream>

using namespace homogenization_testing;
using elasticity_testing::Random;

namespace
{
struct Case
{
  Volume volume;
  std::string text;
};

/** Poisson's ratios up to 0.4999, rotated orthotropy, or any positive definite matrix. */
VoigtMatrix<2> random_stiffness(Random &draw, const double modulus, std::ostream &text)
{
  const unsigned int kind = draw.integer(0, 5);
  if (kind < 4)
    {
      const double nu = kind < 2 ? draw(-0.5, 0.45) : 0.5 - draw.scale(1e-4, 0.1);
      text << " E " << modulus << " nu " << nu;
      return isotropic_stiffness<2>(modulus, nu);
    }
  if (kind == 4)
    {
      const double ratio = draw.scale(1., 100.), angle = draw(0., M_PI);
      text << " orthotropic " << modulus << " x" << ratio << " at " << angle;
      return rotate_stiffness<2>(
        stiffness_from_coefficients<2>(
          {modulus * ratio, 0.3 * modulus, modulus, 0.4 * modulus}),
        angle);
    }
  text << " any " << modulus;
  return draw.any_stiffness(modulus);
}

void fill(Volume &volume, Random &draw, std::ostream &text)
{
  const unsigned int nx = volume.grid.cells[0], ny = volume.grid.cells[1];
  const unsigned int kind = draw.integer(0, 4);
  const double share      = draw(0.1, 0.9);
  const auto phase        = [&]() {
    const unsigned int n = volume.stiffness.size();
    return draw(0., 1.) < share ? 0U : draw.integer(n > 1 ? 1 : 0, n - 1);
  };
  const unsigned int wx = kind == 0 ? 1 : draw.integer(1, 8),
                     wy = kind == 0 ? 1 : draw.integer(1, 8);
  text << (kind < 2    ? ", blocks "
           : kind == 2 ? ", columns "
           : kind == 3 ? ", rows "
                       : ", chessboard ")
       << wx << " x " << wy << " share " << share;
  std::vector<std::uint8_t> blocks((nx + 1) * (ny + 1));
  for (std::uint8_t &b : blocks)
    b = static_cast<std::uint8_t>(phase());
  for (unsigned int j = 0; j < ny; ++j)
    for (unsigned int i = 0; i < nx; ++i)
      {
        const unsigned int I = i / wx, J = j / wy;
        volume.id[j * nx + i] = kind < 2    ? blocks[J * nx + I]
                                : kind == 2 ? blocks[I]
                                : kind == 3 ? blocks[J]
                                            : (I + J) % volume.stiffness.size();
      }
}

Case random_case(const unsigned int seed)
{
  Random draw(seed);
  std::ostringstream text;
  const unsigned int nx = std::lround(draw.scale(0.6, 64.)),
                     ny = std::lround(draw.scale(0.6, 64.));
  const double flat     = draw.integer(0, 2) == 0 ? 1. : draw.scale(1. / 60., 60.);
  text << "seed " << seed << ": " << std::max(nx, 1U) << " x " << std::max(ny, 1U)
       << " cells 1:" << flat;
  const unsigned int n_phases = draw.integer(2, 4);
  const double contrast       = draw.scale(1., 1e6);
  std::vector<VoigtMatrix<2>> stiffness;
  for (unsigned int p = 0; p < n_phases; ++p)
    {
      const double modulus = p == 0 ? 1. : p == 1 ? contrast : draw.scale(1., contrast);
      stiffness.push_back(random_stiffness(draw, 1e9 * modulus, text));
    }
  Case c;
  c.volume =
    make_volume(std::max(nx, 1U), std::max(ny, 1U), stiffness, 1e-4, 1e-4 * flat);
  fill(c.volume, draw, text);
  c.text = text.str();
  return c;
}

/** Solves by default settings, or, where these are refused, by what the program advises;
 * against a direct solution. */
class Comparison
{
public:
  void add(const Case &c, const BoundaryCondition condition)
  {
    SCOPED_TRACE(to_string(condition) + ", " + c.text);
    const VoigtMatrix<2> D = independent_statics::stiffness(c.volume, condition);
    try
      {
        const std::string warning =
          compare(c, condition, StaticSolverKind::multigrid, 1e-8, D);
        if (!warning.empty())
          {
            ++n_warnings;
            std::cout << warning << " (" << c.text << ")\n";
            EXPECT_EQ(compare(c, condition, StaticSolverKind::multigrid, 1e-12, D), "");
          }
      }
    catch (const NotConverged &e)
      {
        say(e, c);
        EXPECT_NE(std::string(e.what()).find(to_string(condition) + " "),
                  std::string::npos);
        compare(c, condition, StaticSolverKind::jacobi, 1e-8, D);
      }
    catch (const NumericalFailure &e)
      {
        say(e, c);
        compare(c, condition, StaticSolverKind::multigrid, 1e-12, D);
      }
  }

  void print() const
  {
    std::cout << n << " solutions, " << n_refused << " refused before, " << n_warnings
              << " with a warning; stiffness off by at most " << worst
              << " without one; Hill-Mandel residual at most " << worst_mean
              << ", two phases " << worst_phases << "; at most " << most_iterations
              << " iterations, " << n_double << " load cases in double precision\n";
  }

private:
  void say(const std::exception &e, const Case &c)
  {
    ++n_refused;
    std::cout << e.what() << " (" << c.text << ")\n";
  }

  /** Returns the warning. What is said to hold, holds. */
  std::string compare(const Case &c,
                      const BoundaryCondition condition,
                      const StaticSolverKind solver,
                      const double tolerance,
                      const VoigtMatrix<2> &D)
  {
    const UniformMaterial material = c.volume.material();
    const GridBody<2> body(material, solver);
    const auto solutions = solve_load_cases(body, {condition}, tolerance, MPI_COMM_SELF);
    const HomogenizedResponse<2> response = respond(body, solutions[0]);
    const std::string warning             = check_response<2>(response, tolerance);
    const double error                    = scaled_difference<2>(response.stiffness, D);
    EXPECT_LT(error, warning.empty() ? 1e-5 : 100. * response.hill_mandel_residual);
    if (warning.empty())
      worst = std::max(worst, error);
    worst_mean   = std::max(worst_mean, response.hill_mandel_residual);
    worst_phases = std::max(worst_phases, response.two_phase_residual.value_or(0.));
    for (const SolverReport &report : response.reports)
      {
        most_iterations = std::max(most_iterations, report.iterations);
        n_double += report.single_iterations.has_value();
      }
    ++n;
    return warning;
  }

  unsigned int n = 0, n_refused = 0, n_warnings = 0, most_iterations = 0, n_double = 0;
  double worst = 0., worst_mean = 0., worst_phases = 0.;
};

/** @p share of the cells, each by itself, of the second phase. */
Case noise(const std::string &text,
           const unsigned int nx,
           const unsigned int ny,
           const std::vector<VoigtMatrix<2>> &stiffness,
           const double share,
           const double flat = 1.)
{
  Case c;
  c.text   = text + " seed 1";
  c.volume = make_volume(nx, ny, stiffness, 1e-4, 1e-4 * flat);
  Random draw(1);
  for (std::uint8_t &phase : c.volume.id)
    phase = draw(0., 1.) < share;
  return c;
}

std::vector<VoigtMatrix<2>>
two_phases(const double contrast, const double nu_0 = 0.2, const double nu_1 = 0.2)
{
  return {isotropic_stiffness<2>(30e9, nu_0),
          isotropic_stiffness<2>(30e9 * contrast, nu_1)};
}
} // namespace

TEST(RandomStatics, EqualADirectSolution)
{
  Comparison comparison;
  for (unsigned int seed = 1; seed <= n_random_cases; ++seed)
    for (const BoundaryCondition condition : all_conditions)
      if (verification::has_turn(seed))
        comparison.add(random_case(seed), condition);
  comparison.print();
}

TEST(RandomStatics, AdverseVolumesEqualADirectSolution)
{
  Case chessboard = noise("chessboard", 32, 32, two_phases(1e4), 0., 7.);
  for (unsigned int k = 0; k < 1024; ++k)
    chessboard.volume.id[k] = (k + k / 32) % 2;
  std::vector<Case> cases = {
    noise("column", 1, 17, two_phases(100.), 0.5),
    noise("row", 17, 1, two_phases(100.), 0.5),
    chessboard,
    noise("soft pores, half", 48, 48, two_phases(1e-6), 0.5),
    noise("soft pores, most", 48, 48, two_phases(1e-6), 0.7),
    noise("rubber", 16, 16, two_phases(2., 0.49, 0.49), 0.3),
    noise("stiffer rubber", 16, 16, two_phases(3., 0.499, 0.499), 0.3),
    noise("nearly incompressible", 24, 24, two_phases(10., 0.4999999, 0.4999999), 0.5),
    noise("opposite Poisson's ratios", 24, 24, two_phases(1., -0.99, 0.499), 0.5),
    noise("flat cells", 33, 31, two_phases(100., 0.3, 0.3), 0.3, 0.3),
    noise("flatter cells", 24, 24, two_phases(8.), 0.5, 100.),
    noise("long strip", 2, 60, two_phases(2e5), 0.5)};
  if (n_random_cases >= 1000)
    cases.push_back(noise("very long strip", 2, 301, two_phases(2e5), 0.5));
  Comparison comparison;
  unsigned int n = 0;
  for (const Case &c : cases)
    for (const BoundaryCondition condition : all_conditions)
      if (verification::has_turn(n++))
        comparison.add(c, condition);
  comparison.print();
}

/** What a tolerance leaves, against the independent solution. */
struct Errors
{
  Errors(const Volume &volume, const BoundaryCondition condition, const double tolerance)
  {
    const UniformMaterial material = volume.material();
    const GridBody<2> body(material);
    const auto solutions = solve_load_cases(body, {condition}, tolerance, MPI_COMM_SELF);
    const HomogenizedResponse<2> r = respond(body, solutions[0]);
    const VoigtMatrix<2> D         = independent_statics::stiffness(volume, condition);
    energy                         = scaled_difference<2>(r.stiffness, D);
    mean                           = scaled_difference<2>(r.stiffness_from_mean, D);
    residual                       = r.hill_mandel_residual;
    std::cout << to_string(condition) << ", tolerance " << tolerance << ": energy "
              << energy << ", mean " << mean << ", Hill-Mandel " << residual << "\n";
  }

  double energy, mean, residual;
};

// The energy is of second order in the error of the solver, the mean of first order, and
// their difference is the error of the mean.
TEST(RandomStatics, StiffInclusionHoldsItsDigits)
{
  for (const double contrast : {1e4, 1e5, 1e6})
    {
      Volume volume = make_volume(48, 48, two_phases(contrast));
      for (unsigned int k = 0; k < 48 * 48; ++k)
        volume.id[k] = k % 48 / 12 % 3 > 0 && k / 48 / 12 % 3 > 0;
      const Errors errors(volume, BoundaryCondition::KUBC, 1e-8);
      EXPECT_LT(errors.energy, 1e-9);
      EXPECT_NEAR(errors.mean, errors.residual, 0.1 * errors.residual);
    }
}

TEST(RandomStatics, EnergiesAreOfSecondOrder)
{
  const Case c = noise("stiff grains", 32, 32, two_phases(1e4), 0.3);
  for (const BoundaryCondition condition : all_conditions)
    {
      const Errors loose(c.volume, condition, 1e-4), tight(c.volume, condition, 1e-6);
      for (const Errors &errors : {loose, tight})
        {
          EXPECT_LT(errors.energy, 0.2 * errors.mean);
          EXPECT_NEAR(errors.mean, errors.residual, 0.1 * errors.residual);
        }
      // A hundredth of the tolerance: 1e-4 of one error where the other one has 1e-2.
      // Both solutions have round-off of about 1e-13.
      EXPECT_LT(tight.energy,
                loose.energy * std::pow(tight.mean / loose.mean, 1.5) + 3e-13);
    }
}
