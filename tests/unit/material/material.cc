// Stiffnesses and their rotation against closed forms.
#include "material_testing.h"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace material_testing;

TEST(Stiffness, IsotropicPlaneStrain)
{
  const VoigtMatrix<2> expected = plane(100. / 3., 25. / 3., 100. / 3., 12.5);
  EXPECT_LT(largest_difference<3>(isotropic_stiffness<2>(30 * GPa, 0.2), expected),
            1e-15);
}

TEST(Stiffness, IsotropicThreeDimensional)
{
  // Uniaxial tension: E along the axis, -nu E across.
  const VoigtMatrix<3> S = isotropic_stiffness<3>(210 * GPa, 0.3).inverse();
  EXPECT_NEAR(S(0, 0) * 210 * GPa, 1., 1e-14);
  EXPECT_NEAR(S(1, 0) * 210 * GPa, -0.3, 1e-14);
  EXPECT_NEAR(S(4, 4) * 210 * GPa, 2.6, 1e-14);
}

TEST(Stiffness, OrthotropicPlaneStrainIsReducedCompliance)
{
  // Plane strain the other way: S_ij - S_i3 S_3j / S_33, inverted.
  const double s11 = 1. / carbon.E1, s22 = 1. / carbon.E2, s33 = 1. / carbon.E3;
  const double s12 = -carbon.nu12 / carbon.E1, s13 = -carbon.nu13 / carbon.E1,
               s23 = -carbon.nu23 / carbon.E2;
  VoigtMatrix<2> S = VoigtMatrix<2>::Zero();
  S(0, 0)          = s11 - s13 * s13 / s33;
  S(1, 1)          = s22 - s23 * s23 / s33;
  S(0, 1) = S(1, 0) = s12 - s13 * s23 / s33;
  S(2, 2)           = 1. / carbon.G12;
  const auto D      = orthotropic_stiffness<2>(carbon);
  EXPECT_LT(largest_difference<3>(D, S.inverse()), 1e-13);
  const auto D3 = orthotropic_stiffness<3>(carbon);
  EXPECT_EQ(D3(0, 1), D(0, 1));
  EXPECT_EQ(D3(3, 3), carbon.G23);
  EXPECT_EQ(D3(5, 5), carbon.G12);
}

TEST(Stiffness, OrthotropicWithEqualConstantsIsIsotropic)
{
  const double E = 30 * GPa, nu = 0.2, G = E / 2.4;
  const auto D = orthotropic_stiffness<3>({E, E, E, nu, nu, nu, G, G, G});
  EXPECT_LT(largest_difference<6>(D, isotropic_stiffness<3>(E, nu)), 1e-14);
}

TEST(Stiffness, FromCoefficients)
{
  EXPECT_EQ(stiffness_from_coefficients<2>({36.54e9, 9.1e9, 47.26e9, 13.785e9}),
            paper_stiffness);
  EXPECT_EQ(stiffness_from_coefficients<2>({4., 1., 0.5, 3., 0.25, 2.}) * GPa,
            plane(4., 1., 3., 2., 0.5, 0.25));
  const auto D = stiffness_from_coefficients<3>({9., 2., 3., 8., 4., 7., 1., 1.5, 2.});
  EXPECT_EQ(D(0, 2), 3.);
  EXPECT_EQ(D(1, 1), 8.);
  EXPECT_EQ(D(2, 1), 4.);
  EXPECT_EQ(D(5, 5), 2.);
}

TEST(Stiffness, RejectsWhatIsNoMaterial)
{
  EXPECT_THROW(isotropic_stiffness<2>(0., 0.2), std::invalid_argument);
  EXPECT_THROW(isotropic_stiffness<2>(std::nan(""), 0.2), std::invalid_argument);
  EXPECT_THROW(isotropic_stiffness<2>(1., 0.5), std::invalid_argument);
  EXPECT_THROW(isotropic_stiffness<2>(1., -1.), std::invalid_argument);
  EXPECT_THROW(isotropic_stiffness<2>(1., std::nan("")), std::invalid_argument);
  EXPECT_THROW(stiffness_from_coefficients<2>({1., 2., 3.}), std::invalid_argument);
  // Indefinite: Dxy larger than the geometric mean of Dxx and Dyy.
  EXPECT_THROW(stiffness_from_coefficients<2>({1., 2., 3., 1.}), std::invalid_argument);
  VoigtMatrix<2> D = paper_stiffness;
  D(0, 1) *= 1.001;
  EXPECT_THROW(check_stiffness<2>(D), std::invalid_argument);
  // nu12 of the other direction: |nu12| must stay below sqrt(E1 / E2) = 3.74.
  OrthotropicConstants wrong = carbon;
  wrong.nu12                 = 3.8;
  EXPECT_THROW(orthotropic_stiffness<2>(wrong), std::invalid_argument);
}

TEST(Mandel, EigenvaluesAreThoseOfTheTensor)
{
  // Isotropic plane strain: 2 k for dilatation, 2 mu twice.
  const auto e = stiffness_eigenvalues<2>(isotropic_stiffness<2>(30 * GPa, 0.2));
  EXPECT_NEAR(e(0) / GPa, 25., 1e-12);
  EXPECT_NEAR(e(1) / GPa, 25., 1e-12);
  EXPECT_NEAR(e(2) / GPa, 2. * (100. / 3. - 12.5), 1e-12);
  EXPECT_EQ(stiffness_from_mandel<2>(stiffness_to_mandel<2>(paper_stiffness))
              .isApprox(paper_stiffness, 1e-15),
            true);
}

TEST(Rotation, QuarterTurnSwaps)
{
  const auto D = rotate_stiffness<2>(plane(36.54, 9.1, 47.26, 13.785, 1., 2.), 0.5 * pi);
  EXPECT_LT(largest_difference<3>(D, plane(47.26, 9.1, 36.54, 13.785, -2., -1.)), 1e-15);
}

TEST(Rotation, ByFortyFiveDegrees)
{
  // Strain xx in the turned axes is half a dilatation and half a shear.
  const VoigtMatrix<2> D = rotate_stiffness<2>(paper_stiffness, 0.25 * pi) / GPa;
  EXPECT_NEAR(D(0, 0), (36.54 + 47.26 + 2. * 9.1) / 4. + 13.785, 1e-12);
  EXPECT_NEAR(D(2, 2), (36.54 + 47.26 - 2. * 9.1) / 4., 1e-12);
  // The stiffer axis y went to the direction of 135 degrees: stretching along it and
  // shear of negative sign go together.
  EXPECT_NEAR(D(0, 2), (36.54 - 47.26) / 4., 1e-12);
}

TEST(Rotation, KeepsEigenvalues)
{
  const VoigtMatrix<2> D      = plane(36.54, 9.1, 47.26, 13.785, 1., 2.);
  const VoigtMatrix<2> turned = rotate_stiffness<2>(D, 0.7);
  EXPECT_LT((stiffness_eigenvalues<2>(D) - stiffness_eigenvalues<2>(turned)).norm(),
            1e-3);
}

namespace
{
/** Turns a stiffness as the tensor of rank four that it is, C_ijkl of 81 entries. */
VoigtMatrix<3> turned_as_tensor(const VoigtMatrix<3> &D, const Eigen::Matrix3d &R)
{
  VoigtMatrix<3> result = VoigtMatrix<3>::Zero();
  const auto at         = [](const int c, const int d) { return voigt_index<3>(c, d); };
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = k; l < 3; ++l)
          for (int path = 0; path < 81; ++path)
            {
              const int p = path / 27, q = path / 9 % 3, r = path / 3 % 3, s = path % 3;
              result(at(i, j), at(k, l)) +=
                R(i, p) * R(j, q) * R(k, r) * R(l, s) * D(at(p, q), at(r, s));
            }
  return result;
}

/** Triclinic: all 21 entries differ. */
VoigtMatrix<3> triclinic_stiffness()
{
  VoigtMatrix<3> A;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      A(i, j) = std::sin(1. + 7. * i + 3. * j * j);
  return GPa * (A * A.transpose() + 2. * VoigtMatrix<3>::Identity());
}

Eigen::Matrix3d rotation_about(const int axis, const double angle)
{
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  R(a, a) = R(b, b) = std::cos(angle);
  R(b, a)           = std::sin(angle);
  R(a, b)           = -R(b, a);
  return R;
}
} // namespace

TEST(Stiffness, TurnsAsATensorOfRankFour)
{
  const VoigtMatrix<3> D = triclinic_stiffness();
  for (const double angle : {0.3, 1.1, -2.5})
    {
      const Eigen::Matrix3d R = rotation_about(0, angle) *
                                rotation_about(1, 0.7 * angle) *
                                rotation_about(2, 2. - angle);
      const VoigtMatrix<3> turned = turn_stiffness(D, R);
      EXPECT_LT((turned - turned_as_tensor(D, R)).norm(), 1e-14 * D.norm());
      EXPECT_LT((turn_stiffness(turned, R.transpose()) - D).norm(), 1e-14 * D.norm());
      EXPECT_LT(
        (turn_stiffness(D, rotation_about(2, angle)) - rotate_stiffness<3>(D, angle))
          .norm(),
        1e-14 * D.norm());
    }
}

TEST(Stiffness, BungeAnglesAndAxes)
{
  const double phi_1 = 0.4, Phi = 1.2, phi_2 = -0.9;
  const Eigen::Matrix3d R = bunge_rotation(phi_1, Phi, phi_2);
  EXPECT_LT(
    (R - rotation_about(2, phi_1) * rotation_about(0, Phi) * rotation_about(2, phi_2))
      .norm(),
    1e-15);
  // Row one of g, as printed by Bunge (1982), eq. (2.50), is axis 1 of the crystal.
  const double c_1 = std::cos(phi_1), s_1 = std::sin(phi_1), c_2 = std::cos(phi_2),
               s_2 = std::sin(phi_2), c = std::cos(Phi), s = std::sin(Phi);
  EXPECT_LT((R.col(0) - Eigen::Vector3d(c_1 * c_2 - s_1 * s_2 * c,
                                        s_1 * c_2 + c_1 * s_2 * c, s_2 * s))
              .norm(),
            1e-15);
  EXPECT_LT((R.col(2) - Eigen::Vector3d(s_1 * s, -c_1 * s, c)).norm(), 1e-15);
  EXPECT_LT(
    (rotation_from_axes(3. * R.col(0), 0.1 * R.col(1) + 1e-3 * R.col(0)) - R).norm(),
    1e-15);
  EXPECT_THROW(rotation_from_axes({1., 0., 0.}, {0.1, 1., 0.}), std::invalid_argument);
  EXPECT_THROW(rotation_from_axes({1., 0., 0.}, {0., 0., 0.}), std::invalid_argument);
  // Axis 1 along y: its modulus is that of yy.
  const VoigtMatrix<3> D =
    orthotropic_stiffness<3>({140e9, 10e9, 9e9, 0.3, 0.3, 0.4, 5e9, 4e9, 3e9});
  const VoigtMatrix<3> turned =
    turn_stiffness(D, rotation_from_axes({0., 1., 0.}, {0., 0., 1.}));
  EXPECT_NEAR(turned(1, 1), D(0, 0), 1.);
  EXPECT_NEAR(turned(2, 2), D(1, 1), 1.);
  EXPECT_NEAR(turned(0, 0), D(2, 2), 1.);
  EXPECT_NEAR(turned(3, 3), D(5, 5), 1.); // the plane y, z is 1, 2
}
