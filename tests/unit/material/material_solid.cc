// Bounds and engineering constants in 3D against closed forms.
#include "material/bounds.h"
#include "material/engineering_constants.h"
#include "material/stiffness.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace mesoslip;

TEST(Bounds, HashinShtrikmanInThreeDimensions)
{
  const std::vector<Phase<3>> phases = {
    {"soft", isotropic_stiffness<3>({20 * 1e9, 12 * 1e9}), 0., 0.},
    {"stiff", isotropic_stiffness<3>({150 * 1e9, 100 * 1e9}), 0., 0.}};
  const auto bounds = hashin_shtrikman_bounds<3>(phases, {0.7, 0.3});
  ASSERT_TRUE(bounds);
  // The form of Hashin and Shtrikman (1963) for two phases, from phase 1 on.
  const auto original = [](const double k1, const double m1, const double f1,
                           const double k2, const double m2, const double f2) {
    return IsotropicModuli{k1 + f2 / (1. / (k2 - k1) + 3. * f1 / (3. * k1 + 4. * m1)),
                           m1 +
                             f2 / (1. / (m2 - m1) + 6. * f1 * (k1 + 2. * m1) /
                                                      (5. * m1 * (3. * k1 + 4. * m1)))};
  };
  const auto lower = original(20., 12., 0.7, 150., 100., 0.3);
  const auto upper = original(150., 100., 0.3, 20., 12., 0.7);
  EXPECT_NEAR(bounds->lower.bulk / 1e9, lower.bulk, 1e-11);
  EXPECT_NEAR(bounds->lower.shear / 1e9, lower.shear, 1e-11);
  EXPECT_NEAR(bounds->upper.bulk / 1e9, upper.bulk, 1e-11);
  EXPECT_NEAR(bounds->upper.shear / 1e9, upper.shear, 1e-11);
  // A stiffness is that of its moduli: uniform dilatation, and shear.
  const auto D = isotropic_stiffness<3>(bounds->lower);
  EXPECT_NEAR((D.topLeftCorner<3, 3>().sum()) / 9. / 1e9, lower.bulk, 1e-11);
  EXPECT_NEAR(D(5, 5) / 1e9, lower.shear, 1e-11);
  EXPECT_NEAR((D(0, 0) - D(0, 1)) / 2. / 1e9, lower.shear, 1e-11);
  // Reuss, the bounds and Voigt lie in this order.
  const std::vector<VoigtMatrix<3>> ascending = {
    reuss_bound<3>(phases, {0.7, 0.3}), isotropic_stiffness<3>(bounds->lower),
    isotropic_stiffness<3>(bounds->upper), voigt_bound<3>(phases, {0.7, 0.3})};
  for (std::size_t k = 1; k < ascending.size(); ++k)
    EXPECT_GT(stiffness_eigenvalues<3>(ascending[k] - ascending[k - 1])(0), 0.) << k;
}

// A solid turned by an angle about z: the coefficients are those of its transformed
// compliance in closed form. Along its axes nothing is coupled.
TEST(EngineeringConstants, CouplingsInThreeDimensions)
{
  const OrthotropicConstants carbon = {140e9, 10e9, 8e9, 0.3, 0.28, 0.4, 5e9, 4e9, 3e9};
  const auto constant = [](const std::vector<EngineeringConstant> &constants,
                           const std::string &name) {
    for (const EngineeringConstant &c : constants)
      if (c.name == name)
        return c.value;
    return std::nan("");
  };
  const VoigtMatrix<3> S = orthotropic_stiffness<3>(carbon).inverse();
  const double angle = 0.4, c = std::cos(angle), s = std::sin(angle);
  const VoigtMatrix<3> D = rotate_stiffness<3>(orthotropic_stiffness<3>(carbon), angle);
  const auto found       = engineering_constants<3>(D);
  const double a         = 2. * S(0, 0) - 2. * S(0, 1) - S(5, 5),
               b         = 2. * S(1, 1) - 2. * S(0, 1) - S(5, 5);
  const double Sxx       = S(0, 0) * std::pow(c, 4) + S(1, 1) * std::pow(s, 4) +
                     (2. * S(0, 1) + S(5, 5)) * c * c * s * s,
               Sxs = a * c * c * c * s - b * c * s * s * s,
               Szs = 2. * (S(0, 2) - S(1, 2)) * c * s;
  EXPECT_NEAR(constant(found, "E_x") * Sxx, 1., 1e-12);
  EXPECT_NEAR(constant(found, "eta_xy_x"), Sxs / Sxx, 1e-12);
  EXPECT_NEAR(constant(found, "eta_x_xy"), Sxs * constant(found, "G_xy"), 1e-12);
  EXPECT_NEAR(constant(found, "eta_xy_z"), Szs / S(2, 2), 1e-12);
  EXPECT_NEAR(constant(found, "eta_xz_yz"),
              c * s * (S(4, 4) - S(3, 3)) / (S(3, 3) * c * c + S(4, 4) * s * s), 1e-12);
  EXPECT_NEAR(constant(found, "eta_yz_x"), 0., 1e-12);
  EXPECT_NEAR(
    constant(engineering_constants<3>(orthotropic_stiffness<3>(carbon)), "eta_xy_x"), 0.,
    1e-15);
}
