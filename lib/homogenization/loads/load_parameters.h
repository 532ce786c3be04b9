#ifndef mesoslip_homogenization_loads_load_parameters_h
#define mesoslip_homogenization_loads_load_parameters_h

#include "homogenization/load_cases.h"
#include "morphology/microstructure_parameters.h"

#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** A macroscopic load of section Loads: strain or stress for each Voigt component. */
struct PrescribedLoad
{
  std::string name; ///< name of its subsection

  /** Macroscopic strains (engineering shear) in Voigt order; NaN: the stress is given. */
  std::vector<double> strain;

  /** Macroscopic stresses (Pa) in Voigt order; NaN: not given, then 0 unless the strain
   * is given. */
  std::vector<double> stress;

  double heating = 0.; ///< change of temperature (K)

  /** Components with neither strain nor stress given; their stress is 0. */
  std::vector<std::string> assumed() const;
};

/** Section Loads. */
struct LoadParameters
{
  std::vector<PrescribedLoad> loads; ///< in the order of Names

  /** Conditions whose unit cases are superposed; empty: all solved conditions. */
  std::vector<BoundaryCondition> conditions;

  bool write_fields = true; ///< into loads.h5

  unsigned int n_bins = 50; ///< number of histogram bins, 0: no histograms

  /** Von Mises limit (Pa): one value, or one per phase; empty: no limit. */
  std::vector<double> von_mises_limit;

  /** Limit of the largest principal stress (Pa): one value, or one per phase; empty: no
   * limit. */
  std::vector<double> principal_limit;

  /** Binds the section for a body of dimension @p dim. @throws UserError naming the key */
  void bind(Keys &keys, const unsigned int dim);

  /** @throws UserError naming the key unless the loads suit the @p solved conditions and
   * the phases */
  void check(const std::vector<BoundaryCondition> &solved,
             const std::vector<PhaseParameters> &phases) const;

  /** Whether the unit cases of @p condition are superposed. */
  bool uses(const BoundaryCondition condition) const;
};
} // namespace mesoslip

#endif
