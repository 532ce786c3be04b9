#ifndef mesoslip_material_stiffness_h
#define mesoslip_material_stiffness_h

#include "material/voigt.h"

#include <vector>

namespace mesoslip
{
/**
 * Stiffness (Pa) of an isotropic solid; plane strain in 2D.
 * Throws std::invalid_argument unless E > 0 and -1 < nu < 0.5.
 */
template <int dim>
VoigtMatrix<dim> isotropic_stiffness(const double young_modulus,
                                     const double poisson_ratio);

/**
 * Engineering constants of an orthotropic solid whose axes 1, 2, 3 are x, y, z.
 * nu_ij = -strain_j / strain_i when only stress_i acts, so that nu_ij / E_i = nu_ji /
 * E_j. Moduli in Pa.
 */
struct OrthotropicConstants
{
  double E1;   ///< Young's modulus along axis 1
  double E2;   ///< Young's modulus along axis 2
  double E3;   ///< Young's modulus along axis 3
  double nu12; ///< contraction along 2 by tension along 1
  double nu13; ///< contraction along 3 by tension along 1
  double nu23; ///< contraction along 3 by tension along 2
  double G12;  ///< shear modulus in the plane 1, 2
  double G13;  ///< shear modulus in the plane 1, 3
  double G23;  ///< shear modulus in the plane 2, 3
};

/**
 * Stiffness (Pa) of an orthotropic solid. In 2D the xx, yy, xy block of the
 * three-dimensional stiffness, which is plane strain.
 * Throws std::invalid_argument when the constants do not give a positive definite matrix.
 */
template <int dim>
VoigtMatrix<dim> orthotropic_stiffness(const OrthotropicConstants &constants);

/**
 * Stiffness (Pa) from its upper triangle read row by row: 6 values in 2D (D11, D12,
 * D13, D22, D23, D33), 21 in 3D. The short form for orthotropic axes leaves out the
 * zeros: 4 values in 2D (D11, D12, D22, D33), 9 in 3D (D11, D12, D13, D22, D23, D33,
 * D44, D55, D66). Throws std::invalid_argument for any other number and for a matrix
 * that is not positive definite.
 */
template <int dim>
VoigtMatrix<dim> stiffness_from_coefficients(const std::vector<double> &coefficients);

/**
 * Throws std::invalid_argument, with the reason, unless @p stiffness is finite, symmetric
 * (to 1e-9 of its largest entry) and positive definite.
 */
template <int dim>
void check_stiffness(const VoigtMatrix<dim> &stiffness);

/**
 * Converts to Mandel's notation. It scales shear by sqrt(2), so that stress and strain
 * share an orthonormal basis: norms, eigenvalues and rotations of tensors are those of
 * the matrices. Voigt matrices with engineering shear lack all three properties.
 */
template <int dim>
VoigtMatrix<dim> stiffness_to_mandel(const VoigtMatrix<dim> &voigt);

/** Inverse of stiffness_to_mandel(). */
template <int dim>
VoigtMatrix<dim> stiffness_from_mandel(const VoigtMatrix<dim> &mandel);

/** The tensor's own eigenvalues (Pa), ascending; the antisymmetric part is ignored. */
template <int dim>
VoigtVector<dim> stiffness_eigenvalues(const VoigtMatrix<dim> &stiffness);

/** Compliance of a stiffness (1/Pa), or the other way round: Eigen's inverse, which takes
 * seconds to compile. */
template <int dim>
VoigtMatrix<dim> inverse(const VoigtMatrix<dim> &tensor);

/**
 * P^T C P (Pa), where P subtracts the mean of the normal strains: the stiffness against
 * strains without volume change (2D: area change). For an isotropic solid lambda becomes
 * -2 mu / dim.
 */
template <int dim>
VoigtMatrix<dim> without_dilatation(const VoigtMatrix<dim> &stiffness);

/**
 * Poisson's ratio of an isotropic solid. For an anisotropic solid: ratio of the
 * isotropic solid with the same quotient of bulk compliance to the sum of normal
 * compliances.
 */
template <int dim>
double apparent_poisson_ratio(const VoigtMatrix<dim> &stiffness);

/** Reduces the apparent Poisson's ratio to @p ratio by subtracting a multiple of k m
 * m^T, the stiffness against volume change (2D: area change); unchanged if it is not
 * larger. */
template <int dim>
VoigtMatrix<dim> with_poisson_ratio_at_most(const VoigtMatrix<dim> &stiffness,
                                            const double ratio);

/** Phases whose quadrilaterals and hexahedra have mean dilatation (one volume change per
 * cell). */
enum class MeanDilatation
{
  automatic, ///< nearly incompressible phases, see least_poisson_ratio
  always,    ///< all phases
  never      ///< no phase
};

/** Apparent Poisson's ratio from which a phase is nearly incompressible: 0.45, plus a
 * margin so that a ratio of exactly 0.45 is never included because of round-off. */
constexpr double least_poisson_ratio = 0.450001;

/** Whether a phase with this stiffness has mean dilatation. */
template <int dim>
bool has_mean_dilatation(const VoigtMatrix<dim> &stiffness, const MeanDilatation choice)
{
  return choice == MeanDilatation::always ||
         (choice == MeanDilatation::automatic &&
          apparent_poisson_ratio<dim>(stiffness) >= least_poisson_ratio);
}

/** Frobenius norm of the tensor (Pa), independent of the axes. */
template <int dim>
double stiffness_norm(const VoigtMatrix<dim> &stiffness);

/**
 * The stiffness of the same solid turned counter-clockwise by @p angle (rad) about z,
 * in the old axes. A quarter turn swaps xx and yy.
 */
template <int dim>
VoigtMatrix<dim> rotate_stiffness(const VoigtMatrix<dim> &stiffness, const double angle);

/**
 * The stiffness of the same solid, rotated such that its axis k, originally along
 * coordinate axis k, lies along column k of @p rotation, an orthogonal matrix.
 */
VoigtMatrix<3> turn_stiffness(const VoigtMatrix<3> &stiffness,
                              const Eigen::Matrix3d &rotation);

/** Expansions (1/K, engineering shear) of a solid that expands by @p along_axes along its
 * axes, which are the columns of @p rotation. */
VoigtVector<3> turned_expansion(const Eigen::Vector3d &along_axes,
                                const Eigen::Matrix3d &rotation);

/** The stress (Pa), or a similar tensor, of a solid that is rotated as in
 * turn_stiffness(). */
VoigtVector<3> turn_stress(const VoigtVector<3> &stress, const Eigen::Matrix3d &rotation);

/**
 * Rotation matrix of a material with Bunge's Euler angles (rad); columns are its axes.
 * The material is rotated about its axis 3 by @p phi_1, then about its axis 1 by @p Phi,
 * then about its axis 3 by @p phi_2, each counter-clockwise. Bunge's matrix g, from
 * space to crystal, is the transpose.
 */
Eigen::Matrix3d bunge_rotation(const double phi_1, const double Phi, const double phi_2);

/**
 * Rotation matrix of a material whose axis 1 lies along @p axis_1 and axis 2 along
 * @p axis_2, vectors of any length. Throws std::invalid_argument unless they are
 * perpendicular to one degree; the component of @p axis_2 along @p axis_1 is removed.
 */
Eigen::Matrix3d rotation_from_axes(const Eigen::Vector3d &axis_1,
                                   const Eigen::Vector3d &axis_2);

/** Whether lambda and mu determine the stiffness, to 1e-12 of the largest entry. */
bool is_isotropic(const VoigtMatrix<3> &stiffness);

/** Whether normal strains cause only normal stresses, and each shear only its own shear
 * stress. */
template <int dim>
bool is_orthotropic(const VoigtMatrix<dim> &C)
{
  for (int i = 0; i < n_voigt<dim>; ++i)
    for (int j = dim; j < n_voigt<dim>; ++j)
      if (i != j && (C(i, j) != 0. || C(j, i) != 0.))
        return false;
  return true;
}

} // namespace mesoslip

#endif
