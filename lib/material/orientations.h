#ifndef mesoslip_material_orientations_h
#define mesoslip_material_orientations_h

#include "material/stiffness.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/** A phase with rotated axes. */
struct OrientedPhase
{
  unsigned int phase                 = 0;  ///< index of the phase
  std::array<double, 3> euler_angles = {}; ///< Bunge's phi1, Phi, phi2 (degrees)

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &phase &euler_angles[0] & euler_angles[1] & euler_angles[2];
  }

  /** The stiffness @p of_phase (Pa) rotated by these angles. */
  VoigtMatrix<3> turned(const VoigtMatrix<3> &of_phase) const
  {
    constexpr std::array<double, 3> as_is = {{0., 0., 0.}};
    if (euler_angles == as_is)
      return of_phase;
    return turn_stiffness(of_phase, rotation());
  }

  /** A stress (Pa), or a tensor like it, of the phase in this orientation. */
  VoigtVector<3> turned(const VoigtVector<3> &of_phase) const
  {
    return turn_stress(of_phase, rotation());
  }

  /** Rotation matrix; columns are the axes of the material. */
  Eigen::Matrix3d rotation() const
  {
    constexpr double degree = 3.14159265358979323846 / 180.;
    return bunge_rotation(degree * euler_angles[0], degree * euler_angles[1],
                          degree * euler_angles[2]);
  }
};

/** Orientations that differ from cell to cell; if empty, the cells are their phases, not
 * rotated. */
struct Orientations
{
  /** Largest number of materials. */
  static constexpr std::size_t most_materials = 65535;

  /** The distinct pairs of phase and orientation; every phase has one at least. */
  std::vector<OrientedPhase> materials;

  std::vector<double> fractions; ///< volume fractions; empty if not requested

  std::vector<std::uint16_t> id; ///< material of each cell, x fastest

  /** Whether there are no orientations. */
  bool empty() const
  {
    return materials.empty();
  }
};

/** The materials as phases, with the names of their phases; without orientations the
 * phases themselves. */
template <int dim>
std::vector<Phase<dim>> oriented_phases(const std::vector<Phase<dim>> &phases,
                                        const std::vector<OrientedPhase> &materials)
{
  std::vector<Phase<dim>> result = phases;
  if constexpr (dim == 3)
    if (!materials.empty())
      {
        result.clear();
        for (const OrientedPhase &material : materials)
          {
            result.push_back(phases.at(material.phase));
            result.back().stiffness = material.turned(phases[material.phase].stiffness);
            result.back().thermal_stress =
              material.turned(phases[material.phase].thermal_stress);
          }
      }
  return result;
}
} // namespace mesoslip

#endif
