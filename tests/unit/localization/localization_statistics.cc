// Means, deviations and comparisons of localized stresses.
#include "localization/localization_program.h"
#include "localization/stress_statistics.h"
#include "localization_testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace mesoslip_tests;

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

TEST(StressStatistics, MeansDeviationsAndVonMisesInSpace)
{
  // Two rows of which the last one is shorter; strains are uniaxial, or shear in the last cell.
  StressMap<3> map(5, 3);
  for (unsigned int k = 0; k < 5; ++k)
    map.set_matrix(k / 3, k % 3, 2. * VoigtMatrix<3>::Identity());
  StressStatistics<3> statistics(map, {});
  for (const double size : {1., 3.})
    for (unsigned int row = 0; row < 2; ++row)
      {
        std::vector<double> strain(6 * 3, 0.);
        std::fill_n(strain.begin(), 3, size);
        if (row == 1)
          {
            strain[1]         = 0.;
            strain[3 * 3 + 1] = 1.; // yz
          }
        statistics.add(row, {strain.data(), 3});
      }
  const StressFields fields = statistics.fields();
  ASSERT_EQ(fields.mean_von_mises.size(), 5u);
  for (unsigned int k = 0; k < 4; ++k)
    {
      EXPECT_NEAR(fields.mean_stress[6 * k], 4., 1e-14);
      EXPECT_NEAR(fields.deviation_stress[6 * k], 2., 1e-14);
      EXPECT_NEAR(fields.mean_von_mises[k], 4., 1e-14);
    }
  EXPECT_NEAR(fields.mean_stress[6 * 4 + 3], 2., 1e-14);
  EXPECT_EQ(fields.deviation_stress[6 * 4 + 3], 0.);
  EXPECT_NEAR(fields.mean_von_mises[4], 2. * std::sqrt(3.), 1e-14);
  // Plane strain of nu = 0.3 against three dimensions.
  const std::array<double, 3> plane = {{5., -2., 1.5}};
  const std::array<double, 6> same  = {{5., -2., 0.3 * 3., 0., 0., 1.5}};
  const double ratio                = 0.3;
  double work = 0., in_plane = 0., in_space = 0.;
  add_von_mises_row<2>({plane.data(), 1}, &ratio, 1, &work, &in_plane);
  add_von_mises_row<3>({same.data(), 1}, nullptr, 1, &work, &in_space);
  EXPECT_NEAR(in_plane, in_space, 1e-14);
}
