#include "material/shear_impedance.h"

#include <Eigen/Dense>

#include <cmath>

namespace mesoslip
{
template <int dim>
Eigen::Matrix<double, dim, dim> impedance(const VoigtMatrix<dim> &stiffness,
                                          const double density,
                                          const Eigen::Matrix<double, dim, 1> &normal)
{
  using Tensor = Eigen::Matrix<double, dim, dim>;
  Tensor gamma = Tensor::Zero();
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int l = 0; l < dim; ++l)
          gamma(i, k) += normal[j] * normal[l] *
                         stiffness(voigt_index<dim>(i, j), voigt_index<dim>(k, l));
  const Tensor symmetric = 0.5 * (gamma + gamma.transpose());
  return std::sqrt(density) *
         Eigen::SelfAdjointEigenSolver<Tensor>(symmetric).operatorSqrt();
}

template <int dim>
double shear_impedance(const VoigtMatrix<dim> &stiffness,
                       const double density,
                       const std::array<double, 2> &direction)
{
  const auto waves = impedance<dim>(stiffness, density);
  // The side slides freely along itself: no force across the direction.
  const Eigen::Matrix<double, dim - 1, dim - 1> along =
    waves.template topLeftCorner<dim - 1, dim - 1>();
  const Eigen::Map<const Eigen::Matrix<double, dim - 1, 1>> unit(direction.data());
  return 1. / unit.dot(along.inverse() * unit);
}

template Eigen::Matrix2d
impedance<2>(const VoigtMatrix<2> &, const double, const Eigen::Vector2d &);
template Eigen::Matrix3d
impedance<3>(const VoigtMatrix<3> &, const double, const Eigen::Vector3d &);
template double
shear_impedance<2>(const VoigtMatrix<2> &, const double, const std::array<double, 2> &);
template double
shear_impedance<3>(const VoigtMatrix<3> &, const double, const std::array<double, 2> &);
} // namespace mesoslip
