#ifndef mesoslip_morphology_phase_parameters_h
#define mesoslip_morphology_phase_parameters_h

#include "material/phase.h"

#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** Section `Phases/<name>`: the material of one phase. */
struct SinglePhaseParameters
{
  /** Which keys give the stiffness. */
  enum class Type
  {
    isotropic,
    orthotropic,
    stiffness
  };

  std::string name;            ///< of the subsection
  Type type = Type::isotropic; ///< key Type

  /** Pa */
  double young_modulus = 0.;
  double poisson_ratio = 0.2; ///< of an isotropic phase

  /** E1, E2, E3 (Pa); nu12, nu13, nu23; G12, G13, G23 (Pa) */
  std::vector<double> young_moduli;
  std::vector<double> poisson_ratios; ///< nu12, nu13, nu23
  std::vector<double> shear_moduli;   ///< G12, G13, G23 (Pa)

  /** Pa; 4 or 6 values */
  std::vector<double> stiffness_coefficients;

  /** rad, counter-clockwise from x to axis 1 */
  double angle = 0.;

  /** kg/m^3 */
  double density = 0.;

  double friction_coefficient = 0.25; ///< Coulomb, of contact nodes in the phase

  /** Binds the keys of the current section, but for the name. */
  void bind(Keys &keys);

  /** Throws UserError naming the key when the material makes no sense. */
  void check() const;

  /** Pa. Throws std::invalid_argument where check() throws. */
  VoigtMatrix<2> stiffness() const;

  /** Moduli and density for the log; check() has passed. */
  std::string text() const;

  /** A sentence about an angle that looks like degrees; empty otherwise. */
  std::string angle_warning() const;

  /** check() has passed. */
  Phase<2> phase() const;
};

/**
 * Section `Phases`: `Names`, a list, and a subsection for each name. The phase that comes
 * first has index 0. No phase has a stiffness or a density that was not given, whatever
 * its name.
 */
struct PhaseParameters
{
  std::vector<SinglePhaseParameters> phases; ///< in the order of `Names`

  /**
   * Binds `Names` and the subsection of each name. Throws UserError for names that are
   * not unique or cannot be names.
   */
  void bind(Keys &keys);

  /** Throws UserError for keys that a phase's `Type` does not use. */
  static void check_keys(const Keys &keys);

  /** Throws UserError: materials must be sound, and there are 1 to 256 of them. */
  void check() const;

  /** Throws UserError unless all densities are positive, as dynamics needs. */
  void check_densities() const;

  /** Index of the phase @p name; throws UserError that blames @p key when there is none.
   */
  unsigned int index_of(const std::string &name, const std::string &key) const;

  /** Stiffness and density of each phase; check() has passed. */
  std::vector<Phase<2>> make_phases() const;
};
} // namespace mesoslip

#endif
