#ifndef mesoslip_sliding_scene_h
#define mesoslip_sliding_scene_h

#include "base/serialize_members.h"
#include "elasticity/uniform_material.h"
#include "grid/uniform_grid.h"
#include "material/phase.h"
#include "sliding/contact_parameters.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/** Saves or restores a phase (Boost.Serialization). */
template <class Archive>
void serialize(Archive &archive, Phase<2> &phase, const unsigned int)
{
  serialize_members<4>(archive, phase);
}

/** The body that slides: geometry, materials and friction coefficients. */
struct Scene
{
  UniformGrid<2> grid; ///< of the body

  /** One phase for each material class; a single one if homogeneous. */
  std::vector<Phase<2>> phases;

  /** Class of each cell, x fastest; empty if homogeneous. */
  std::vector<std::uint8_t> phase_id;

  /** Coulomb coefficient of the bottom nodes. */
  std::vector<double> node_friction;

  /** Digest of the RVE file; empty without one. */
  std::string rve_digest;

  /** Sentences on the RVE file for the user. */
  std::vector<std::string> warnings;

  /** The grid with its material classes. */
  UniformMaterial make_material(const bool periodic) const;

  /** Saves or restores the body (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<6>(archive, *this);
  }

  /** Share of the bottom's length that lies in each phase. */
  std::vector<double> surface_fractions() const;
};

/**
 * Builds the body from parameters and RVE file, if there is the memory for its fields.
 * @throws UserError naming key or file
 */
Scene make_scene(const ContactParameters &parameters);

/**
 * Coefficient of each of the cells+1 bottom nodes from those of the two cells beside it.
 * @p rule: stiffness (mean weighted with @p stiffness_of_bottom_cells, D22, as the
 * pressure is shared when both cells are compressed alike, eq. 18), mean, largest or
 * smallest.
 */
std::vector<double>
friction_of_nodes(const std::vector<double> &friction_of_bottom_cells,
                  const std::vector<double> &stiffness_of_bottom_cells,
                  const std::string &rule,
                  const bool periodic);
} // namespace mesoslip

#endif
