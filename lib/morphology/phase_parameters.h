#ifndef mesoslip_morphology_phase_parameters_h
#define mesoslip_morphology_phase_parameters_h

#include "material/phase.h"

#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** Section `Phases/<name>`: the material of one phase. */
struct PhaseParameters
{
  /** Which keys give the stiffness. */
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
  std::vector<double> coefficients;   ///< Pa; 4 or 6, see stiffness_from_coefficients()

  double angle                = 0.;   ///< rad, counter-clockwise from x to axis 1
  double density              = 0.;   ///< kg/m^3; 0: not given
  double friction_coefficient = 0.25; ///< Coulomb, of contact nodes in the phase

  /** Throws UserError naming the key when the material makes no sense. */
  void check() const;

  /** Pa. Throws std::invalid_argument where check() throws. */
  VoigtMatrix<2> stiffness() const;

  /** Moduli and density for the log; check() has passed. */
  std::string text() const;
};

/**
 * Section `Phases`: binds `Names`, a list, and a subsection for each name. The phase that
 * comes first has index 0. No phase has a stiffness or a density that was not given,
 * whatever its name. Throws UserError for names that are not unique or cannot be names.
 */
void bind_phases(Keys &keys, std::vector<PhaseParameters> &phases);

/** Stiffness and density of each phase; check() has passed. */
std::vector<Phase<2>> make_phases(const std::vector<PhaseParameters> &parameters);
} // namespace mesoslip

#endif
