#ifndef mesoslip_exchange_rve_variation_datasets_h
#define mesoslip_exchange_rve_variation_datasets_h

#include "io/hdf5_file.h"
#include "material/voigt.h"

#include <map>
#include <string>
#include <vector>

namespace mesoslip
{
/** A constant of a phase, and the derivatives of stiffnesses with respect to it. */
template <int dim>
struct VariedConstant
{
  std::size_t phase = 0; ///< index of the phase
  std::string name;      ///< such as E, nu12 or D11
  double value     = 0.; ///< Pa, or a pure number
  double deviation = 0.; ///< standard deviation, in the unit of value; 0: exactly known
  VoigtMatrix<dim> of_phase; ///< derivative of the stiffness of the phase (Pa / unit)

  /** Derivatives of the stiffnesses KUBC, SUBC, PBC, MUBC and effective (Pa / unit). */
  std::map<std::string, VoigtMatrix<dim>> of_volume;
};

/** Writes /variation; nothing if there are no @p constants. */
template <int dim>
void write_variations(Hdf5File &file, const std::vector<VariedConstant<dim>> &constants);

/** Reads /variation, with the derivatives of the stiffness @p name of the volume; empty
 * if the file has none. @throws UserError */
template <int dim>
std::vector<VariedConstant<dim>> read_variations(const Hdf5File &file,
                                                 const std::string &name,
                                                 const std::size_t n_phases);
} // namespace mesoslip

#endif
