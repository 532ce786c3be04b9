#ifndef mesoslip_dynamics_shared_nodes_h
#define mesoslip_dynamics_shared_nodes_h

#include "mesh/mesh_part.h"

#include <limits>
#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * Nodes of a boundary surface on this rank: locally owned nodes, followed by ghost nodes
 * of other ranks and by periodic copies, each in the order of the surface. Forces on
 * ghost nodes and periodic copies are complete, so that they move like their owners and
 * masters without messages; sums run over owned nodes only. Ghosts begin at a full vector
 * of numbers; there are empty places in between and at the end.
 */
class SharedNodes
{
public:
  /** Placeholder of an empty place. */
  static constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

  /**
   * Nodes of a surface that consists of @p points, periodic masters of the whole mesh.
   */
  template <int dim>
  SharedNodes(const std::vector<unsigned int> &points, const MeshPart<dim> &part);

  /** Number of locally owned nodes, the first ones. */
  unsigned int n_owned() const
  {
    return owned;
  }

  /** Number of places, empty ones included. */
  unsigned int size() const
  {
    return static_cast<unsigned int>(place.size());
  }

  /** Point of the part at place @p i; none for an empty place. */
  unsigned int point(const unsigned int i) const
  {
    return local[i];
  }

  /** Index in the whole surface of the node at place @p i; none for an empty place. */
  unsigned int number(const unsigned int i) const
  {
    return place[i];
  }

  /**
   * Values at the local places of @p whole, which has one value per node of the whole
   * surface; @p otherwise for empty places.
   */
  std::vector<double> of(const std::vector<double> &whole, const double otherwise) const;

  /**
   * Place of node @p of_whole of the whole surface; empty if this rank does not have it.
   */
  std::optional<unsigned int> find(const unsigned int of_whole) const;

  /** Indices of the locally owned nodes in the whole surface. */
  std::vector<unsigned int> owned_places() const
  {
    return {place.begin(), place.begin() + owned};
  }

private:
  unsigned int owned = 0;
  std::vector<unsigned int> place; ///< index in the whole surface
  std::vector<unsigned int> local; ///< point of the part
};
} // namespace mesoslip

#endif
