#ifndef mesoslip_sliding_supports_shared_sides_h
#define mesoslip_sliding_supports_shared_sides_h

#include "dynamics/mesh_surface.h"
#include "dynamics/shared_nodes.h"
#include "dynamics/supports/side_surface.h"

#include <array>
#include <deque>
#include <vector>

namespace mesoslip
{
/** A side with loads, springs, dashpots or masses. */
struct LoadedSide
{
  SideSupport support;              ///< its load
  SideNodes nodes;                  ///< on a grid one node per row
  std::vector<unsigned int> points; ///< in the whole mesh; empty on grids
  std::vector<bool> counted;        ///< see SideSurface; empty: all
  std::array<bool, 3> moves = {};   ///< for a platen: components in which it moves
};

/** A node of a loaded side that another surface moves. */
struct SideGuest
{
  unsigned int host = 0; ///< 0: the contact, 1: the top, then the sides in their order
  unsigned int i    = 0; ///< index in the surface that moves it
  unsigned int k    = 0; ///< index in the side
};

/** The local part of a loaded side of a mesh. */
struct SharedSide
{
  SharedNodes own;               ///< nodes that the side moves
  LoadedSide here;               ///< own nodes, then its guests
  std::vector<SideGuest> guests; ///< local nodes that another surface moves
};

/** Locally stored nodes of a mesh with contact, loads or supports. The first surface that
 * has a node moves it, in the order contact, top, loaded sides. */
struct SharedSurfaces
{
  /** Surfaces with these points of the whole mesh and these loaded sides. */
  template <int dim>
  SharedSurfaces(const std::vector<unsigned int> &contact_points,
                 const std::vector<unsigned int> &top_points,
                 const std::vector<LoadedSide> &loaded,
                 const MeshPart<dim> &part);

  /** Nodes of surface @p h, a SideGuest::host. */
  const SharedNodes &host(const unsigned int h) const
  {
    return h == 0 ? contact : h == 1 ? top : sides[h - 2].own;
  }

  const SharedNodes contact;     ///< all contact nodes
  const SharedNodes top;         ///< all top nodes
  std::vector<SharedSide> sides; ///< the loaded sides
};
} // namespace mesoslip

#endif
