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
  unsigned int number            = 0;  ///< index among the contact nodes
  std::array<double, 3> position = {}; ///< m
  unsigned int phase             = 0;  ///< phase of a probe at this place
  double area                    = 0.; ///< tributary (m^2, in 2D m)
};

/** Expected vibration period while a run shows no vibration, in crossings of the body's
 * height by a pressure wave. From the shear vibration of the paper's pin, 41 kHz. */
constexpr double crossings_of_a_period = 8.;

/** Reference scales of a body for loads, times and lengths. */
struct BodyScales
{
  /** All members are zero. */
  BodyScales() = default;

  /** Scales of a grid and its materials; the highest frequency is the frequency of a
   * single cell. */
  explicit BodyScales(const UniformMaterial &material);

  unsigned int dim             = 2;  ///< dimension of the body
  double stiffness             = 0.; ///< D22, in 3D D33, of the stiffest phase (Pa)
  double wave_speed            = 0.; ///< fastest pressure wave along the normal (m/s)
  double height                = 0.; ///< along the normal of the flat (m)
  std::array<double, 2> extent = {}; ///< along x and, in 3D, y (m)
  double area                  = 0.; ///< area of the top (m^2, in 2D m)
  double mass                  = 0.; ///< kg, in 2D kg/m
  double density               = 0.; ///< mean (kg/m^3)
  double shear_impedance   = 0.; ///< least of all phases, see shear_impedance() (Pa s/m)
  double highest_frequency = 0.; ///< circular, of the body or an upper bound (1/s)

  /** Unit of the masses of the body, its platens and supports. */
  const char *mass_unit() const
  {
    return dim == 2 ? "kg/m" : "kg";
  }

  /** Travel time of a pressure wave from the flat to the top (s). */
  double crossing() const
  {
    return height / wave_speed;
  }
};

/** Size of a body, on a grid or a mesh, for statistics and results. */
struct BodySize
{
  unsigned int dim = 2;  ///< dimension of the body
  double top_area  = 0.; ///< area of the top along the normal of the flat (m^2, in 2D m)
  std::vector<double> side_area; ///< per loaded_sides() (m^2, in 2D m)

  /** Force of a pressure of 1 Pa on each loaded side (m^2, in 2D m). */
  std::vector<std::array<double, 3>> side_push;

  /** Components in which the platen of each loaded side moves. */
  std::vector<std::array<bool, 3>> side_moves;
  double mass           = 0.;   ///< kg, in 2D kg/m
  std::uint64_t n_cells = 0;    ///< cells of the whole body
  std::vector<double> friction; ///< coefficient of each contact node
  std::vector<double> area;     ///< tributary of each contact node (m^2, in 2D m)
  double crossing = 0.;         ///< BodyScales::crossing() (s)
  std::size_t n_contact_nodes =
    0;                     ///< on a periodic grid without the last, a copy of the first
  ReferenceNode reference; ///< reference node M

  /** Unit of forces, energies and powers: "J" or, per unit thickness, "J/m". */
  std::string unit(const std::string &of_whole_body) const
  {
    return of_whole_body + (dim == 2 ? "/m" : "");
  }
};

} // namespace mesoslip

#endif
