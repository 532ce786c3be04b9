#ifndef mesoslip_homogenization_loads_load_parameters_h
#define mesoslip_homogenization_loads_load_parameters_h

#include "homogenization/load_cases.h"
#include "morphology/microstructure_parameters.h"

#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** A load of section Loads: of each Voigt component either the macroscopic strain or the
 * macroscopic stress. */
struct PrescribedLoad
{
  std::string name; ///< of its subsection

  /** Macroscopic strains (engineering shear) in Voigt order; NaN: the stress is given. */
  std::vector<double> strain;

  /** Macroscopic stresses (Pa) in Voigt order; NaN: not typed, and 0 unless the strain is
   * given. */
  std::vector<double> stress;

  double heating = 0.; ///< change of temperature (K)

  /** Names of the components with neither, whose stress is taken as 0. */
  std::vector<std::string> assumed() const;
};

/** Section Loads. */
struct LoadParameters
{
  std::vector<PrescribedLoad> loads; ///< in the order of Names

  /** Whose unit cases are superposed; empty: those of all that are solved. */
  std::vector<BoundaryCondition> conditions;

  bool write_fields = true; ///< into loads.h5

  unsigned int n_bins = 50; ///< of the histograms, 0: none

  /** Pa, one for all phases or one a phase, empty: none. */
  std::vector<double> von_mises_limit;

  /** Of the largest principal stress (Pa), likewise. */
  std::vector<double> principal_limit;

  /** Binds the section for a body of dimension @p dim. @throws UserError naming the key */
  void bind(Keys &keys, const unsigned int dim);

  /** @throws UserError naming the key unless this suits the conditions that are @p solved
   * and the phases */
  void check(const std::vector<BoundaryCondition> &solved,
             const std::vector<PhaseParameters> &phases) const;

  /** Whether the unit cases of @p condition are superposed. */
  bool uses(const BoundaryCondition condition) const;
};
} // namespace mesoslip

#endif
