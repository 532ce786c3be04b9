#include "elasticity/brick/brick_matrices.h"

#include "elasticity/brick/coefficients.h"

#include <cmath>

namespace mesoslip
{
namespace
{
using StrainMatrix = Eigen::Matrix<double, 6, 24>;

/** Strains at a point from -1 to 1. */
StrainMatrix strain_at(const std::array<double, 3> &point, const std::array<double, 3> &h)
{
  StrainMatrix B = StrainMatrix::Zero();
  for (unsigned int n = 0; n < 8; ++n)
    {
      std::array<double, 3> gradient;
      for (unsigned int d = 0; d < 3; ++d)
        {
          gradient[d] = 1. / (4. * h[d]);
          for (unsigned int a = 0; a < 3; ++a)
            {
              const double side = (n >> a & 1U) != 0 ? 1. : -1.;
              gradient[d] *= a == d ? side : 1. + side * point[a];
            }
        }
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          B(voigt_index<3>(c, d), 3 * n + c) = gradient[d];
    }
  return B;
}

/** The stiffness whose coefficient @p m is one. */
VoigtMatrix<3> unit_stiffness(const unsigned int m, const unsigned int n_coefficients)
{
  VoigtMatrix<3> C = VoigtMatrix<3>::Zero();
  if (n_coefficients == n_general)
    {
      const StiffnessEntry entry = stiffness_entries<3>()[m];
      C(entry.row, entry.column) = C(entry.column, entry.row) = 1.;
    }
  else if (m == 0)
    C.topLeftCorner<3, 3>().setOnes();
  else
    C.diagonal() << 2., 2., 2., 1., 1., 1.;
  return C;
}
} // namespace

std::vector<BrickMatrix> brick_matrices(const std::array<double, 3> &spacing,
                                        const unsigned int n_coefficients)
{
  const double volume = spacing[0] * spacing[1] * spacing[2],
               factor = volume / (16. * spacing[1] * spacing[1]);
  std::vector<BrickMatrix> matrices(n_coefficients, BrickMatrix::Zero());
  const double gauss = 1. / std::sqrt(3.);
  for (unsigned int q = 0; q < 8; ++q)
    {
      const auto coordinate = [&](const unsigned int a) {
        return (q >> a & 1U) != 0 ? gauss : -gauss;
      };
      const StrainMatrix B =
        strain_at({{coordinate(0), coordinate(1), coordinate(2)}}, spacing);
      for (unsigned int m = 0; m < n_coefficients; ++m)
        matrices[m] +=
          volume / 8. / factor * (B.transpose() * unit_stiffness(m, n_coefficients) * B);
    }
  return matrices;
}

std::vector<double> coefficients_of(const VoigtMatrix<3> &stiffness,
                                    const unsigned int n_coefficients)
{
  if (n_coefficients == n_isotropic)
    return {stiffness(0, 1), stiffness(5, 5)};
  if (n_coefficients == n_orthotropic)
    return {stiffness(0, 0), stiffness(0, 1), stiffness(0, 2),
            stiffness(1, 1), stiffness(1, 2), stiffness(2, 2),
            stiffness(3, 3), stiffness(4, 4), stiffness(5, 5)};
  std::vector<double> result;
  for (unsigned int i = 0; i < 6; ++i)
    for (unsigned int j = i; j < 6; ++j)
      result.push_back(stiffness(i, j));
  return result;
}
} // namespace mesoslip
