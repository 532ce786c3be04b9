#ifndef mesoslip_sliding_body_size_h
#define mesoslip_sliding_body_size_h

#include "elasticity/uniform_material.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/** The reference node, whose motion gives spectrum and regime. */
struct ReferenceNode
{
  unsigned int number            = 0;  ///< among the contact nodes
  std::array<double, 3> position = {}; ///< m
  unsigned int phase             = 0;  ///< of a probe there
  double area                    = 0.; ///< tributary (m^2, in 2D m)
};

/** How often a pressure wave crosses the height of the body in the period that is expected
 * while a run shows no vibration: that of the shear of the paper's pin, at 41 kHz. */
constexpr double crossings_of_a_period = 8.;

/** What loads, times and lengths of a body are compared with. */
struct BodyScales
{
  /** Of nothing. */
  BodyScales() = default;

  /** Of a grid and its materials; frequency of a single cell. */
  explicit BodyScales(const UniformMaterial &material);

  unsigned int dim  = 2;  ///< of the body
  double stiffness  = 0.; ///< D22, in 3D D33, of the stiffest phase (Pa)
  double wave_speed = 0.; ///< largest, of pressure waves along the normal (m/s)
  double height     = 0.; ///< along the normal of the flat (m)
  std::array<double, 2> extent = {}; ///< along x and, in 3D, y (m)
  double area                  = 0.; ///< of the top (m^2, in 2D m)
  double mass                  = 0.; ///< kg, in 2D kg/m
  double density               = 0.; ///< mean (kg/m^3)
  double shear_impedance   = 0.; ///< least of the phases, see shear_impedance() (Pa s/m)
  double highest_frequency = 0.; ///< circular, of the body or a bound of it (1/s)

  /** Unit of the masses of the body and of what moves with it. */
  const char *mass_unit() const
  {
    return dim == 2 ? "kg/m" : "kg";
  }

  /** Time in which a pressure wave goes from the flat to the top (s). */
  double crossing() const
  {
    return height / wave_speed;
  }
};

/** What statistics and results need to know of a body, on a grid or a mesh. */
struct BodySize
{
  unsigned int dim = 2;  ///< of the body
  double top_area  = 0.; ///< of the top, along the normal of the flat (m^2, in 2D m)
  std::vector<double> side_area; ///< of ContactParameters::loaded_sides() (m^2, in 2D m)

  /** Force of a pressure of 1 Pa on each of them (m^2, in 2D m). */
  std::vector<std::array<double, 3>> side_push;

  /** The components in which platens move them. */
  std::vector<std::array<bool, 3>> side_moves;
  double mass           = 0.;   ///< kg, in 2D kg/m
  std::uint64_t n_cells = 0;    ///< of the whole body
  std::vector<double> friction; ///< coefficient of each contact node
  std::vector<double> area;     ///< tributary of each contact node (m^2, in 2D m)
  double crossing = 0.;         ///< BodyScales::crossing() (s)
  std::size_t n_contact_nodes =
    0;                     ///< with periodic sides the last one is the first again
  ReferenceNode reference; ///< M

  /** Of forces, energies and powers: "J" or, per unit thickness, "J/m". */
  std::string unit(const std::string &of_whole_body) const
  {
    return of_whole_body + (dim == 2 ? "/m" : "");
  }
};

} // namespace mesoslip

#endif
