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

/** Where the rules of random inclusions stand in a .prm. */
inline const std::string random_inclusions_section = "Microstructure/Random inclusions";

/** What happens to inclusions at the sides of the box. */
enum class InclusionSides
{
  periodic, ///< what leaves the box on one side comes in on the other
  cut,      ///< centres lie anywhere, also outside, and the rest is cut off
  inside    ///< all of an inclusion lies in the box
};

/** Section `Microstructure/Random inclusions`; lengths in metres. */
struct InclusionPlacement
{
  InclusionShape shape       = InclusionShape::sphere; ///< of all of them
  std::uint64_t seed         = 1;   ///< the same seed gives the same morphology
  double volume_fraction     = 0.2; ///< target, 0 to 1
  FractionRule fraction_rule = FractionRule::actual; ///< what counts for the target

  /** m, uniformly distributed: of spheres and cylinders, edge of bars, of ellipsoids that
   *  along an own axis where Axis ratios is 1. */
  double min_diameter = 0.2e-3;
  double max_diameter = 0.2e-3; ///< m

  /** m, of cylinders and bars, uniformly distributed; 0: through the box. */
  double min_length = 0.;
  double max_length = 0.; ///< m

  unsigned int axis    = 2;              ///< 0, 1, 2 for x, y, z: of cylinders and bars
  Vector3 axis_ratios  = {{1., 1., 1.}}; ///< extents of an ellipsoid over its diameter
  bool turned          = false;          ///< ellipsoids: orientation uniformly at random
  bool allow_overlap   = false;          ///< they may share cells
  double minimum_gap   = 0.;             ///< m, without overlaps, see too_close()
  InclusionSides sides = InclusionSides::periodic; ///< of the box
  std::string phase;                               ///< its name; empty: the second

  /** Binds the keys of the current section. */
  void bind(Keys &keys);

  /** @throws UserError when sizes do not fit each other, the cells or the box. */
  void check(const UniformGrid<3> &grid) const;

  /** Whether they have a length and an axis. */
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
  /** 0: matrix, else the phase of the inclusions; of the planes of cells of this rank. */
  PhaseMap<3> map;

  std::vector<Inclusion> inclusions; ///< in the order of placement
  double actual_fraction  = 0.;      ///< inclusion cells over cells
  double nominal_fraction = 0.;      ///< the same with cells of several counted each time
  bool target_reached     = false;   ///< false when no further one was placed before
  std::size_t vain_draws  = 0;       ///< in a row, after which it was given up

  /** The fraction that the rule counts. */
  double reached_fraction(const FractionRule rule) const
  {
    return rule == FractionRule::actual ? actual_fraction : nominal_fraction;
  }
};

/**
 * Random sequential placement: sizes, orientations and places are drawn, and drawn anew
 * where an inclusion would come too close to another one. A cell belongs to an inclusion
 * when its centre does. Ends when the fraction is reached, by the nearest whole number of
 * inclusions, or after many vain draws in a row. The same seed gives the same morphology.
 * @p rules have passed check(); @p phase is that of the inclusions. Each rank of @p
 * communicator fills its own_planes(). Collective.
 */
InclusionMorphology place_random_inclusions(const UniformGrid<3> &grid,
                                            const InclusionPlacement &rules,
                                            const std::uint8_t phase,
                                            const MPI_Comm communicator = MPI_COMM_SELF);
} // namespace mesoslip

#endif
