#ifndef mesoslip_statics_multigrid_constrained_unknowns_h
#define mesoslip_statics_multigrid_constrained_unknowns_h

#include "elasticity/dof_mask.h"
#include "statics/multigrid/interpolation.h"

#include <cstdint>
#include <vector>

namespace mesoslip::multigrid
{
/**
 * The unknowns of one grid that stay zero, by node rows. On coarse grids a node is
 * constrained like the fine node at its place; its rotation if both displacements are.
 */
class ConstrainedUnknowns
{
public:
  /** Constrained components of one node of a row. */
  struct Node
  {
    unsigned int column; ///< of the node
    std::uint8_t bits;   ///< bit c: component c (0, 1: displacement, 2: rotation)

    /** Whether component @p c is constrained. */
    bool has(const unsigned int c) const
    {
      return (bits >> c & 1U) != 0;
    }
  };

  ConstrainedUnknowns() = default;

  /** Of the finest grid; duplicate columns and rows of periodic sides are left out. */
  ConstrainedUnknowns(const DofMask &mask, const Axis &x, const Axis &y);

  /** Of the next coarser grid. */
  ConstrainedUnknowns(const ConstrainedUnknowns &fine,
                      const Interpolation &interpolation);

  /** Those of row @p j in ascending columns. */
  const std::vector<Node> &row(const unsigned int j) const
  {
    return rows[j];
  }

  /** Sets the constrained unknowns of a field to zero. */
  template <typename Field>
  void clear(Field &field, const unsigned int n_components) const
  {
    for (unsigned int j = 0; j < rows.size(); ++j)
      for (const Node &node : rows[j])
        for (unsigned int c = 0; c < n_components; ++c)
          if (node.has(c))
            field.row(c, j)[node.column] = 0;
  }

private:
  std::vector<std::vector<Node>> rows;
};
} // namespace mesoslip::multigrid

#endif
