#include "localization/localization_program.h"
#include "localization/strain/grid_interpolation.h"
#include "localization/strain/side_integrals.h"
#include "localization/stress_statistics.h"
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

TEST(RowKernels, VonMisesOfKnownStates)
{
  // Uniaxial, pure shear, plane strain tension with nu 0.3, hydrostatic (ratio 1/2).
  const std::vector<double> xx = {5., 0., 7., 4., 0.}, yy = {0., 0., 0., 4., -3.},
                            xy = {0., 2., 0., 0., 0.}, ratio = {0., 0.4, 0.3, 0.5, 0.};
  std::vector<double> work(5), sum(5, 1.), all;
  for (const auto *component : {&xx, &yy, &xy})
    all.insert(all.end(), component->begin(), component->end());
  add_von_mises_row<2>({all.data(), 5}, ratio.data(), 5, work.data(), sum.data());
  EXPECT_NEAR(sum[0], 6., 1e-15);
  EXPECT_NEAR(sum[1], 1. + 2. * std::sqrt(3.), 1e-15);
  EXPECT_NEAR(sum[2], 1. + 7. * std::sqrt(1. - 0.3 + 0.09), 1e-14);
  EXPECT_NEAR(sum[3], 1., 1e-15);
  EXPECT_NEAR(sum[4], 4., 1e-15);
}

TEST(StressStatistics, AgreeWithDirectFormulas)
{
  const TestRve rve;
  const std::vector<double> ratio = {0.2, 0.3};
  StressMap<2> map(24, 6);
  for (unsigned int cell = 0; cell < 24; ++cell)
    {
      map.set_matrix(cell / 6, cell % 6, rve.matrix(cell));
      map.set_ratio(cell / 6, cell % 6, ratio[rve.phase[cell]]);
    }
  StressStatistics<2> statistics(map, FieldSelection());
  std::mt19937 generator(11);
  std::normal_distribution<double> number(1e-3, 1e-6);
  const unsigned int n = 9, nx = 6, ny = 4;
  std::vector<double> strain(3 * n * nx * ny);
  for (double &value : strain)
    value = number(generator);
  for (unsigned int k = 0; k < n; ++k)
    for (unsigned int j = 0; j < ny; ++j)
      {
        const double *row = strain.data() + (k * ny + j) * 3 * nx;
        statistics.add(j, {row, nx});
      }
  const StressFields fields = statistics.fields();
  for (unsigned int cell = 0; cell < nx * ny; ++cell)
    {
      const unsigned int i = cell % nx, j = cell / nx;
      double von_mises    = 0.;
      VoigtVector<2> mean = VoigtVector<2>::Zero(), squares = mean;
      std::vector<VoigtVector<2>> stress;
      for (unsigned int k = 0; k < n; ++k)
        {
          const double *row = strain.data() + (k * ny + j) * 3 * nx;
          const VoigtVector<2> s =
            rve.matrix(cell) * VoigtVector<2>(row[i], row[nx + i], row[2 * nx + i]);
          const double zz = ratio[rve.phase[cell]] * (s[0] + s[1]);
          von_mises += std::sqrt(s[0] * s[0] + s[1] * s[1] + zz * zz - s[0] * s[1] -
                                 s[1] * zz - zz * s[0] + 3. * s[2] * s[2]) /
                       n;
          mean += s / n;
          stress.push_back(s);
        }
      for (const VoigtVector<2> &s : stress)
        squares += (s - mean).cwiseAbs2() / n;
      EXPECT_NEAR(fields.mean_von_mises[cell], von_mises, 1e-13 * von_mises);
      for (unsigned int c = 0; c < 3; ++c)
        {
          EXPECT_NEAR(fields.mean_stress[3 * cell + c], mean[c], 1e-13 * mean.norm());
          EXPECT_NEAR(fields.deviation_stress[3 * cell + c], std::sqrt(squares[c]),
                      1e-9 * mean.norm());
        }
    }
}

TEST(SeriesComparison, MeanDeviationAndShiftedSeries)
{
  // A sine against the same one shifted by a quarter: equal mean and deviation.
  const unsigned int n = 400;
  ProbeSeries direct;
  std::vector<double> stress;
  for (unsigned int k = 0; k < n; ++k)
    {
      const double t = k / 100. * 2. * M_PI;
      direct.time.push_back(k);
      for (unsigned int c = 0; c < 3; ++c)
        {
          stress.push_back(10. + std::sin(t));
          direct.values.push_back(c == 1 ? 0. : 8. + 2. * std::cos(t));
        }
    }
  const auto result =
    compare_series(stress, direct.values, resample(direct, direct.time));
  EXPECT_NEAR(result[0].mean, 10., 1e-12);
  EXPECT_NEAR(result[0].deviation, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(result[0].error_mean, 0.25, 1e-12);
  EXPECT_NEAR(result[0].error_deviation, -0.5, 1e-12);
  // mean (2 + sin - 2 cos)^2 = 4 + 1/2 + 2, mean (8 + 2 cos)^2 = 64 + 2
  EXPECT_NEAR(result[0].rms_difference, std::sqrt(6.5 / 66.), 1e-12);
  EXPECT_TRUE(std::isnan(result[1].error_mean));
  EXPECT_TRUE(std::isnan(result[1].rms_difference));
  const auto alone = compare_series(stress, {}, {});
  EXPECT_NEAR(alone[2].mean, 10., 1e-12);
  EXPECT_TRUE(std::isnan(alone[2].direct_mean));
}

TEST(SeriesComparison, ResamplingIsLinear)
{
  ProbeSeries series;
  for (const double t : {0., 1., 3., 4.})
    {
      series.time.push_back(t);
      series.values.insert(series.values.end(), {t, 2. * t, -t});
    }
  const auto values                  = resample(series, {0., 0.25, 2.5, 3.5, 4.});
  const std::vector<double> expected = {0., 0.25, 2.5, 3.5, 4.};
  for (unsigned int k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(values[3 * k + 1], 2. * expected[k], 1e-15);
  ProbeSeries single{{7.}, {1., 2., 3.}};
  EXPECT_EQ(resample(single, {0.}), single.values);
}

TEST(FieldErrors, RegionsAndErrorsByConstruction)
{
  const auto grid = make_grid(6, 4); // cells of 1 mm
  std::vector<std::uint8_t> phase(24, 0);
  phase[8] = 1;
  std::vector<dealii::Point<2>> centres;
  for (unsigned int cell = 0; cell < 24; ++cell)
    centres.emplace_back((cell % 6 + 0.5) * grid.spacing[0],
                         (cell / 6 + 0.5) * grid.spacing[1]);
  const auto regions = comparison_regions<2>(centres, {grid.extent(0), grid.extent(1)},
                                             phase, {"glue", "surface"}, 1e-3, 1.2e-3);
  std::map<std::string, std::vector<std::size_t>> cells;
  for (const CellRegion &region : regions)
    cells[region.name] = region.cells;
  EXPECT_EQ(cells["all"].size(), 24u);
  EXPECT_EQ(cells["surface"].size(), 6u);
  EXPECT_EQ(cells["bulk"].size(), 18u);
  EXPECT_EQ(cells["phase_surface"], std::vector<std::size_t>{8});
  EXPECT_EQ(cells["interior"].size(), 8u);
  EXPECT_EQ(cells["surface_inner"].size(), 4u);
  EXPECT_EQ(cells["glue_interior"].size(), 7u);
  EXPECT_EQ(cells["phase_surface_interior"], std::vector<std::size_t>{8});

  // Ten per cent too large in the surface, right elsewhere, sigma_xy wholly wrong.
  StressFields direct, localized;
  for (unsigned int cell = 0; cell < 24; ++cell)
    {
      direct.mean_von_mises.push_back(2.);
      localized.mean_von_mises.push_back(cell < 6 ? 2.2 : 2.);
      direct.mean_stress.insert(direct.mean_stress.end(), {3., -1., 1.});
      localized.mean_stress.insert(localized.mean_stress.end(), {3., -1., 0.});
    }
  for (const FieldError &error :
       field_errors(2, {true, true, false}, localized, direct, regions))
    {
      double expected = 0.;
      if (error.quantity == "mean_von_mises" && error.region.substr(0, 7) == "surface")
        expected = 0.1;
      else if (error.quantity == "mean_von_mises" && error.region == "all")
        expected = 0.1 * std::sqrt(6. / 24.);
      else if (error.quantity == "mean_von_mises" && error.region == "glue")
        expected = 0.1 * std::sqrt(6. / 23.);
      else if (error.quantity == "mean_sigma_xy")
        expected = 1.;
      EXPECT_NEAR(error.relative, expected, 1e-14)
        << error.quantity << ' ' << error.region;
    }
  EXPECT_NEAR(difference(localized, direct).mean_von_mises[2], 0.2, 1e-14);
}
