#include "material/mandel.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace mesoslip
{
namespace
{
template <int dim>
VoigtVector<dim> mandel_scale()
{
  VoigtVector<dim> scale = VoigtVector<dim>::Ones();
  scale.template tail<n_voigt<dim> - dim>().setConstant(std::sqrt(2.));
  return scale;
}
} // namespace

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
  return Eigen::SelfAdjointEigenSolver<VoigtMatrix<dim>>(even, Eigen::EigenvaluesOnly)
    .eigenvalues();
}

template <int dim>
double order_margin(const VoigtMatrix<dim> &lower, const VoigtMatrix<dim> &upper)
{
  return stiffness_eigenvalues<dim>(upper - lower)(0);
}

template <int dim>
double stiffness_norm(const VoigtMatrix<dim> &stiffness)
{
  return stiffness_to_mandel<dim>(stiffness).norm();
}

template VoigtMatrix<2> stiffness_to_mandel<2>(const VoigtMatrix<2> &);
template VoigtMatrix<3> stiffness_to_mandel<3>(const VoigtMatrix<3> &);
template VoigtMatrix<2> stiffness_from_mandel<2>(const VoigtMatrix<2> &);
template VoigtMatrix<3> stiffness_from_mandel<3>(const VoigtMatrix<3> &);
template VoigtVector<2> stiffness_eigenvalues<2>(const VoigtMatrix<2> &);
template VoigtVector<3> stiffness_eigenvalues<3>(const VoigtMatrix<3> &);
template double order_margin<2>(const VoigtMatrix<2> &, const VoigtMatrix<2> &);
template double order_margin<3>(const VoigtMatrix<3> &, const VoigtMatrix<3> &);
template double stiffness_norm<2>(const VoigtMatrix<2> &);
template double stiffness_norm<3>(const VoigtMatrix<3> &);
} // namespace mesoslip
