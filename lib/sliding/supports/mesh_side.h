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

/** The points of a mesh that a side loads, of a platen those that it moves. */
struct MeshSide
{
  std::vector<unsigned int> points; ///< of the whole mesh, originals
  SideNodes nodes;                  ///< what they stand for
  std::array<bool, 3> moves = {};   ///< of a platen the components in which it moves

  /** Leaves those that the platen of @p support moves, and gives them the area of all: not the @p others.
   * @throws UserError if there are none */
  void keep_for_platen(const std::set<unsigned int> &others, const SideSupport &support);

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/**
 * The side of these @p faces. With @p absorbing the impedance of a point is the mean over the faces around
 * it, each with its normal and the phase behind it.
 */
template <int dim>
MeshSide mesh_side(const BodyMesh<dim> &morphology,
                   const std::vector<BoundaryFace<dim>> &faces,
                   const bool absorbing);
} // namespace mesoslip

#endif
