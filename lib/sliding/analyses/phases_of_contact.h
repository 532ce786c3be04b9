#ifndef mesoslip_sliding_analyses_phases_of_contact_h
#define mesoslip_sliding_analyses_phases_of_contact_h

#include "io/hdf5_file.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** The phases of a heterogeneous body and what they have of its contact: the group /contact/phases in
 * dynamics.h5 of a transient run. */
struct PhasesOfContact
{
  std::vector<std::string> names;      ///< of the phases, as all lists here have them
  std::vector<double> youngs_modulus;  ///< of the closest isotropic solid (Pa)
  std::vector<double> volume_fraction; ///< share of the body's area (2D) or volume [-]
  std::vector<double> friction; ///< Coulomb's coefficient; empty: one for all phases

  /** Of each phase its share of the tributary area of each contact node, as in /contact/area. */
  std::vector<std::vector<double>> share;
};

/** Writes the group. */
void write_phases_of_contact(Hdf5File &file, const PhasesOfContact &phases);

/** @throws UserError where there is no such group, as of a homogeneous body */
PhasesOfContact read_phases_of_contact(const Hdf5File &file);
} // namespace mesoslip

#endif
