#ifndef mesoslip_material_shear_impedance_h
#define mesoslip_material_shear_impedance_h

#include "material/voigt.h"

#include <Eigen/Core>

#include <array>

namespace mesoslip
{
/** Impedance matrix (Pa s/m) of a half-space: tractions on its plane side over the
 * velocities of the side, sqrt(rho) Gamma^(1/2), see shear_impedance(). An isotropic
 * solid has rho c_T along the side and rho c_L along the @p normal, of length one, by
 * default the last axis. */
template <int dim>
Eigen::Matrix<double, dim, dim> impedance(const VoigtMatrix<dim> &stiffness,
                                          const double density,
                                          const Eigen::Matrix<double, dim, 1> &normal =
                                            Eigen::Matrix<double, dim, 1>::Unit(dim - 1));

/**
 * Shear traction that moves the plane side of a half-space along @p direction at
 * constant speed, over that speed (Pa s/m); the side does not move along its normal, the
 * last axis, and has no traction across @p direction. With the tensor Gamma_ik = C_(i n
 * k n) of the normal n, waves into the body need the traction sqrt(rho) Gamma^(1/2) v;
 * an isotropic solid has rho c_T. @p direction has length one, along x and, in 3D, y.
 */
template <int dim>
double shear_impedance(const VoigtMatrix<dim> &stiffness,
                       const double density,
                       const std::array<double, 2> &direction = {{1., 0.}});
} // namespace mesoslip

#endif
