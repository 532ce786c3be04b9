#include "localization/strain/grid_interpolation.h"
#include "localization/strain/side_integrals.h"
#include "localization_testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace mesoslip_tests;

namespace
{
/** Mean strain from the sides, those of half of the layers first. */
template <int dim>
VoigtVector<dim> mean_over(const UniformGrid<dim> &grid, const std::vector<double> &u)
{
  std::vector<double> sums(2 * dim * dim);
  const unsigned int n = grid.cells[dim - 1];
  for (const auto &[begin, end] : {std::pair{0u, n / 2}, {n / 2, n}})
    add_side_integrals<dim>(grid, all_cells(grid), u.data(), begin, end, sums.data());
  return mean_strain<dim>(grid, sums.data());
}

/** Expects the strain of @p u, interpolated to @p target, to be that function of the
 * centres of the cells. */
void expect_strain(const UniformGrid<2> &source,
                   const UniformGrid<2> &target,
                   const std::vector<double> &u,
                   const std::function<VoigtVector<2>(double, double)> &expected)
{
  StrainInterpolation<2> interpolation(source, target, all_cells(source));
  interpolation.set_displacement(u.data());
  for (unsigned int j = 0; j < target.cells[1]; ++j)
    {
      const CellRow row = interpolation.row(j);
      for (unsigned int i = 0; i < target.cells[0]; ++i)
        {
          const auto strain =
            expected((i + 0.5) * target.spacing[0], (j + 0.5) * target.spacing[1]);
          for (unsigned int c = 0; c < 3; ++c)
            EXPECT_NEAR(row(c, i), strain[c], 1e-15);
        }
    }
}

/** Largest error of the interpolated strain in a displacement with quadratic strain. */
double interpolation_error(const unsigned int n_coarse, const bool edges)
{
  const auto source = make_grid(3 * n_coarse, 2 * n_coarse);
  const auto target = make_grid(15 * n_coarse / 2, 5 * n_coarse);
  const double k    = 700.;
  const auto u      = nodal(source, [&](const double x, const double y) {
    return std::array<double, 2>{{std::sin(k * x) * std::cos(k * y), 0.}};
  });
  StrainInterpolation<2> interpolation(source, target, all_cells(source));
  interpolation.set_displacement(u.data());
  double error            = 0.;
  const unsigned int skip = edges ? 0 : 8;
  for (unsigned int j = skip; j < target.cells[1] - skip; ++j)
    {
      const CellRow row = interpolation.row(j);
      for (unsigned int i = skip; i < target.cells[0] - skip; ++i)
        {
          const double x = (i + 0.5) * target.spacing[0],
                       y = (j + 0.5) * target.spacing[1];
          error =
            std::max({error, std::fabs(row(0, i) - k * std::cos(k * x) * std::cos(k * y)),
                      std::fabs(row(2, i) + k * std::sin(k * x) * std::sin(k * y))});
        }
    }
  return error / k;
}
} // namespace

TEST(AxisWeights, ReproduceLinearFunctionsUpToTheEdges)
{
  for (const auto [n_source, n_target] :
       {std::array<unsigned int, 2>{{4, 8}}, {{4, 11}}, {{12, 4}}, {{9, 4}}, {{2, 5}}})
    {
      const AxisWeights weights(n_source, n_target);
      for (unsigned int i = 0; i < n_target; ++i)
        {
          double value = 0.;
          for (unsigned int k = 0; k < weights.width; ++k)
            {
              ASSERT_LT(weights.first[i] + k, n_source);
              value += weights.weight[i * weights.width + k] *
                       (weights.first[i] + k + 0.5) / n_source;
            }
          EXPECT_NEAR(value, (i + 0.5) / n_target, 1e-14) << n_source << ' ' << n_target;
        }
    }
  EXPECT_EQ(AxisWeights(1, 5).weight, std::vector<double>(5, 1.));
  EXPECT_TRUE(AxisWeights(7, 7).is_identity());
}

TEST(StrainInterpolation, UniformStrainAndRigidMotion)
{
  for (const auto &source : {make_grid(6, 4), make_grid(3, 2), make_grid(12, 8),
                             make_grid(5, 7), make_grid(1, 1), make_grid(18, 4)})
    {
      const auto u    = uniform_strain(source, 1e-3, -2e-3, 5e-4);
      const auto mean = mean_over(source, u);
      EXPECT_NEAR(mean[0], 1e-3, 1e-15);
      EXPECT_NEAR(mean[1], -2e-3, 1e-15);
      EXPECT_NEAR(mean[2], 5e-4, 1e-15);
      expect_strain(source, make_grid(6, 4), u,
                    [](double, double) { return VoigtVector<2>(1e-3, -2e-3, 5e-4); });
    }
}

TEST(StrainInterpolation, LinearStrainIsExactFromCoarseToFine)
{
  // u_x = a x^2 + b x y, u_y = c y^2: cell means of the strain are exact.
  const double a = 0.3, b = -0.2, c = 0.4;
  for (const auto &source : {make_grid(6, 4), make_grid(4, 3), make_grid(12, 12)})
    {
      const auto u = nodal(source, [&](const double x, const double y) {
        return std::array<double, 2>{{a * x * x + b * x * y, c * y * y}};
      });
      expect_strain(source, make_grid(12, 12), u, [&](const double x, const double y) {
        return VoigtVector<2>(2. * a * x + b * y, 2. * c * y, b * x);
      });
    }
}

TEST(StrainInterpolation, SecondOrder)
{
  for (const bool edges : {false, true})
    {
      const double order =
        std::log2(interpolation_error(16, edges) / interpolation_error(32, edges));
      EXPECT_GT(order, 1.8) << "edges " << edges;
      EXPECT_LT(order, 2.4) << "edges " << edges;
    }
}

TEST(StrainInterpolation, RowsKeptForOthersAreThoseOfTheDisplacement)
{
  // Rows in any order, and again for another displacement, against an object that has
  // kept none.
  const auto source = make_grid(4, 3), target = make_grid(12, 12);
  StrainInterpolation<2> interpolation(source, target, all_cells(source));
  for (const double k : {300., 700.})
    {
      const auto u = nodal(source, [&](const double x, const double y) {
        return std::array<double, 2>{{std::sin(k * x), std::cos(k * (x + y))}};
      });
      interpolation.set_displacement(u.data());
      for (const unsigned int j : {0u, 5u, 6u, 2u, 11u, 10u})
        {
          StrainInterpolation<2> fresh(source, target, all_cells(source));
          fresh.set_displacement(u.data());
          const CellRow expected = fresh.row(j), found = interpolation.row(j);
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int i = 0; i < 12; ++i)
              EXPECT_EQ(found(c, i), expected(c, i));
        }
    }
}

TEST(StrainInterpolation, MeanIsTheMeanOfTheCells)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> number(-1., 1.);
  const auto grid = make_grid(7, 5);
  const auto u    = nodal(grid, [&](double, double) {
    return std::array<double, 2>{{number(generator), number(generator)}};
  });
  StrainInterpolation<2> interpolation(grid, grid, all_cells(grid));
  interpolation.set_displacement(u.data());
  std::array<double, 3> sum = {};
  for (unsigned int j = 0; j < 5; ++j)
    {
      const CellRow row = interpolation.row(j);
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int i = 0; i < 7; ++i)
          sum[c] += row(c, i) / 35.;
    }
  const auto mean = mean_over(grid, u);
  for (unsigned int c = 0; c < 3; ++c)
    EXPECT_NEAR(mean[c], sum[c], 1e-11);
}

// u_x = a x^2 + b x y and u_z = c z^2 + b y z have strains that are linear, so that they are
// exact in any cells; the lowest layers of nodes are not known.
TEST(StrainInterpolation, InSpaceAsAlongEachAxis)
{
  const double a = 0.3, b = -0.2, c = 0.4;
  const UniformGrid<3> target = {{{4, 6, 8}}, {{0.25, 0.5, 0.125}}, {}};
  for (const std::array<unsigned int, 3> &cells :
       {std::array<unsigned int, 3>{{3, 4, 5}}, {{8, 12, 16}}, {{4, 6, 8}}, {{2, 3, 16}}})
    {
      UniformGrid<3> source = {cells, {}, {}};
      for (unsigned int d = 0; d < 3; ++d)
        source.spacing[d] = target.extent(d) / cells[d];
      const unsigned int first_target = 4;
      const auto layers = StrainInterpolation<3>::layers(source, target, first_target, 8);
      CellBlock<3> known = {{{0, 0, layers[0]}}, cells};
      known.cells[2]     = layers[1] - layers[0];
      EXPECT_GT(layers[0], 0u);
      std::vector<double> u;
      for (unsigned int k = layers[0]; k <= layers[1]; ++k)
        for (unsigned int j = 0; j <= cells[1]; ++j)
          for (unsigned int i = 0; i <= cells[0]; ++i)
            {
              const double x = i * source.spacing[0], y = j * source.spacing[1],
                           z = k * source.spacing[2];
              u.insert(u.end(), {a * x * x + b * x * y, 0., c * z * z + b * y * z});
            }
      StrainInterpolation<3> interpolation(source, target, known);
      interpolation.set_displacement(u.data());
      for (unsigned int row = first_target * 6; row < 48; ++row)
        for (unsigned int i = 0; i < 4; ++i)
          {
            const CellRow found                  = interpolation.row(row);
            const double x                       = (i + 0.5) * target.spacing[0],
                         y                       = (row % 6 + 0.5) * target.spacing[1],
                         z                       = (row / 6 + 0.5) * target.spacing[2];
            const std::array<double, 6> expected = {
              {2. * a * x + b * y, 0., 2. * c * z + b * y, b * z, 0., b * x}};
            for (unsigned int e = 0; e < 6; ++e)
              EXPECT_NEAR(found(e, i), expected[e], 1e-13) << cells[0] << ' ' << e;
          }
    }
}

TEST(SideIntegrals, InSpaceOfAFieldThatIsNotLinear)
{
  // Mean of du_x/dz over the box: difference of the means over two of its sides.
  const UniformGrid<3> grid = {{{3, 4, 5}}, {{0.5, 0.25, 0.2}}, {}};
  std::vector<double> u;
  for (unsigned int k = 0; k <= 5; ++k)
    for (unsigned int j = 0; j <= 4; ++j)
      for (unsigned int i = 0; i <= 3; ++i)
        {
          const double x = i * 0.5, y = j * 0.25, z = k * 0.2;
          u.insert(u.end(), {z * (3. + x * (1. - z)) + 1e6, 2. * y * x, 0.});
        }
  const VoigtVector<3> mean = mean_over(grid, u);
  EXPECT_NEAR(mean[voigt_index<3>(0, 2)], 3., 1e-9);
  EXPECT_NEAR(mean[1], 1.5, 1e-13);                  // 2 <x>
  EXPECT_NEAR(mean[voigt_index<3>(0, 1)], 1., 1e-9); // 2 <y>
  // <z (1 - z)> at the nodes: trapezoidal along z
  double expected = 0.;
  for (unsigned int k = 1; k < 5; ++k)
    expected += 0.2 * (k * 0.2) * (1. - k * 0.2);
  EXPECT_NEAR(mean[0], expected, 1e-9);
}
