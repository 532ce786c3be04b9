#include "material/engineering_constants.h"

#include "material/stiffness.h"

#include <cmath>
#include <stdexcept>

namespace mesoslip
{
namespace
{
using Constants = std::vector<EngineeringConstant>;

const double pi = std::acos(-1.);

/** Half the derivative of the squared entries 13 and 23 when the axes turn. */
double coupling_slope(const VoigtMatrix<2> &stiffness)
{
  const VoigtMatrix<2> M = stiffness_to_mandel<2>(stiffness);
  const double r         = std::sqrt(2.);
  VoigtMatrix<2> W;
  W << 0., 0., -r, 0., 0., r, r, -r, 0.;
  const VoigtMatrix<2> slope = M * W - W * M;
  return M(0, 2) * slope(0, 2) + M(1, 2) * slope(1, 2);
}

double coupling(const VoigtMatrix<2> &stiffness)
{
  return std::hypot(stiffness(0, 2), stiffness(1, 2));
}

/** Angle in [0, pi/2) of the axes with the least coupling of shear and extension. */
double least_coupled_angle(const VoigtMatrix<2> &stiffness)
{
  const auto turned = [&](const double angle) {
    return rotate_stiffness<2>(stiffness, -angle);
  };
  // The coupling is a polynomial of degree 8 in cos and sin and has period pi/2.
  constexpr unsigned int n_samples = 180;
  const double step                = 0.5 * pi / n_samples;
  const double noise               = 1e-13 * stiffness_norm<2>(stiffness);
  double best                      = 0.;
  double least                     = coupling(stiffness);
  for (unsigned int i = 1; i < n_samples && least > noise; ++i)
    if (const double c = coupling(turned(i * step)); c < least - noise)
      {
        best  = i * step;
        least = c;
      }
  if (least <= noise)
    return best;
  double low = best - step, high = best + step;
  for (unsigned int i = 0; i < 60; ++i)
    {
      const double middle                                = 0.5 * (low + high);
      (coupling_slope(turned(middle)) > 0. ? high : low) = middle;
    }
  return 0.5 * (low + high);
}

Constants axis_constants(const VoigtMatrix<2> &S)
{
  return {{"E_x", "Pa", 1. / S(0, 0), "plane-strain Young's modulus along x"},
          {"E_y", "Pa", 1. / S(1, 1), "plane-strain Young's modulus along y"},
          {"nu_xy", "1", -S(0, 1) / S(0, 0),
           "plane-strain Poisson's ratio, contraction along y, load along x"},
          {"nu_yx", "1", -S(0, 1) / S(1, 1),
           "plane-strain Poisson's ratio, contraction along x, load along y"},
          {"G_xy", "Pa", 1. / S(2, 2), "shear modulus"},
          {"eta_xy_x", "1", S(0, 2) / S(0, 0),
           "mutual influence: shear over extension, load along x"},
          {"eta_xy_y", "1", S(1, 2) / S(1, 1),
           "mutual influence: shear over extension, load along y"},
          {"eta_x_xy", "1", S(0, 2) / S(2, 2),
           "mutual influence: extension along x over shear, shear load"},
          {"eta_y_xy", "1", S(1, 2) / S(2, 2),
           "mutual influence: extension along y over shear, shear load"},
          {"k", "Pa", 1. / (S(0, 0) + 2. * S(0, 1) + S(1, 1)),
           "plane bulk modulus, equal stress along x and y"}};
}

Constants axis_constants(const VoigtMatrix<3> &S)
{
  const std::string axes[] = {"x", "y", "z"}, planes[] = {"yz", "xz", "xy"};
  Constants constants;
  for (unsigned int i = 0; i < 3; ++i)
    {
      constants.push_back(
        {"E_" + axes[i], "Pa", 1. / S(i, i), "Young's modulus along " + axes[i]});
      for (unsigned int j = 0; j < 3; ++j)
        if (i != j)
          constants.push_back({"nu_" + axes[i] + axes[j], "1", -S(i, j) / S(i, i),
                               "Poisson's ratio, contraction along " + axes[j] +
                                 ", load along " + axes[i]});
      constants.push_back({"G_" + planes[i], "Pa", 1. / S(3 + i, 3 + i),
                           "shear modulus in the plane " + planes[i]});
    }
  for (unsigned int p = 0; p < 3; ++p)
    {
      const unsigned int row   = 3 + p;
      const std::string &shear = planes[p];
      for (unsigned int i = 0; i < 3; ++i)
        {
          constants.push_back({"eta_" + shear + "_" + axes[i], "1", S(row, i) / S(i, i),
                               "mutual influence: shear " + shear +
                                 " over extension, load along " + axes[i]});
          constants.push_back({"eta_" + axes[i] + "_" + shear, "1",
                               S(i, row) / S(row, row),
                               "mutual influence: extension along " + axes[i] +
                                 " over shear, shear load " + shear});
        }
      for (unsigned int q = 0; q < 3; ++q)
        if (p != q)
          constants.push_back({"eta_" + planes[q] + "_" + shear, "1",
                               S(3 + q, row) / S(row, row),
                               "Chentsov's coefficient: shear " + planes[q] +
                                 " over shear, shear load " + shear});
    }
  constants.push_back({"k", "Pa", 1. / S.topLeftCorner<3, 3>().sum(),
                       "bulk modulus, equal stress along all axes"});
  return constants;
}
} // namespace

template <int dim>
std::vector<EngineeringConstant> engineering_constants(const VoigtMatrix<dim> &stiffness)
{
  check_stiffness<dim>(stiffness);
  Constants constants                 = axis_constants(inverse<dim>(stiffness));
  const IsotropicProjection isotropic = closest_isotropic<dim>(stiffness);
  constants.insert(constants.end(),
                   {{"E_iso", "Pa", isotropic.young_modulus,
                     "Young's modulus (3D) of the closest isotropic solid"},
                    {"nu_iso", "1", isotropic.poisson_ratio,
                     "Poisson's ratio (3D) of the closest isotropic solid"},
                    {"G_iso", "Pa", isotropic.shear_modulus,
                     "shear modulus of the closest isotropic solid"},
                    {"anisotropy", "1", isotropic.relative_distance,
                     "relative distance to the closest isotropic solid"}});
  if constexpr (dim == 2)
    {
      const OrthotropicProjection orthotropic = closest_orthotropic(stiffness);
      constants.push_back(
        {"axis_angle", "rad", orthotropic.angle,
         "from x to the stiffer axis of the closest orthotropic solid"});
      constants.push_back({"non_orthotropy", "1", orthotropic.relative_distance,
                           "relative distance to the closest orthotropic solid"});
    }
  return constants;
}

template <int dim>
IsotropicProjection closest_isotropic(const VoigtMatrix<dim> &stiffness)
{
  const VoigtMatrix<dim> M = stiffness_to_mandel<dim>(stiffness);
  // Traces over the subspaces of dilatations and of deviators.
  const double dilatation = M.template topLeftCorner<dim, dim>().sum() / dim;
  const double deviators  = M.trace() - dilatation;

  IsotropicProjection result;
  const double k       = dilatation / dim;
  const double mu      = 0.5 * deviators / (n_voigt<dim> - 1);
  const double bulk    = dim == 2 ? k - mu / 3. : k; // k = lambda + mu in 2D
  result.bulk_modulus  = k;
  result.shear_modulus = mu;
  result.young_modulus = 9. * bulk * mu / (3. * bulk + mu);
  result.poisson_ratio = (3. * bulk - 2. * mu) / (2. * (3. * bulk + mu));

  VoigtMatrix<dim> rest = M - 2. * mu * VoigtMatrix<dim>::Identity();
  rest.template topLeftCorner<dim, dim>().array() -= k - 2. * mu / dim;
  result.relative_distance = rest.norm() / M.norm();
  return result;
}

OrthotropicProjection closest_orthotropic(const VoigtMatrix<2> &stiffness)
{
  OrthotropicProjection result;
  const double angle          = least_coupled_angle(stiffness);
  const VoigtMatrix<2> turned = rotate_stiffness<2>(stiffness, -angle);
  const double norm           = stiffness_norm<2>(stiffness);
  const bool swap             = turned(1, 1) > turned(0, 0) + 1e-12 * norm;
  const double full           = swap ? angle + 0.5 * pi : angle;
  result.angle                = full > 0.5 * pi * (1. + 1e-15) ? full - pi : full;
  result.principal_stiffness = orthotropic_part<2>(rotate_stiffness<2>(stiffness, -full));
  const VoigtMatrix<2> closest = rotate_stiffness<2>(result.principal_stiffness, full);
  result.relative_distance     = stiffness_norm<2>(stiffness - closest) / norm;
  return result;
}

template <int dim>
VoigtMatrix<dim> orthotropic_part(const VoigtMatrix<dim> &stiffness)
{
  VoigtMatrix<dim> D = stiffness;
  for (const StiffnessEntry &entry : stiffness_entries<dim>())
    if (entry.couples_shear(dim))
      D(entry.row, entry.column) = D(entry.column, entry.row) = 0.;
  return D;
}

template std::vector<EngineeringConstant>
engineering_constants<2>(const VoigtMatrix<2> &);
template std::vector<EngineeringConstant>
engineering_constants<3>(const VoigtMatrix<3> &);
template IsotropicProjection closest_isotropic<2>(const VoigtMatrix<2> &);
template IsotropicProjection closest_isotropic<3>(const VoigtMatrix<3> &);
template VoigtMatrix<2> orthotropic_part<2>(const VoigtMatrix<2> &);
template VoigtMatrix<3> orthotropic_part<3>(const VoigtMatrix<3> &);
} // namespace mesoslip
