#ifndef mesoslip_sliding_supports_mesh_side_h
#define mesoslip_sliding_supports_mesh_side_h

#include "dynamics/supports/side_nodes.h"
#include "dynamics/supports/side_support.h"
#include "mesh/boundary.h"

#include <array>
#include <set>
#include <vector>

namespace mesoslip
{
template <int dim>
class BodyMesh;

/** Points of a mesh on a loaded side; for a platen the points that it moves. */
struct MeshSide
{
  std::vector<unsigned int> points; ///< in the whole mesh, periodic masters only
  SideNodes nodes;                  ///< area, push and impedance of the points
  std::array<bool, 3> moves = {};   ///< for a platen: components in which it moves

  /** Keeps only points that the platen of @p support moves (not the @p others) and gives
   * them the area of all points.
   * @throws UserError if none is left */
  void keep_for_platen(const std::set<unsigned int> &others, const SideSupport &support);

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/**
 * The side of these @p faces. With @p absorbing, the impedance of a point is the mean
 * over the faces around it, each with its normal and the phase behind it.
 */
template <int dim>
MeshSide mesh_side(const BodyMesh<dim> &morphology,
                   const std::vector<BoundaryFace<dim>> &faces,
                   const bool absorbing);
} // namespace mesoslip

#endif
