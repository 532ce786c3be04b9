#ifndef mesoslip_exchange_body_description_h
#define mesoslip_exchange_body_description_h

#include "base/serialize_members.h"
#include "grid/uniform_grid.h"
#include "material/phase.h"

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
struct BodyDescription
{
  UniformGrid<2> grid;                ///< number of cells, their size and origin (m)
  std::vector<Phase<2>> phases;       ///< a single one if homogeneous
  std::vector<std::uint8_t> phase_id; ///< of each cell, x fastest; empty if homogeneous
  std::vector<double> node_friction;  ///< Coulomb coefficient of the bottom nodes
  std::string rve_digest;             ///< of the RVE file; empty without one
  std::vector<std::string> warnings;  ///< sentences on the RVE file for the user

  /** Number of the phase of a cell. */
  std::size_t phase_of(const std::size_t cell) const
  {
    return phase_id.empty() ? 0 : phase_id[cell];
  }

  /** Fraction of the first @p n_cells cells that each phase takes. */
  std::vector<double> fractions(const std::size_t n_cells) const
  {
    std::vector<double> result(phases.size(), 0.);
    for (std::size_t cell = 0; cell < n_cells; ++cell)
      result[phase_of(cell)] += 1. / static_cast<double>(n_cells);
    return result;
  }

  /** Saves or restores the body (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<6>(archive, *this);
  }
};
} // namespace mesoslip

#endif
