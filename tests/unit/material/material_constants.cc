// Bounds, engineering constants and the shear impedance against closed forms, table 1 and
// eq. (10) of the paper.
#include "material/bounds.h"
#include "material/engineering_constants.h"
#include "material/shear_impedance.h"
#include "material_testing.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <stdexcept>

using namespace material_testing;

namespace
{
/** Table 1. */
const std::vector<Phase<2>> paper_phases = {
  {"matrix", isotropic_stiffness<2>(30 * GPa, 0.2), 1770., 0.25},
  {"fibre", isotropic_stiffness<2>(240 * GPa, 0.2), 1770., 0.25}};

/** Each stiffness is above the one before. */
void expect_ascending(const std::vector<VoigtMatrix<2>> &stiffnesses)
{
  for (std::size_t k = 1; k < stiffnesses.size(); ++k)
    EXPECT_GT(stiffness_eigenvalues<2>(stiffnesses[k] - stiffnesses[k - 1])(0), 0.) << k;
}

double value_of(const std::vector<EngineeringConstant> &constants,
                const std::string &name)
{
  for (const EngineeringConstant &constant : constants)
    if (constant.name == name)
      return constant.value;
  return std::nan("");
}
} // namespace

TEST(Bounds, VoigtAndReussOfThePaper)
{
  const std::vector<double> f = {0.9, 0.1};
  const auto voigt            = voigt_bound<2>(paper_phases, f);
  const auto reuss            = reuss_bound<2>(paper_phases, f);
  // Equal Poisson ratios: the moduli are averaged.
  EXPECT_LT(largest_difference<3>(voigt, isotropic_stiffness<2>(51 * GPa, 0.2)), 1e-14);
  EXPECT_LT(largest_difference<3>(
              reuss, isotropic_stiffness<2>(GPa / (0.9 / 30. + 0.1 / 240.), 0.2)),
            1e-14);
  expect_ascending({reuss, paper_stiffness, voigt});
}

TEST(Bounds, EncloseTheLaminate)
{
  // Layers normal to x, half and half, exact: to the digits that were printed.
  const auto laminate = plane(59.259259, 14.814815, 144.328704, 22.222222);
  const auto reuss    = reuss_bound<2>(paper_phases, {0.5, 0.5});
  const auto voigt    = voigt_bound<2>(paper_phases, {0.5, 0.5});
  // Layers in series reach Reuss' bound in shear.
  EXPECT_NEAR(stiffness_eigenvalues<2>(laminate - reuss)(0), 0., 1e-6 * GPa);
  // Voigt's where the uniform strain happens to give both layers one sigma_xx.
  EXPECT_NEAR(stiffness_eigenvalues<2>(voigt - laminate)(0), 0., 1e-6 * GPa);
}

TEST(Bounds, HashinShtrikmanTwoPhases)
{
  const auto bounds = hashin_shtrikman_bounds<2>(paper_phases, {0.9, 0.1});
  ASSERT_TRUE(bounds);
  // Hashin's own form of the two-phase bounds.
  const double k1 = 125. / 6., k2 = 8. * k1, m1 = 12.5, m2 = 100., f1 = 0.9, f2 = 0.1;
  EXPECT_NEAR(bounds->lower.bulk / GPa, k1 + f2 / (1. / (k2 - k1) + f1 / (k1 + m1)),
              1e-11);
  EXPECT_NEAR(bounds->upper.bulk / GPa, k2 + f1 / (1. / (k1 - k2) + f2 / (k2 + m2)),
              1e-11);
  EXPECT_NEAR(bounds->lower.shear / GPa,
              m1 + f2 / (1. / (m2 - m1) + f1 * (k1 + 2. * m1) / (2. * m1 * (k1 + m1))),
              1e-11);
  EXPECT_NEAR(bounds->upper.shear / GPa,
              m2 + f1 / (1. / (m1 - m2) + f2 * (k2 + 2. * m2) / (2. * m2 * (k2 + m2))),
              1e-11);
  expect_ascending(
    {reuss_bound<2>(paper_phases, {0.9, 0.1}), isotropic_stiffness<2>(bounds->lower),
     isotropic_stiffness<2>(bounds->upper), voigt_bound<2>(paper_phases, {0.9, 0.1})});
}

TEST(Bounds, HashinShtrikmanLimits)
{
  // Equal shear moduli: the bulk modulus is exact (Hill), 1 / (k + G) = <1 / (k + G)>.
  std::vector<Phase<2>> phases = paper_phases;
  phases[0].stiffness          = isotropic_stiffness<2>({20 * GPa, 12 * GPa});
  phases[1].stiffness          = isotropic_stiffness<2>({90 * GPa, 12 * GPa});
  const auto exact             = hashin_shtrikman_bounds<2>(phases, {0.7, 0.3});
  EXPECT_NEAR(exact->lower.bulk, exact->upper.bulk, 1.);
  EXPECT_NEAR(exact->lower.bulk / GPa, 1. / (0.7 / 32. + 0.3 / 102.) - 12., 1e-9);
  EXPECT_NEAR(exact->lower.shear / GPa, 12., 1e-9);
  // A phase that is absent does not count; the bounds then are the other phase.
  const auto single = hashin_shtrikman_bounds<2>(phases, {1., 0.});
  EXPECT_LT(
    largest_difference<3>(isotropic_stiffness<2>(single->upper), phases[0].stiffness),
    1e-14);
  // Three phases lie in order, too.
  phases.push_back({"third", isotropic_stiffness<2>(5 * GPa, 0.4), 0., 0.});
  const std::vector<double> f = {0.5, 0.3, 0.2};
  const auto three            = hashin_shtrikman_bounds<2>(phases, f);
  expect_ascending({reuss_bound<2>(phases, f), isotropic_stiffness<2>(three->lower),
                    isotropic_stiffness<2>(three->upper), voigt_bound<2>(phases, f)});
  phases[2].stiffness = paper_stiffness;
  EXPECT_FALSE(hashin_shtrikman_bounds<2>(phases, f));
}

TEST(Bounds, RejectWrongFractions)
{
  EXPECT_THROW(voigt_bound<2>(paper_phases, {1.}), std::invalid_argument);
  EXPECT_THROW(reuss_bound<2>(paper_phases, {0.5, 0.4}), std::invalid_argument);
  EXPECT_THROW(reuss_bound<2>(paper_phases, {1.1, -0.1}), std::invalid_argument);
  EXPECT_THROW(reuss_bound<2>(paper_phases, {std::nan(""), 0.5}), std::invalid_argument);
}

TEST(EngineeringConstants, OfThePaper)
{
  const auto c = engineering_constants<2>(paper_stiffness);
  EXPECT_NEAR(value_of(c, "E_x") / GPa, 36.54 - 9.1 * 9.1 / 47.26, 1e-12);
  EXPECT_NEAR(value_of(c, "E_y") / GPa, 47.26 - 9.1 * 9.1 / 36.54, 1e-12);
  EXPECT_NEAR(value_of(c, "nu_xy"), 9.1 / 47.26, 1e-14);
  EXPECT_NEAR(value_of(c, "nu_yx"), 9.1 / 36.54, 1e-14);
  EXPECT_NEAR(value_of(c, "G_xy") / GPa, 13.785, 1e-12);
  EXPECT_NEAR(value_of(c, "eta_xy_x"), 0., 1e-15);
  EXPECT_NEAR(value_of(c, "axis_angle"), 0.5 * pi, 1e-12);
  EXPECT_NEAR(value_of(c, "non_orthotropy"), 0., 1e-14);
  EXPECT_GT(value_of(c, "anisotropy"), 0.1);
  EXPECT_TRUE(std::isnan(value_of(c, "E_z"))); // there is none
}

TEST(EngineeringConstants, IsotropicGivesBackEAndNu)
{
  const auto c = engineering_constants<2>(isotropic_stiffness<2>(30 * GPa, 0.2));
  EXPECT_NEAR(value_of(c, "E_iso") / GPa, 30., 1e-12);
  EXPECT_NEAR(value_of(c, "nu_iso"), 0.2, 1e-14);
  EXPECT_NEAR(value_of(c, "E_x") / GPa, 30. / (1. - 0.04), 1e-12);
  EXPECT_NEAR(value_of(c, "nu_xy"), 0.25, 1e-14);
  EXPECT_NEAR(value_of(c, "k") / GPa, 125. / 6., 1e-12);
  EXPECT_NEAR(value_of(c, "anisotropy"), 0., 1e-14);
  EXPECT_EQ(value_of(c, "axis_angle"), 0.);
  const auto c3 = engineering_constants<3>(isotropic_stiffness<3>(30 * GPa, 0.2));
  EXPECT_NEAR(value_of(c3, "E_iso") / GPa, 30., 1e-12);
  EXPECT_NEAR(value_of(c3, "nu_iso"), 0.2, 1e-14);
  EXPECT_NEAR(value_of(c3, "k") / GPa, 30. / 1.8, 1e-12);
}

TEST(EngineeringConstants, OrthotropicSolidGivesBackItsConstants)
{
  const auto c = engineering_constants<3>(orthotropic_stiffness<3>(carbon));
  EXPECT_NEAR(value_of(c, "E_x") / carbon.E1, 1., 1e-13);
  EXPECT_NEAR(value_of(c, "E_z") / carbon.E3, 1., 1e-13);
  EXPECT_NEAR(value_of(c, "nu_xz"), carbon.nu13, 1e-13);
  EXPECT_NEAR(value_of(c, "nu_yx"), carbon.nu12 * carbon.E2 / carbon.E1, 1e-13);
  EXPECT_NEAR(value_of(c, "G_yz") / carbon.G23, 1., 1e-13);
}

TEST(EngineeringConstants, FindsTurnedAxes)
{
  const auto D = orthotropic_stiffness<2>(carbon);
  for (const double angle : {-1.5, -0.7, -0.1, 0., 0.3, 0.9, 1.4})
    {
      const auto found = closest_orthotropic(rotate_stiffness<2>(D, angle));
      EXPECT_NEAR(found.angle, angle, 1e-12);
      EXPECT_LT(found.relative_distance, 1e-13);
      EXPECT_LT(largest_difference<3>(found.principal_stiffness, D), 1e-12);
    }
}

TEST(EngineeringConstants, ClosestOrthotropicIsClosest)
{
  const VoigtMatrix<2> D = plane(36.54, 9.1, 47.26, 13.785, 3., -1.);
  const auto found       = closest_orthotropic(D);
  double least           = 1.;
  for (int i = 0; i < 10000; ++i)
    {
      const VoigtMatrix<2> turned = rotate_stiffness<2>(D, i * pi / 10000);
      least = std::min(least, stiffness_norm<2>(turned - orthotropic_part<2>(turned)) /
                                stiffness_norm<2>(turned));
    }
  EXPECT_LT(found.relative_distance, least + 1e-12);
  EXPECT_GT(found.relative_distance, least - 1e-6);
  EXPECT_GE(found.principal_stiffness(0, 0), found.principal_stiffness(1, 1));
}

// rho c_T of an isotropic solid; sqrt(rho G) along the axes of an orthotropic one; of a turned one by the
// closed form of the root of a 2 x 2 matrix; in 3D across the axes no force acts.
TEST(ShearImpedance, IsThatOfShearWaves)
{
  const double density = 1770., G = 12.5 * GPa;
  EXPECT_NEAR(shear_impedance<2>(isotropic_stiffness<2>(30. * GPa, 0.2), density),
              std::sqrt(density * G), 1e-9 * std::sqrt(density * G));
  for (const double angle : {0., 0.4, 1.3})
    EXPECT_NEAR(shear_impedance<3>(isotropic_stiffness<3>(30. * GPa, 0.2), density,
                                   {{std::cos(angle), std::sin(angle)}}),
                std::sqrt(density * G), 1e-9 * std::sqrt(density * G));
  EXPECT_NEAR(shear_impedance<2>(paper_stiffness, density),
              std::sqrt(density * 13.785 * GPa), 1e-3);

  const VoigtMatrix<2> turned = plane(40., 9., 30., 12., 3., 5.);
  const double shear = 12. * GPa, normal = 30. * GPa, mixed = 5. * GPa;
  const double root = std::sqrt(shear * normal - mixed * mixed);
  const double due =
    std::sqrt(density) * (shear + root) / std::sqrt(shear + normal + 2. * root);
  EXPECT_NEAR(shear_impedance<2>(turned, density), due, 1e-9 * due);

  VoigtMatrix<3> solid = VoigtMatrix<3>::Identity() * GPa;
  solid(3, 3)          = 4. * GPa; // yz
  solid(4, 4)          = 9. * GPa; // xz
  const double x = std::sqrt(density * 9. * GPa), y = std::sqrt(density * 4. * GPa);
  EXPECT_NEAR(shear_impedance<3>(solid, density, {{1., 0.}}), x, 1e-9 * x);
  EXPECT_NEAR(shear_impedance<3>(solid, density, {{0., 1.}}), y, 1e-9 * y);
  EXPECT_NEAR(shear_impedance<3>(solid, density, {{0.6, 0.8}}),
              1. / (0.36 / x + 0.64 / y), 1e-9 * x);
}
