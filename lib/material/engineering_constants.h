#ifndef mesoslip_material_engineering_constants_h
#define mesoslip_material_engineering_constants_h

#include "material/voigt.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** An engineering constant for tables and summaries. */
struct EngineeringConstant
{
  /** Such as E_x, nu_xy or G_xy. */
  std::string name;
  /** "Pa", or "1" for pure numbers, "rad" for angles. */
  std::string unit;
  double value; ///< in that unit
  /** A phrase that explains the constant. */
  std::string meaning;
};

/**
 * All constants that follow from an effective stiffness (Pa).
 *
 * 2D: the plane-strain moduli of the compliance S = D^-1 (E_x = 1 / S11, nu_xy =
 * -S12 / S11, G_xy = 1 / S33, coefficients of mutual influence eta_xy_x = S13 / S11,
 * eta_xy_y = S23 / S22, eta_x_xy = S13 / S33, eta_y_xy = S23 / S33), plane bulk modulus,
 * the closest isotropic solid with its three-dimensional E and nu and its distance, and
 * the closest orthotropic solid with the angle of its axes and its distance (0: is
 * isotropic, orthotropic).
 *
 * 3D: E, nu and G along the axes, coefficients of mutual influence (eta_xy_z = S63 / S33,
 * eta_z_xy = S36 / S66), Chentsov's coefficients (eta_xz_yz = S54 / S44), bulk modulus,
 * closest isotropic solid.
 *
 * Throws std::invalid_argument when the stiffness is not positive definite.
 */
template <int dim>
std::vector<EngineeringConstant> engineering_constants(const VoigtMatrix<dim> &stiffness);

/** The isotropic solid closest to a stiffness in the Frobenius norm of the tensor. */
struct IsotropicProjection
{
  /** Pa, of the three-dimensional solid. */
  double young_modulus;
  double poisson_ratio; ///< three-dimensional solid
  /** Pa; plane bulk modulus lambda + mu in 2D, lambda + 2 mu / 3 in 3D. */
  double bulk_modulus;
  double shear_modulus; ///< Pa
  /** ||C - C_iso|| / ||C||, 0 for an isotropic stiffness. */
  double relative_distance;
};

/**
 * Projection onto bulk and shear modulus; the modulus of the solid for plane strain. @p
 * stiffness in Pa.
 */
template <int dim>
IsotropicProjection closest_isotropic(const VoigtMatrix<dim> &stiffness);

/** The orthotropic solid closest to a plane stiffness, its axes turned freely. */
struct OrthotropicProjection
{
  /** Angle (rad) from x to the stiffer axis, in (-pi/2, pi/2]. */
  double angle;
  /** Pa, in its own axes: entries 13 and 23 vanish, D11 >= D22. */
  VoigtMatrix<2> principal_stiffness;
  /** ||C - C_ortho|| / ||C||, 0 for an orthotropic stiffness. */
  double relative_distance;
};

/**
 * Searches the angle of the axes that leaves the least D13 and D23. @p stiffness in Pa.
 */
OrthotropicProjection closest_orthotropic(const VoigtMatrix<2> &stiffness);

/** The orthotropic part in the coordinate axes: entries that couple a shear to another
 * component are set to zero, in 2D 13 and 23. */
template <int dim>
VoigtMatrix<dim> orthotropic_part(const VoigtMatrix<dim> &stiffness);
} // namespace mesoslip

#endif
