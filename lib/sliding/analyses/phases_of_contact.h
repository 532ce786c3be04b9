#ifndef mesoslip_sliding_analyses_phases_of_contact_h
#define mesoslip_sliding_analyses_phases_of_contact_h

#include "io/hdf5_file.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Phases of a heterogeneous body and their shares of its contact: the group
 * /contact/phases in dynamics.h5 of a transient run. */
struct PhasesOfContact
{
  std::vector<std::string> names;      ///< phase names; all lists here have this order
  std::vector<double> youngs_modulus;  ///< modulus of the closest isotropic solid (Pa)
  std::vector<double> volume_fraction; ///< share of the body's area (2D) or volume [-]
  std::vector<double> friction; ///< Coulomb's coefficient; empty: one for all phases

  /** For each phase its share [0, 1] of the tributary area of each contact node, in the
   * order of /contact/area. */
  std::vector<std::vector<double>> share;
};

/** Writes the group. */
void write_phases_of_contact(Hdf5File &file, const PhasesOfContact &phases);

/** @throws UserError if the group is missing, as for a homogeneous body */
PhasesOfContact read_phases_of_contact(const Hdf5File &file);
} // namespace mesoslip

#endif
