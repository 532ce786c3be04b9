#ifndef mesoslip_morphology_random_inclusions_h
#define mesoslip_morphology_random_inclusions_h

#include "grid/cell_planes.h"
#include "morphology/inclusion.h"
#include "morphology/random_fibres.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** Section of random inclusions in a .prm. */
inline const std::string random_inclusions_section = "Microstructure/Random inclusions";

/** Treatment of inclusions at the sides of the box. */
enum class InclusionSides
{
  periodic, ///< periodic continuation
  cut,      ///< centres lie inside or outside, parts outside are cut off
  inside    ///< inclusions lie inside the box
};

/** Section `Microstructure/Random inclusions`; lengths in metres. */
struct InclusionPlacement
{
  InclusionShape shape       = InclusionShape::sphere; ///< the same for all
  std::uint64_t seed         = 1;   ///< the same seed gives the same morphology
  double volume_fraction     = 0.2; ///< target, 0 to 1
  FractionRule fraction_rule = FractionRule::actual; ///< definition of the fraction

  /** m, uniformly distributed: diameter of spheres and cylinders, edge of bars, diameter
   * of ellipsoids along an axis with Axis ratios = 1. */
  double min_diameter = 0.2e-3;
  double max_diameter = 0.2e-3; ///< m

  /** Length of cylinders and bars (m), uniformly distributed; 0: through the box. */
  double min_length = 0.;
  double max_length = 0.; ///< m

  unsigned int axis    = 2;              ///< 0, 1, 2 for x, y, z: of cylinders and bars
  Vector3 axis_ratios  = {{1., 1., 1.}}; ///< extents of an ellipsoid over its diameter
  bool turned          = false;          ///< ellipsoids: uniformly random orientation
  bool allow_overlap   = false;          ///< inclusions may share cells
  double minimum_gap   = 0.;             ///< m, without overlaps, see too_close()
  InclusionSides sides = InclusionSides::periodic; ///< at the sides of the box
  std::string phase;                               ///< its name; empty: the second

  /** Binds the keys of the current section. */
  void bind(Keys &keys);

  /** @throws UserError if sizes do not fit each other, the cells or the box. */
  void check(const UniformGrid<3> &grid) const;

  /** Whether the shape has a length and an axis. */
  bool has_length() const
  {
    return shape == InclusionShape::cylinder || shape == InclusionShape::bar;
  }

  /** "spheres", "ellipsoids", ... */
  std::string name_of_shape() const;
};

/** Morphology made by place_random_inclusions(). */
struct InclusionMorphology
{
  /** 0: matrix, else the phase of the inclusions; for this rank's planes of cells. */
  PhaseMap<3> map;

  std::vector<Inclusion> inclusions; ///< in the order of placement
  double actual_fraction  = 0.;      ///< inclusion cells over cells
  double nominal_fraction = 0.;      ///< likewise, overlaps counted repeatedly
  bool target_reached     = false;   ///< false if no further inclusion could be placed
  std::size_t vain_draws  = 0;       ///< failed draws in a row at the end

  /** The fraction by the definition @p rule. */
  double reached_fraction(const FractionRule rule) const
  {
    return rule == FractionRule::actual ? actual_fraction : nominal_fraction;
  }
};

/**
 * Random sequential placement: sizes, orientations and places are drawn, and drawn again
 * if an inclusion would be too close to another one. A cell belongs to an inclusion if
 * its centre does. Ends when the fraction is reached, by the nearest whole number of
 * inclusions, or after many failed draws in a row. Equal seeds give equal morphologies.
 * @p rules have passed check(); @p phase is the phase of the inclusions. Each rank of
 * @p communicator fills its own_planes(). Collective.
 */
InclusionMorphology place_random_inclusions(const UniformGrid<3> &grid,
                                            const InclusionPlacement &rules,
                                            const std::uint8_t phase,
                                            const MPI_Comm communicator = MPI_COMM_SELF);
} // namespace mesoslip

#endif
