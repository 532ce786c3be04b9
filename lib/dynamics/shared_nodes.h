#ifndef mesoslip_dynamics_shared_nodes_h
#define mesoslip_dynamics_shared_nodes_h

#include "mesh/mesh_part.h"

#include <limits>
#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * The nodes of a boundary surface that are on this rank: those that it owns and, behind
 * them, copies of those of other ranks and of its own across periodic sides, both in the order of the surface. The forces on a
 * copy are complete, so that it moves as its original does without a message; what is
 * summed over the nodes is summed over those that are owned. Copies begin at a whole vector
 * of numbers: in between and at the end are places without a node.
 */
class SharedNodes
{
public:
  /** No node: what stands for one where arrays are filled up to whole vectors. */
  static constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

  /** Those of @p points, originals of the whole mesh, which the surface is made of. */
  template <int dim>
  SharedNodes(const std::vector<unsigned int> &points, const MeshPart<dim> &part);

  /** Number of nodes that this rank owns: the first ones. */
  unsigned int n_owned() const
  {
    return owned;
  }

  /** Number of places, of nodes and of none. */
  unsigned int size() const
  {
    return static_cast<unsigned int>(place.size());
  }

  /** The point of the part; none where there is no node. */
  unsigned int point(const unsigned int i) const
  {
    return local[i];
  }

  /** Its number in the whole surface; none where there is no node. */
  unsigned int number(const unsigned int i) const
  {
    return place[i];
  }

  /** What @p whole, one value a node of the whole surface, is of these; @p otherwise where
   * there is no node. */
  std::vector<double> of(const std::vector<double> &whole, const double otherwise) const;

  /** Where the node of the whole surface is in the arrays; nothing if it is on other ranks
   * alone. */
  std::optional<unsigned int> find(const unsigned int of_whole) const;

  /** Numbers in the whole surface of the nodes that this rank owns. */
  std::vector<unsigned int> owned_places() const
  {
    return {place.begin(), place.begin() + owned};
  }

private:
  unsigned int owned = 0;
  std::vector<unsigned int> place; ///< in the whole surface
  std::vector<unsigned int> local; ///< points of the part
};
} // namespace mesoslip

#endif
