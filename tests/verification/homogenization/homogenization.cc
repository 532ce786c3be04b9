#include "../../measured.h"
#include "../turns.h"
#include "body/mesh/mesh_body.h"
#include "homogenization_testing.h"
#include "material/bounds.h"
#include "material/stiffness.h"
#include "morphology/microstructure_parameters.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace homogenization_testing;

// doc/theory.md, section 7, has the formulas.

TEST(Homogenization, HomogeneousVolumeReturnsItsStiffness)
{
  const VoigtMatrix<2> C =
    stiffness_from_coefficients<2>({80e9, 12e9, 9e9, 35e9, -4e9, 20e9});
  Volume one = make_volume(13, 8, {C}, 1e-4, 2e-4);
  // Two phases of one stiffness take the way of composites.
  Volume two = make_volume(13, 8, {C, C});
  make_random(two);
  for (const Volume &volume : {one, two})
    for (const HomogenizedResponse<2> &response : respond(volume))
      {
        EXPECT_LT(distance(response.stiffness, C), 1e-10);
        EXPECT_LT(distance(response.stiffness_from_mean, C), 1e-10);
      }
}

TEST(Homogenization, PeriodicLaminate)
{
  VoigtMatrix<2> expected = VoigtMatrix<2>::Zero();
  expected(0, 0)          = 59.259259259259e9;
  expected(0, 1) = expected(1, 0) = 14.814814814815e9;
  expected(1, 1)                  = 144.328703703704e9;
  expected(2, 2)                  = 22.222222222222e9;
  Volume upright                  = make_volume(12, 5, matrix_and_fibre());
  Volume lying                    = make_volume(5, 12, matrix_and_fibre(), 3e-4, 1e-4);
  for (unsigned int k = 0; k < upright.id.size(); ++k)
    {
      upright.id[k] = k % 12 < 6;
      lying.id[k]   = k / 5 < 6;
    }
  EXPECT_LT(distance(respond(upright)[2].stiffness, expected), 1e-8);
  measured::number("distance from the laminate", 0.,
                   distance(respond(upright)[2].stiffness, expected));
  EXPECT_LT(
    distance(respond(lying)[2].stiffness, rotate_stiffness<2>(expected, M_PI / 2.)),
    1e-8);
}

// Hill: with one shear modulus any geometry gives Dss = G and 1/(k+G) = <1/(k+G)>. The
// displacement is the gradient of a potential whose sources are constant in each phase:
// at corners it is as r log r, second derivatives as 1/r. So the error of the energy,
// the integral of h^2 / r^2, is h^2 (log(1/h) + c): order two but for the logarithm.
TEST(Homogenization, EqualShearModuli)
{
  const IsotropicModuli soft = {20e9, 15e9}, stiff = {90e9, 15e9};
  std::vector<double> errors, scaled;
  for (const unsigned int n : {16U, 32U, 64U, 128U})
    {
      Volume volume =
        make_volume(n, n, {isotropic_stiffness<2>(soft), isotropic_stiffness<2>(stiff)},
                    1. / n, 1. / n);
      for (unsigned int k = 0; k < n * n; ++k)
        volume.id[k] = 8 * (k % n) / n < 4 && 8 * (k / n) / n < 5;
      const double f         = volume.fraction(1);
      const double expected  = 1. / (f / (90e9 + 15e9) + (1. - f) / (20e9 + 15e9));
      const VoigtMatrix<2> D = respond(volume)[2].stiffness;
      EXPECT_NEAR(D(2, 2), 15e9, 15e9 * 1e-10);
      EXPECT_NEAR(D(0, 0), D(1, 1), 0.02 * expected);
      errors.push_back(D(0, 0) / expected - 1.);
      measured::error("stiffness, equal shear moduli", n, errors.back());
      EXPECT_GT(errors.back(), 0.); // too stiff
      scaled.push_back(errors.back() * n * n);
    }
  for (unsigned int k = 1; k < 4; ++k)
    std::printf("order %.2f\n", std::log2(errors[k - 1] / errors[k]));
  EXPECT_NEAR((scaled[3] - scaled[2]) / (scaled[2] - scaled[1]), 1., 0.03);
  EXPECT_NEAR((scaled[2] - scaled[1]) / (scaled[1] - scaled[0]), 1., 0.03);
  EXPECT_LT(errors.back(), 1e-4);
}

TEST(Homogenization, IdentitiesOfEverySolve)
{
  Volume volume = make_volume(37, 26, matrix_and_fibre(), 1e-4, 1.5e-4);
  make_random(volume);
  const double f           = volume.fraction(1);
  const VoigtMatrix<2> &C0 = volume.stiffness[0], &C1 = volume.stiffness[1];
  for (const HomogenizedResponse<2> &r : respond(volume))
    {
      EXPECT_LT(r.hill_mandel_residual, 1e-9);
      EXPECT_LT(r.symmetry_residual, 1e-9);
      EXPECT_LT(r.mean_residual, 1e-9);
      ASSERT_TRUE(r.two_phase_residual.has_value());
      EXPECT_LT(*r.two_phase_residual, 1e-8);
      // The phase means follow from the stiffness alone.
      const VoigtMatrix<2> &D = r.stiffness;
      if (r.condition != BoundaryCondition::SUBC)
        {
          const VoigtMatrix<2> expected = (C1 - C0).inverse() * (D - C0) / f;
          EXPECT_LT(distance(r.phase_means[1], expected), 1e-8);
          EXPECT_LT(distance(f * r.phase_means[1] + (1. - f) * r.phase_means[0],
                             VoigtMatrix<2>::Identity()),
                    1e-10);
        }
      else
        {
          const VoigtMatrix<2> expected =
            (C1.inverse() - C0.inverse()).inverse() * (D.inverse() - C0.inverse()) / f;
          EXPECT_LT(distance(r.phase_means[1], expected), 1e-8);
        }
    }
}

TEST(Homogenization, TurnedMorphologyGivesTurnedStiffness)
{
  Volume volume = make_volume(24, 17, matrix_and_fibre(), 1e-4, 1.5e-4);
  make_random(volume);
  // A quarter turn counter-clockwise: what was at (i, j) is at (16 - j, i).
  Volume turned = make_volume(17, 24, volume.stiffness, 1.5e-4, 1e-4);
  for (unsigned int j = 0; j < 17; ++j)
    for (unsigned int i = 0; i < 24; ++i)
      turned.id[i * 17 + (16 - j)] = volume.id[j * 24 + i];
  const auto a = respond(volume), b = respond(turned);
  for (unsigned int k = 0; k < 3; ++k)
    EXPECT_LT(distance(b[k].stiffness, rotate_stiffness<2>(a[k].stiffness, M_PI / 2.)),
              1e-8);
}

TEST(Homogenization, MirroredMorphologyGivesMirroredStiffness)
{
  const VoigtMatrix<2> turned =
    stiffness_from_coefficients<2>({80e9, 12e9, 9e9, 35e9, -4e9, 20e9});
  const Eigen::DiagonalMatrix<double, 3> mirror(1., 1., -1.);
  Volume volume = make_volume(23, 16, {matrix_and_fibre()[0], turned}, 1e-4, 1.5e-4);
  make_random(volume);
  Volume mirrored =
    make_volume(23, 16, {matrix_and_fibre()[0], mirror * turned * mirror}, 1e-4, 1.5e-4);
  for (unsigned int j = 0; j < 16; ++j)
    for (unsigned int i = 0; i < 23; ++i)
      mirrored.id[j * 23 + 22 - i] = volume.id[j * 23 + i];
  const auto a = respond(volume), b = respond(mirrored);
  for (unsigned int k = 0; k < 3; ++k)
    {
      EXPECT_LT(distance(b[k].stiffness, mirror * a[k].stiffness * mirror), 1e-8);
      EXPECT_GT(std::abs(a[k].stiffness(0, 2)), 1e8);
    }
}

TEST(Homogenization, UnitsChangeNothing)
{
  Volume metres = make_volume(24, 17, matrix_and_fibre(), 1e-4, 1.5e-4);
  make_random(metres);
  Volume millimetres       = metres;
  millimetres.grid.spacing = {{0.1, 0.15}};
  for (VoigtMatrix<2> &C : millimetres.stiffness)
    C *= 1e-6;
  const auto a = respond(metres), b = respond(millimetres);
  for (unsigned int k = 0; k < 3; ++k)
    {
      EXPECT_LT(distance(b[k].stiffness, 1e-6 * a[k].stiffness), 1e-9);
      for (unsigned int phase = 0; phase < 2; ++phase)
        EXPECT_LT(distance(b[k].phase_means[phase], a[k].phase_means[phase]), 1e-8);
    }
}

// A mesh of deal.II and ML share nothing with the fast path but the material.
TEST(Homogenization, EqualsMeshOfTheSameCells)
{
  Volume volume =
    make_volume(21, 14,
                {matrix_and_fibre()[0], matrix_and_fibre()[1],
                 stiffness_from_coefficients<2>({80e9, 12e9, 9e9, 35e9, -4e9, 20e9})},
                1e-4, 0.7e-4);
  make_random(volume);
  const auto fast = respond(volume);
  const auto mesh = respond(volume, 1e-10, StaticSolverKind::ml, MPI_COMM_WORLD);
  for (unsigned int k = 0; k < 3; ++k)
    EXPECT_LT(distance(fast[k].stiffness, mesh[k].stiffness), 1e-8) << "seed " << seed;
}

// On both meshes the stiffness is an upper bound, and linear triangles are the stiffer.
TEST(Homogenization, TrianglesConvergeToQuadrilaterals)
{
  std::array<double, 2> distances;
  for (unsigned int m = 0; m < 2; ++m)
    {
      const unsigned int n = 12 << m;
      Volume volume        = make_volume(n, n, matrix_and_fibre(), 12e-4 / n, 12e-4 / n);
      for (unsigned int k = 0; k < n * n; ++k)
        volume.id[k] = k % n / (n / 3) == 1 && k / n / (n / 3) == 1;
      const UniformMaterial material = volume.material();
      MeshBodyInput<2> input         = mesh_of_grid(material);
      input.mesh                     = cut_into_triangles(input.mesh);
      const MeshBody<2> triangles(input, MPI_COMM_WORLD);
      const auto solution =
        solve_load_cases(triangles, {BoundaryCondition::KUBC}, 1e-10, MPI_COMM_WORLD);
      const VoigtMatrix<2> Q1 = respond(volume)[0].stiffness,
                           P1 = respond(triangles, solution[0]).stiffness;
      EXPECT_GT(P1(0, 0), Q1(0, 0));
      distances[m] = distance(P1, Q1);
    }
  EXPECT_LT(distances[0], 0.02);
  EXPECT_LT(distances[1], 0.6 * distances[0]);
}

// Q1 is too stiff; finer grids of the same morphology are less so.
TEST(Homogenization, RefinementSoftens)
{
  std::vector<HomogenizedResponse<2>> previous;
  for (const unsigned int m : {1U, 2U, 4U})
    {
      Volume coarse = make_volume(12, 9, matrix_and_fibre());
      make_random(coarse);
      Volume volume = make_volume(12 * m, 9 * m, coarse.stiffness, 1e-4 / m, 1e-4 / m);
      for (unsigned int j = 0; j < 9 * m; ++j)
        for (unsigned int i = 0; i < 12 * m; ++i)
          volume.id[j * 12 * m + i] = coarse.id[j / m * 12 + i / m];
      const auto responses = respond(volume);
      for (const unsigned int k : {0U, 2U})
        for (unsigned int e = 0; e < 3 && !previous.empty(); ++e)
          {
            EXPECT_LT(responses[k].stiffness(e, e), previous[k].stiffness(e, e));
          }
      previous = responses;
    }
}

// Four morphologies placed by the rule of prm/pin: each entry of eq. (10) within 3 %,
// and the two boundary conditions within the 2.7 % that the paper reports.
TEST(Homogenization, PaperPin)
{
  const VoigtMatrix<2> paper =
    stiffness_from_coefficients<2>({36.54e9, 9.1e9, 47.26e9, 13.785e9});
  std::array<VoigtMatrix<2>, 2> mean;
  mean[0] = mean[1] = VoigtMatrix<2>::Zero();
  const UniformGrid<2> grid{{{560, 160}}, {{1e-4, 1e-4}}};
  for (unsigned int member = 0; member < 4; ++member)
    if (verification::has_turn(member))
      {
        FibrePlacement placement;
        placement.seed                 = 1 + member;
        placement.fraction_rule        = FractionRule::nominal;
        placement.allow_overlap        = true;
        placement.cut_by_border        = true;
        Volume volume                  = make_volume(560, 160, matrix_and_fibre());
        volume.id                      = place_random_fibres(grid, placement).map.id;
        const UniformMaterial material = volume.material();
        const GridBody<2> body(material);
        const auto solutions = solve_load_cases(
          body, {BoundaryCondition::KUBC, BoundaryCondition::SUBC}, 1e-6, MPI_COMM_SELF);
        for (unsigned int k = 0; k < 2; ++k)
          mean[k] += respond(body, solutions[k]).stiffness / 4.;
      }
  for (VoigtMatrix<2> &of_ranks : mean)
    MPI_Allreduce(MPI_IN_PLACE, of_ranks.data(), static_cast<int>(of_ranks.size()),
                  MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  for (const auto &entry : {std::pair<int, int>{0, 0}, {0, 1}, {1, 1}, {2, 2}})
    {
      const double kubc = mean[0](entry.first, entry.second),
                   subc = mean[1](entry.first, entry.second),
                   ref  = paper(entry.first, entry.second);
      EXPECT_NEAR(kubc, ref, 0.03 * ref);
      EXPECT_NEAR(subc, ref, 0.03 * ref);
      EXPECT_NEAR(kubc, subc, 0.027 * ref);
    }
}

// One that holds for all morphologies is said once, others with the seeds they are about.
TEST(Ensemble, WarningsNameTheirMorphologies)
{
  std::vector<EnsembleMember<2>> members(3);
  for (unsigned int k = 0; k < 3; ++k)
    {
      members[k].origin   = "seed " + std::to_string(3 + k);
      members[k].warnings = {"all", k == 0 ? "one" : "two"};
    }
  EXPECT_EQ(morphology_warnings<2>(members),
            (std::vector<std::string>{"all", "one (seed 3)", "two (seed 4, seed 5)"}));
}

TEST(Ensemble, StatisticsOfASample)
{
  // Mean 5, deviation sqrt(32/7); Student's 97.5 % quantile for 7 degrees is 2.364624.
  std::vector<EnsembleMember<2>> members;
  for (const double value : {2, 4, 4, 4, 5, 5, 7, 9})
    {
      members.emplace_back().responses.resize(1);
      members.back().responses[0].stiffness(0, 2) = value;
    }
  const StiffnessStatistics s = stiffness_statistics<2>(members, 0, 0.95);
  EXPECT_DOUBLE_EQ(s.mean(0, 2), 5.);
  EXPECT_NEAR(s.standard_deviation(0, 2), 2.138089935, 1e-9);
  EXPECT_NEAR(s.half_width(0, 2), 2.3646242516 * 2.138089935 / std::sqrt(8.), 1e-8);
  EXPECT_NEAR(s.relative_error(0, 2), 2. * 2.138089935 / (std::sqrt(8.) * 5.), 1e-9);
  EXPECT_EQ(s.relative_error(0, 0), 0.);
}
