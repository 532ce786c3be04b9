#include "material/stiffness.h"

#include "material/symmetric_eigenvalues.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace mesoslip
{
namespace
{
template <typename... Parts>
[[noreturn]] void fail(const Parts &...parts)
{
  std::ostringstream text;
  text.precision(12);
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

void require_positive(const char *name, const double value)
{
  if (!(value > 0.) || !std::isfinite(value))
    fail(name, " is ", value, " and must be a positive number");
}

template <int dim>
VoigtVector<dim> mandel_scale()
{
  VoigtVector<dim> scale = VoigtVector<dim>::Ones();
  scale.template tail<n_voigt<dim> - dim>().setConstant(std::sqrt(2.));
  return scale;
}

/** Rotation about z for stresses and strains in Mandel's notation; orthogonal. */
template <int dim>
VoigtMatrix<dim> mandel_rotation(const double angle)
{
  const double c  = std::cos(angle);
  const double s  = std::sin(angle);
  const double cs = std::sqrt(2.) * c * s;
  // Rotation of xx, yy and xy, which is last in 3D.
  constexpr int xy   = n_voigt<dim> - 1;
  VoigtMatrix<dim> Q = VoigtMatrix<dim>::Identity();
  Q(0, 0) = Q(1, 1) = c * c;
  Q(0, 1) = Q(1, 0) = s * s;
  Q(1, xy) = Q(xy, 0) = cs;
  Q(0, xy) = Q(xy, 1) = -cs;
  Q(xy, xy)           = c * c - s * s;
  if constexpr (dim == 3)
    {
      // yz and xz rotate like the vector (x, y).
      Q(3, 3) = Q(4, 4) = c;
      Q(3, 4)           = s;
      Q(4, 3)           = -s;
    }
  return Q;
}
} // namespace

template <int dim>
VoigtMatrix<dim> isotropic_stiffness(const double young_modulus,
                                     const double poisson_ratio)
{
  require_positive("Young's modulus", young_modulus);
  if (!(poisson_ratio > -1. && poisson_ratio < 0.5))
    fail("Poisson's ratio is ", poisson_ratio, " and must lie between -1 and 0.5");
  const double mu = young_modulus / (2. * (1. + poisson_ratio));
  const double lambda =
    young_modulus * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));

  VoigtMatrix<dim> D = VoigtMatrix<dim>::Zero();
  D.template topLeftCorner<dim, dim>().setConstant(lambda);
  for (unsigned int i = 0; i < n_voigt<dim>; ++i)
    D(i, i) = (i < dim ? lambda + 2. * mu : mu);
  return D;
}

template <int dim>
VoigtMatrix<dim> orthotropic_stiffness(const OrthotropicConstants &c)
{
  require_positive("E1", c.E1);
  require_positive("E2", c.E2);
  require_positive("E3", c.E3);
  require_positive("G12", c.G12);
  require_positive("G13", c.G13);
  require_positive("G23", c.G23);

  Eigen::Matrix3d S;
  S << 1. / c.E1, -c.nu12 / c.E1, -c.nu13 / c.E1, //
    -c.nu12 / c.E1, 1. / c.E2, -c.nu23 / c.E2,    //
    -c.nu13 / c.E1, -c.nu23 / c.E2, 1. / c.E3;
  // Scaled to a unit diagonal, so that the test does not depend on ratios of moduli.
  const Eigen::Vector3d scale(std::sqrt(c.E1), std::sqrt(c.E2), std::sqrt(c.E3));
  const Eigen::Matrix3d scaled = scale.asDiagonal() * S * scale.asDiagonal();
  if (!(symmetric_eigenvalues(scaled)[0] > 1e-12))
    fail("the Poisson ratios nu12 = ", c.nu12, ", nu13 = ", c.nu13, ", nu23 = ", c.nu23,
         " do not fit the Young moduli: some strain would release energy; note that nu_ij"
         " belongs to a load along i, so |nu_ij| must be below sqrt(E_i / E_j)");

  const Eigen::Matrix3d normal = S.inverse();
  VoigtMatrix<dim> D           = VoigtMatrix<dim>::Zero();
  D.template topLeftCorner<dim, dim>() =
    0.5 * (normal + normal.transpose()).topLeftCorner<dim, dim>();
  if constexpr (dim == 2)
    D(2, 2) = c.G12;
  else
    {
      D(3, 3) = c.G23;
      D(4, 4) = c.G13;
      D(5, 5) = c.G12;
    }
  return D;
}

template <int dim>
VoigtMatrix<dim> stiffness_from_coefficients(const std::vector<double> &coefficients)
{
  constexpr unsigned int n       = n_voigt<dim>;
  constexpr unsigned int n_full  = n * (n + 1) / 2;
  constexpr unsigned int n_short = dim * (dim + 1) / 2 + (n - dim);
  if (coefficients.size() != n_full && coefficients.size() != n_short)
    fail("there are ", coefficients.size(), " stiffness coefficients and there must be ",
         n_short, " (orthotropic axes) or ", n_full, " (upper triangle, row by row)");

  const bool is_short = coefficients.size() == n_short;
  VoigtMatrix<dim> D  = VoigtMatrix<dim>::Zero();
  auto next           = coefficients.begin();
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = i; j < n; ++j)
      if (!is_short || j < dim || i == j)
        D(i, j) = D(j, i) = *next++;
  check_stiffness<dim>(D);
  return D;
}

template <int dim>
void check_stiffness(const VoigtMatrix<dim> &stiffness)
{
  if (!stiffness.allFinite())
    fail("the stiffness has an entry that is not a finite number");
  const double largest   = stiffness.cwiseAbs().maxCoeff();
  const double asymmetry = (stiffness - stiffness.transpose()).cwiseAbs().maxCoeff();
  if (!(asymmetry <= 1e-9 * largest))
    fail("the stiffness is not symmetric: two entries differ by ", asymmetry, " Pa");
  const double smallest = stiffness_eigenvalues<dim>(stiffness)(0);
  if (!(smallest > 1e-12 * largest))
    fail("the stiffness is not positive definite: its smallest eigenvalue is ", smallest,
         " Pa");
}

template <int dim>
VoigtMatrix<dim> stiffness_to_mandel(const VoigtMatrix<dim> &voigt)
{
  const VoigtVector<dim> scale = mandel_scale<dim>();
  return scale.asDiagonal() * voigt * scale.asDiagonal();
}

template <int dim>
VoigtMatrix<dim> stiffness_from_mandel(const VoigtMatrix<dim> &mandel)
{
  const VoigtVector<dim> scale = mandel_scale<dim>().cwiseInverse();
  return scale.asDiagonal() * mandel * scale.asDiagonal();
}

template <int dim>
VoigtVector<dim> stiffness_eigenvalues(const VoigtMatrix<dim> &stiffness)
{
  const VoigtMatrix<dim> mandel = stiffness_to_mandel<dim>(stiffness);
  const VoigtMatrix<dim> even   = 0.5 * (mandel + mandel.transpose());
  return symmetric_eigenvalues(even);
}

template <int dim>
VoigtMatrix<dim> inverse(const VoigtMatrix<dim> &tensor)
{
  return tensor.inverse();
}

template <int dim>
VoigtMatrix<dim> without_dilatation(const VoigtMatrix<dim> &stiffness)
{
  VoigtMatrix<dim> P = VoigtMatrix<dim>::Identity();
  P.template topLeftCorner<dim, dim>().array() -= 1. / dim;
  const VoigtMatrix<dim> result = P * stiffness * P;
  return 0.5 * (result + result.transpose());
}

template <int dim>
double apparent_poisson_ratio(const VoigtMatrix<dim> &stiffness)
{
  const VoigtMatrix<dim> compliance = inverse<dim>(stiffness);
  const double share = compliance.template topLeftCorner<dim, dim>().sum() /
                       compliance.template topLeftCorner<dim, dim>().trace();
  return (1. - share) / (dim == 2 ? 2. - share : 2.);
}

template <int dim>
VoigtMatrix<dim> with_poisson_ratio_at_most(const VoigtMatrix<dim> &stiffness,
                                            const double ratio)
{
  if (!(apparent_poisson_ratio<dim>(stiffness) > ratio))
    return stiffness;
  // By S' = S + k S m m^T S / (1 - k m.S m) for C - k m m^T.
  const VoigtMatrix<dim> S = inverse<dim>(stiffness);
  const double share       = (1. - 2. * ratio) / (dim == 2 ? 1. - ratio : 1.),
               trace       = S.template topLeftCorner<dim, dim>().trace(),
               pressed     = S.template topLeftCorner<dim, dim>().sum(),
               square =
                 S.template topLeftCorner<dim, dim>().rowwise().sum().squaredNorm();
  VoigtMatrix<dim> result = stiffness;
  result.template topLeftCorner<dim, dim>().array() -=
    (trace - pressed / share) / (trace * pressed - square);
  return result;
}

template <int dim>
double stiffness_norm(const VoigtMatrix<dim> &stiffness)
{
  return stiffness_to_mandel<dim>(stiffness).norm();
}

template <int dim>
VoigtMatrix<dim> rotate_stiffness(const VoigtMatrix<dim> &stiffness, const double angle)
{
  const VoigtMatrix<dim> Q = mandel_rotation<dim>(angle);
  return stiffness_from_mandel<dim>(Q * stiffness_to_mandel<dim>(stiffness) *
                                    Q.transpose());
}

bool is_isotropic(const VoigtMatrix<3> &stiffness)
{
  const double lambda = stiffness(0, 1), mu = stiffness(5, 5);
  VoigtMatrix<3> difference = stiffness;
  difference.topLeftCorner<3, 3>().array() -= lambda;
  difference.diagonal().head<3>().array() -= 2. * mu;
  difference.diagonal().tail<3>().array() -= mu;
  return difference.cwiseAbs().maxCoeff() <= 1e-12 * stiffness.cwiseAbs().maxCoeff();
}

VoigtMatrix<3> turn_stiffness(const VoigtMatrix<3> &stiffness,
                              const Eigen::Matrix3d &rotation)
{
  constexpr unsigned int axes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  const Eigen::Matrix3d &R          = rotation;
  VoigtMatrix<3> Q; // rotation in Mandel's notation, orthogonal
  for (unsigned int row = 0; row < 6; ++row)
    for (unsigned int column = 0; column < 6; ++column)
      {
        const auto [i, j] = axes[row];
        const auto [k, l] = axes[column];
        const double both = column < 3 ? 0. : R(i, l) * R(j, k);
        const double scale =
          (row < 3 ? 1. : std::sqrt(2.)) / (column < 3 ? 1. : std::sqrt(2.));
        Q(row, column) = scale * (R(i, k) * R(j, l) + both);
      }
  const VoigtMatrix<3> turned =
    stiffness_from_mandel<3>(Q * stiffness_to_mandel<3>(stiffness) * Q.transpose());
  return 0.5 * (turned + turned.transpose());
}

VoigtVector<3> turn_stress(const VoigtVector<3> &stress, const Eigen::Matrix3d &rotation)
{
  Eigen::Matrix3d tensor;
  for (unsigned int c = 0; c < 3; ++c)
    for (unsigned int d = 0; d < 3; ++d)
      tensor(c, d) = stress[voigt_index<3>(c, d)];
  tensor = rotation * tensor * rotation.transpose();
  VoigtVector<3> turned;
  for (unsigned int c = 0; c < 3; ++c)
    for (unsigned int d = c; d < 3; ++d)
      turned[voigt_index<3>(c, d)] = tensor(c, d);
  return turned;
}

VoigtVector<3> turned_expansion(const Eigen::Vector3d &along_axes,
                                const Eigen::Matrix3d &rotation)
{
  VoigtVector<3> expansion = VoigtVector<3>::Zero();
  expansion.head<3>()      = along_axes;
  expansion                = turn_stress(expansion, rotation);
  expansion.tail<3>() *= 2.;
  return expansion;
}

Eigen::Matrix3d bunge_rotation(const double phi_1, const double Phi, const double phi_2)
{
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(phi_1, Vector3d::UnitZ()) * AngleAxisd(Phi, Vector3d::UnitX()) *
          AngleAxisd(phi_2, Vector3d::UnitZ()))
    .toRotationMatrix();
}

Eigen::Matrix3d rotation_from_axes(const Eigen::Vector3d &axis_1,
                                   const Eigen::Vector3d &axis_2)
{
  const double lengths        = axis_1.norm() * axis_2.norm();
  constexpr double one_degree = 0.01746; // cosine of 89 degrees
  if (!(lengths > 0.))
    fail("axis 1 or axis 2 has no length");
  if (!(std::fabs(axis_1.dot(axis_2)) <= one_degree * lengths))
    fail("axis 1 and axis 2 make an angle of ",
         std::round(std::acos(axis_1.dot(axis_2) / lengths) * 180. / M_PI),
         " degrees and must be perpendicular");
  Eigen::Matrix3d rotation;
  rotation.col(0) = axis_1.normalized();
  rotation.col(1) = (axis_2 - axis_2.dot(rotation.col(0)) * rotation.col(0)).normalized();
  rotation.col(2) = rotation.col(0).cross(rotation.col(1));
  return rotation;
}

template VoigtMatrix<2> isotropic_stiffness<2>(const double, const double);
template VoigtMatrix<3> isotropic_stiffness<3>(const double, const double);
template VoigtMatrix<2> orthotropic_stiffness<2>(const OrthotropicConstants &);
template VoigtMatrix<3> orthotropic_stiffness<3>(const OrthotropicConstants &);
template VoigtMatrix<2> stiffness_from_coefficients<2>(const std::vector<double> &);
template VoigtMatrix<3> stiffness_from_coefficients<3>(const std::vector<double> &);
template void check_stiffness<2>(const VoigtMatrix<2> &);
template void check_stiffness<3>(const VoigtMatrix<3> &);
template VoigtMatrix<2> stiffness_to_mandel<2>(const VoigtMatrix<2> &);
template VoigtMatrix<3> stiffness_to_mandel<3>(const VoigtMatrix<3> &);
template VoigtMatrix<2> stiffness_from_mandel<2>(const VoigtMatrix<2> &);
template VoigtMatrix<3> stiffness_from_mandel<3>(const VoigtMatrix<3> &);
template VoigtVector<2> stiffness_eigenvalues<2>(const VoigtMatrix<2> &);
template VoigtMatrix<2> without_dilatation<2>(const VoigtMatrix<2> &);
template VoigtMatrix<3> without_dilatation<3>(const VoigtMatrix<3> &);
template VoigtMatrix<2> with_poisson_ratio_at_most<2>(const VoigtMatrix<2> &,
                                                      const double);
template VoigtMatrix<3> with_poisson_ratio_at_most<3>(const VoigtMatrix<3> &,
                                                      const double);
template double apparent_poisson_ratio<2>(const VoigtMatrix<2> &);
template double apparent_poisson_ratio<3>(const VoigtMatrix<3> &);
template VoigtMatrix<2> inverse<2>(const VoigtMatrix<2> &);
template VoigtMatrix<3> inverse<3>(const VoigtMatrix<3> &);
template VoigtVector<3> stiffness_eigenvalues<3>(const VoigtMatrix<3> &);
template double stiffness_norm<2>(const VoigtMatrix<2> &);
template double stiffness_norm<3>(const VoigtMatrix<3> &);
template VoigtMatrix<2> rotate_stiffness<2>(const VoigtMatrix<2> &, const double);
template VoigtMatrix<3> rotate_stiffness<3>(const VoigtMatrix<3> &, const double);
} // namespace mesoslip
