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
/** A side that feels anything besides the forces of the body. */
struct LoadedSide
{
  SideSupport support;              ///< its load
  SideNodes nodes;                  ///< of a grid one for each row
  std::vector<unsigned int> points; ///< of the whole mesh; empty on grids
  std::vector<bool> counted;        ///< see SideSurface; empty: all
  std::array<bool, 3> moves = {};   ///< of a platen the components in which it moves
};

/** A node of a loaded side that another surface moves. */
struct SideGuest
{
  unsigned int host = 0; ///< 0: the contact, 1: the top, then the sides in their order
  unsigned int i    = 0; ///< its place in the surface that moves it
  unsigned int k    = 0; ///< its number in the side
};

/** A loaded side of a mesh as one rank has it. */
struct SharedSide
{
  SharedNodes own;               ///< those that it moves
  LoadedSide here;               ///< these, and its guests behind them
  std::vector<SideGuest> guests; ///< nodes of the rank that others move
};

/** Nodes of a mesh on one rank that anything besides the body acts on. Of contact, top and loaded sides in their
 * order the first to have a node moves it. */
struct SharedSurfaces
{
  /** For these points of the whole mesh and these loaded sides. */
  template <int dim>
  SharedSurfaces(const std::vector<unsigned int> &contact_points,
                 const std::vector<unsigned int> &top_points,
                 const std::vector<LoadedSide> &loaded,
                 const MeshPart<dim> &part);

  /** The nodes of host @p h of a guest. */
  const SharedNodes &host(const unsigned int h) const
  {
    return h == 0 ? contact : h == 1 ? top : sides[h - 2].own;
  }

  const SharedNodes contact;     ///< all of it
  const SharedNodes top;         ///< all of it
  std::vector<SharedSide> sides; ///< that are loaded
};
} // namespace mesoslip

#endif
