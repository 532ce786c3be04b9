#ifndef mesoslip_statics_multigrid_held_unknowns_h
#define mesoslip_statics_multigrid_held_unknowns_h

#include "elasticity/dof_mask.h"
#include "statics/multigrid/interpolation.h"

#include <cstdint>
#include <vector>

namespace mesoslip
{
namespace multigrid
{
/**
 * The unknowns of one grid that stay zero, by node rows. On coarse grids a node holds
 * what the fine node at its place holds; its rotation if both displacements are held.
 */
class HeldUnknowns
{
public:
  /** Held components of one node of a row. */
  struct Node
  {
    unsigned int column; ///< of the node
    /** Bit c: component c (0, 1: displacement, 2: rotation). */
    std::uint8_t bits;

    /** Whether component @p c is held. */
    bool holds(const unsigned int c) const
    {
      return (bits >> c & 1U) != 0;
    }
  };

  HeldUnknowns() = default;

  /** Of the finest grid; duplicate columns and rows of periodic sides are left out. */
  HeldUnknowns(const DofMask &mask, const Axis &x, const Axis &y);

  /** Of the next coarser grid. */
  HeldUnknowns(const HeldUnknowns &fine, const Interpolation &interpolation);

  /** Ascending columns. */
  const std::vector<Node> &row(const unsigned int j) const
  {
    return rows[j];
  }

  /** Whether nothing is held. */
  bool empty() const
  {
    return n_nodes == 0;
  }

  /** Sets the held unknowns of a field to zero. */
  template <typename Field>
  void clear(Field &field, const unsigned int n_components) const
  {
    if (empty())
      return;
    for (unsigned int j = 0; j < rows.size(); ++j)
      for (const Node &node : rows[j])
        for (unsigned int c = 0; c < n_components; ++c)
          if (node.holds(c))
            field.row(c, static_cast<int>(j))[node.column] = 0;
  }

private:
  std::vector<std::vector<Node>> rows;
  std::size_t n_nodes = 0;
};
} // namespace multigrid
} // namespace mesoslip

#endif
