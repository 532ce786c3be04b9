#ifndef mesoslip_morphology_phases_phase_parameters_h
#define mesoslip_morphology_phases_phase_parameters_h

#include "material/stiffness.h"
#include "material/voigt.h"

#include <algorithm>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** A material constant of a phase. */
template <int dim>
struct PhaseConstant
{
  std::string name; ///< such as E, nu12 or D11
  std::string unit; ///< "Pa", or "1" for pure numbers
  double value;     ///< in that unit
  double deviation; ///< standard deviation; 0: exactly known

  /** Derivative of the stiffness (Pa) with respect to the constant. */
  VoigtMatrix<dim> derivative;
};

/** Section `Phases/<name>`: the material of one phase. */
struct PhaseParameters
{
  /** Keys that define the stiffness. */
  enum class Type
  {
    isotropic,
    orthotropic,
    stiffness
  };

  std::string name;            ///< name of the phase and of its subsection
  Type type = Type::isotropic; ///< key Type

  double young_modulus = 0.;          ///< Pa, of an isotropic phase
  double poisson_ratio = 0.2;         ///< nu of an isotropic phase
  std::vector<double> young_moduli;   ///< E1, E2, E3 (Pa) of an orthotropic phase
  std::vector<double> poisson_ratios; ///< nu12, nu13, nu23
  std::vector<double> shear_moduli;   ///< G12, G13, G23 (Pa)
  std::vector<double> coefficients;   ///< Pa, see stiffness_from_coefficients()

  std::vector<double> euler_angles;   ///< degrees, Bunge's, in 3D; empty: none
  std::vector<double> axis_1;         ///< direction of axis 1 in 3D; empty: along x
  std::vector<double> axis_2;         ///< direction of axis 2
  double angle                = 0.;   ///< rad, counter-clockwise from x to axis 1
  double density              = 0.;   ///< kg/m^3; 0: not given
  double friction_coefficient = 0.25; ///< Coulomb, of contact nodes in the phase

  /** Relative standard deviations of the constants, one for all or one each; empty:
   * exactly known. */
  std::vector<double> deviations;

  /** Thermal expansion (1/K) along the axes 1, 2, 3 of the material, one number for all
   * of them; empty: none. */
  std::vector<double> expansion;

  /** Conductivity (W/(m K) or S/m) along the axes 1, 2, 3 of the material, one number for
   * all of them; empty: not given. */
  std::vector<double> conductivities;

  double loss_factor = 0.; ///< imaginary over real part of the stiffness [-]

  /** Throws UserError naming the key if the material is invalid. */
  template <int dim>
  void check() const;

  /** Stiffness (Pa). Throws std::invalid_argument where check() throws. */
  template <int dim>
  VoigtMatrix<dim> stiffness() const;

  /** Phase::thermal_stress (Pa/K), subtracted per kelvin; in 2D plane strain. */
  template <int dim>
  VoigtVector<dim> thermal_stress() const;

  /** Conductivity (W/(m K) or S/m) in coordinate axes, in 2D in the plane; conductivities
   * must not be empty. */
  template <int dim>
  Eigen::Matrix<double, dim, dim, Eigen::RowMajor> conductivity() const;

  /** Component zz of the thermal stress (Pa/K) in plane strain. */
  double transverse_thermal_stress() const;

  /** The constants with their derivatives, in the order of their keys. */
  template <int dim>
  std::vector<PhaseConstant<dim>> constants() const;

  /** Whether the phase has thermal expansion. */
  bool expands() const
  {
    return std::any_of(expansion.begin(), expansion.end(),
                       [](const double value) { return value != 0.; });
  }

  /** Whether its conductivity is anisotropic. */
  bool conducts_along_axes() const
  {
    return std::any_of(conductivities.begin(), conductivities.end(),
                       [this](const double k) { return k != conductivities[0]; });
  }

  /** alpha . C alpha in space (Pa/K^2), twice the energy of one kelvin without strain. */
  double thermal_energy() const;

  /** Whether a key for an orientation in 3D is given. */
  bool is_turned_in_3d() const
  {
    return !euler_angles.empty() || !axis_1.empty() || !axis_2.empty();
  }

  /** Rotation matrix from the orientation keys; columns are its axes. Throws
   * std::invalid_argument. */
  Eigen::Matrix3d rotation() const;

  /** Moduli and density for the log; check() has passed. */
  template <int dim>
  std::string text() const;

private:
  /** Rotates a stiffness (Pa) from material axes to coordinate axes. */
  template <int dim>
  VoigtMatrix<dim> turned(const VoigtMatrix<dim> &of_material) const;

  /** Expansion of the solid in space (1/K, engineering shear). */
  VoigtVector<3> expansion_in_space() const;

  /** Columns are the axes of the material in space. */
  Eigen::Matrix3d axes() const;

  /** Thermal stress of the solid in space (Pa/K). */
  VoigtVector<3> thermal_stress_in_space() const;

  /** The constants of an orthotropic phase. */
  OrthotropicConstants orthotropic() const;

  /** @throws UserError unless there is one deviation, or one for each constant */
  void check_deviations(const std::size_t n_constants) const;
};

/**
 * Section `Phases`: binds `Names`, a list, and a subsection for each name. The first
 * phase has index 0. Stiffness and density have no default, whatever the name.
 * @p of_volume: the volume is homogenized, which adds the keys for derivatives of the
 * stiffness. Throws UserError for names that are not unique or not allowed.
 */
void bind_phases(Keys &keys, std::vector<PhaseParameters> &phases, const bool of_volume);

/** Binds the key Mean dilatation of the current section. */
void bind_mean_dilatation(Keys &keys, MeanDilatation &choice);

/** Stiffness and density of each phase; check() has passed. */
template <int dim>
std::vector<Phase<dim>> make_phases(const std::vector<PhaseParameters> &parameters);
} // namespace mesoslip

#endif
