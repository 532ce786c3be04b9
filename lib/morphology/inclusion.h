#ifndef mesoslip_morphology_inclusion_h
#define mesoslip_morphology_inclusion_h

#include <array>

namespace mesoslip
{
/** A place or a direction in space; components along x, y, z. */
using Vector3 = std::array<double, 3>;

/** What an inclusion looks like. */
enum class InclusionShape
{
  sphere,
  ellipsoid,
  cylinder, ///< round, along an axis of space
  bar       ///< of square cross section, along an axis of space
};

/** A body of one phase in a box of another; symmetric about its centre. */
struct Inclusion
{
  InclusionShape shape = InclusionShape::sphere; ///< of which kind
  Vector3 centre       = {};                     ///< m

  /** Half its extents (m) along its own axes: of a sphere three times the radius. */
  Vector3 half = {};

  /** Row k is the own axis k, a unit vector; only an ellipsoid may be turned. */
  std::array<Vector3, 3> axes = {{{{1., 0., 0.}}, {{0., 1., 0.}}, {{0., 0., 1.}}}};

  /** Axis of space (0, 1, 2) of a cylinder or bar. */
  unsigned int along = 0;

  /** Whether it goes from one side of the box to the other along that axis, whose
   *  component of the centre then counts nothing. */
  bool through = false;

  /** Half its extents (m) along the axes of space. */
  Vector3 reach() const;

  /** Whether the point with the distances @p d (m) from the centre belongs to it; of two
   *  bars with a common face one has the points of the face. */
  bool contains(const Vector3 &d) const;

  /** m^3 */
  double volume() const;
};

/**
 * Whether the distance of @p a and @p b is less than @p gap (m), where the centre of b is
 * @p d (m) from that of a; both are of the same shape and along the same axis. The gap is
 * that along an axis of space (bars, ends of cylinders) or the shortest one (spheres, sides
 * of cylinders); of ellipsoids it is not looked at. Two ellipsoids overlap unless a scaling
 * about their centres separates them (Perram and Wertheim 1985, J. Comput. Phys. 58).
 */
bool too_close(const Inclusion &a,
               const Inclusion &b,
               const Vector3 &d,
               const double gap);
} // namespace mesoslip

#endif
