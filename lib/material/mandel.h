#ifndef mesoslip_material_mandel_h
#define mesoslip_material_mandel_h

#include "material/voigt.h"

namespace mesoslip
{
/**
 * Mandel's notation scales shear by sqrt(2), so that stress and strain live in the same
 * orthonormal basis: norms, eigenvalues and rotations of tensors are those of the
 * matrices. Voigt matrices with engineering shear lack all three.
 */
template <int dim>
VoigtMatrix<dim> stiffness_to_mandel(const VoigtMatrix<dim> &voigt);

/** Inverse of stiffness_to_mandel(). */
template <int dim>
VoigtMatrix<dim> stiffness_from_mandel(const VoigtMatrix<dim> &mandel);

/** The tensor's own eigenvalues (Pa), ascending; the antisymmetric part is ignored. */
template <int dim>
VoigtVector<dim> stiffness_eigenvalues(const VoigtMatrix<dim> &stiffness);

/**
 * Smallest eigenvalue (Pa) of upper - lower: not negative exactly when
 * strain : lower : strain <= strain : upper : strain for every strain.
 */
template <int dim>
double order_margin(const VoigtMatrix<dim> &lower, const VoigtMatrix<dim> &upper);

/** Frobenius norm of the tensor (Pa), independent of the axes. */
template <int dim>
double stiffness_norm(const VoigtMatrix<dim> &stiffness);
} // namespace mesoslip

#endif
