#ifndef mesoslip_morphology_inclusion_h
#define mesoslip_morphology_inclusion_h

#include <array>

namespace mesoslip
{
/** A point or a direction in space; components along x, y, z. */
using Vector3 = std::array<double, 3>;

/** Shape of an inclusion. */
enum class InclusionShape
{
  sphere,
  ellipsoid,
  cylinder, ///< circular, along a coordinate axis
  bar       ///< square cross section, along a coordinate axis
};

/** An inclusion of one phase in a box of another; symmetric about its centre. */
struct Inclusion
{
  InclusionShape shape = InclusionShape::sphere; ///< shape
  Vector3 centre       = {};                     ///< m

  /** Semi-axes (m) along its own axes; for a sphere three times the radius. */
  Vector3 half = {};

  /** Row k is its axis k, a unit vector; only ellipsoids may be rotated. */
  std::array<Vector3, 3> axes = {{{{1., 0., 0.}}, {{0., 1., 0.}}, {{0., 0., 1.}}}};

  /** Coordinate axis (0, 1, 2) of a cylinder or bar. */
  unsigned int along = 0;

  /** Whether it extends through the whole box along that axis; the component of the
   * centre along it is then ignored. */
  bool through = false;

  /** Half the extents (m) of its bounding box along the coordinate axes. */
  Vector3 reach() const;

  /** Whether the point at @p d (m) from the centre belongs to it; points of a face shared
   * by two bars belong to one of them. */
  bool contains(const Vector3 &d) const;

  /** Volume (m^3). */
  double volume() const;
};

/**
 * Whether the distance of @p a and @p b is less than @p gap (m); @p d (m) is the vector
 * from the centre of a to the centre of b. Both have the same shape and axis. The
 * distance is measured along a coordinate axis (bars, ends of cylinders) or is the
 * shortest one (spheres, sides of cylinders); for ellipsoids the gap is ignored. Two
 * ellipsoids overlap unless a scaling about their centres separates them (Perram and
 * Wertheim 1985, J. Comput. Phys. 58).
 */
bool too_close(const Inclusion &a,
               const Inclusion &b,
               const Vector3 &d,
               const double gap);
} // namespace mesoslip

#endif
