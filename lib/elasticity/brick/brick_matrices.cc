#include "elasticity/brick/brick_matrices.h"

#include "elasticity/brick/coefficients.h"

#include <cmath>

namespace mesoslip
{
namespace
{
using StrainMatrix = Eigen::Matrix<double, 6, 24>;

/** Strains of the nodal displacements at @p point, with coordinates from -1 to 1. */
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

/** Stiffness for the mean strain of a cell, and for the deviation from it. */
struct TwoStiffnesses
{
  VoigtMatrix<3> mean, about;
};

/** Stiffnesses with coefficient @p m equal to one, all others zero. */
TwoStiffnesses unit_stiffnesses(const unsigned int m, const unsigned int n_coefficients)
{
  VoigtMatrix<3> C = VoigtMatrix<3>::Zero(), zero = C;
  if (n_coefficients == n_general || n_coefficients == n_general_apart)
    {
      const StiffnessEntry entry = stiffness_entries<3>()[m % n_general];
      C(entry.row, entry.column) = C(entry.column, entry.row) = 1.;
      if (n_coefficients == n_general_apart)
        return m < n_general ? TwoStiffnesses{C, zero} : TwoStiffnesses{zero, C};
      return {C, C};
    }
  if (m == 1)
    {
      C.diagonal() << 2., 2., 2., 1., 1., 1.;
      return {C, C};
    }
  C.topLeftCorner<3, 3>().setOnes();
  if (n_coefficients == n_isotropic_apart)
    return m == 0 ? TwoStiffnesses{C, zero} : TwoStiffnesses{zero, C};
  return {C, C};
}

/** Entries of the upper triangle. */
std::vector<double> triangle_of(const VoigtMatrix<3> &stiffness)
{
  std::vector<double> result;
  for (const StiffnessEntry &entry : stiffness_entries<3>())
    result.push_back(stiffness(entry.row, entry.column));
  return result;
}
} // namespace

std::vector<BrickMatrix> brick_matrices(const std::array<double, 3> &spacing,
                                        const unsigned int n_coefficients)
{
  const double volume     = spacing[0] * spacing[1] * spacing[2],
               factor     = volume / (16. * spacing[1] * spacing[1]),
               gauss      = 1. / std::sqrt(3.);
  const StrainMatrix mean = strain_at({{0., 0., 0.}}, spacing);
  std::vector<BrickMatrix> matrices;
  for (unsigned int m = 0; m < n_coefficients; ++m)
    {
      const auto [of_mean, about] = unit_stiffnesses(m, n_coefficients);
      BrickMatrix sum             = 8. * mean.transpose() * of_mean * mean;
      for (unsigned int q = 0; q < 8; ++q)
        {
          const auto coordinate = [&](const unsigned int a) {
            return (q >> a & 1U) != 0 ? gauss : -gauss;
          };
          const StrainMatrix B =
            strain_at({{coordinate(0), coordinate(1), coordinate(2)}}, spacing) - mean;
          sum += B.transpose() * about * B;
        }
      matrices.emplace_back(volume / 8. / factor * sum);
    }
  return matrices;
}

std::vector<double> coefficients_of(const ElasticPhase<3> &phase,
                                    const unsigned int n_coefficients)
{
  const VoigtMatrix<3> &C    = phase.stiffness;
  const VoigtMatrix<3> about = phase.stiffness_about_mean();
  const double lambda = C(0, 1), mu = C(5, 5), other = about(0, 1);
  switch (n_coefficients)
    {
    case n_isotropic:
      return {lambda, mu};
    case n_isotropic_apart:
      return {lambda, mu, other};
    case n_cubes:
      return {lambda, mu, other / 3., (other + 4. * mu) / 9.};
    case n_orthotropic:
      return {C(0, 0), C(0, 1), C(0, 2), C(1, 1), C(1, 2),
              C(2, 2), C(3, 3), C(4, 4), C(5, 5)};
    default:
      std::vector<double> result = triangle_of(C);
      if (n_coefficients == n_general_apart)
        {
          const std::vector<double> more = triangle_of(about);
          result.insert(result.end(), more.begin(), more.end());
        }
      return result;
    }
}

BrickStiffness::BrickStiffness(const std::array<double, 3> &spacing)
  : matrices(brick_matrices(spacing, n_general_apart))
{
}

BrickMatrix BrickStiffness::operator()(const ElasticPhase<3> &phase) const
{
  const std::vector<double> coefficients = coefficients_of(phase, n_general_apart);
  BrickMatrix sum                        = BrickMatrix::Zero();
  for (std::size_t m = 0; m < coefficients.size(); ++m)
    sum += coefficients[m] * matrices[m];
  return sum;
}
} // namespace mesoslip
