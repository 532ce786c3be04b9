#include "material/stiffness_derivatives.h"

namespace mesoslip
{
namespace
{
/** Matrix with only the entries (i, j) and (j, i). */
VoigtMatrix<3>
pair_of_entries(const unsigned int i, const unsigned int j, const double value)
{
  VoigtMatrix<3> matrix = VoigtMatrix<3>::Zero();
  matrix(i, j) = matrix(j, i) = value;
  return matrix;
}
} // namespace

std::array<VoigtMatrix<3>, 2> isotropic_derivatives(const double young_modulus,
                                                    const double poisson_ratio)
{
  const double E = young_modulus, nu = poisson_ratio, plus = 1. + nu, less = 1. - 2. * nu;
  const double lambda     = E * (1. + 2. * nu * nu) / (plus * plus * less * less),
               mu         = -E / (2. * plus * plus);
  VoigtMatrix<3> by_ratio = VoigtMatrix<3>::Zero();
  by_ratio.topLeftCorner<3, 3>().setConstant(lambda);
  for (unsigned int i = 0; i < 6; ++i)
    by_ratio(i, i) = i < 3 ? lambda + 2. * mu : mu;
  return {{isotropic_stiffness<3>(1., nu), by_ratio}};
}

std::array<VoigtMatrix<3>, 9>
orthotropic_derivatives(const OrthotropicConstants &constants)
{
  const OrthotropicConstants &c = constants;
  const auto of_modulus         = [](const double E) { return -1. / (E * E); };
  // Derivatives of the compliance entries 1 / E_i, -nu_ij / E_i and 1 / G.
  VoigtMatrix<3> E1 = pair_of_entries(0, 0, of_modulus(c.E1)),
                 E2 = pair_of_entries(1, 1, of_modulus(c.E2));
  E1 += pair_of_entries(0, 1, c.nu12 / (c.E1 * c.E1)) +
        pair_of_entries(0, 2, c.nu13 / (c.E1 * c.E1));
  E2 += pair_of_entries(1, 2, c.nu23 / (c.E2 * c.E2));
  std::array<VoigtMatrix<3>, 9> derivatives = {
    {E1, E2, pair_of_entries(2, 2, of_modulus(c.E3)), pair_of_entries(0, 1, -1. / c.E1),
     pair_of_entries(0, 2, -1. / c.E1), pair_of_entries(1, 2, -1. / c.E2),
     pair_of_entries(5, 5, of_modulus(c.G12)), pair_of_entries(4, 4, of_modulus(c.G13)),
     pair_of_entries(3, 3, of_modulus(c.G23))}};
  const VoigtMatrix<3> C = orthotropic_stiffness<3>(c);
  for (VoigtMatrix<3> &derivative : derivatives)
    derivative = -(C * derivative * C).eval();
  return derivatives;
}

VoigtMatrix<2> plane_part(const VoigtMatrix<3> &stiffness)
{
  constexpr std::array<unsigned int, 3> in_plane = {{0, 1, 5}};
  VoigtMatrix<2> plane;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      plane(i, j) = stiffness(in_plane[i], in_plane[j]);
  return plane;
}
} // namespace mesoslip
