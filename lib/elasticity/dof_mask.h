#ifndef mesoslip_elasticity_dof_mask_h
#define mesoslip_elasticity_dof_mask_h

#include "grid/nodal_field.h"

#include <cassert>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/**
 * Constrained displacement components of nodes (Dirichlet conditions). On a periodic grid
 * the last column (row) is the periodic copy of the first; constraining one of the two
 * constrains both.
 */
class DofMask
{
public:
  DofMask() = default;

  /** A mask without constraints. */
  DofMask(const unsigned int n_columns, const unsigned int n_rows)
    : columns(n_columns)
    , all_bits(static_cast<std::size_t>(n_columns) * n_rows, 0)
  {
  }

  /** Number of nodes in a row. */
  unsigned int n_columns() const
  {
    return columns;
  }

  /** Number of node rows. */
  unsigned int n_rows() const
  {
    return columns > 0 ? all_bits.size() / columns : 0;
  }

  /** Constrains component @p c (0: x, 1: y) of @p node. */
  void constrain(const unsigned int c, const NodeIndex &node)
  {
    all_bits[index(node)] |= static_cast<std::uint8_t>(1U << c);
  }

  /** Releases component @p c of @p node. */
  void release(const unsigned int c, const NodeIndex &node)
  {
    all_bits[index(node)] &= static_cast<std::uint8_t>(~(1U << c));
  }

  /** Whether component @p c of @p node is constrained. */
  bool is_constrained(const unsigned int c, const NodeIndex &node) const
  {
    return (bits(node) >> c & 1U) != 0;
  }

  /** Bit c is set if component c of @p node is constrained. */
  std::uint8_t bits(const NodeIndex &node) const
  {
    return all_bits[index(node)];
  }

  /** Constrains component @p c of all nodes of row @p j. */
  void constrain_row(const unsigned int c, const unsigned int j)
  {
    for (unsigned int i = 0; i < columns; ++i)
      constrain(c, {i, j});
  }

  /** Constrains component @p c of all nodes of column @p i. */
  void constrain_column(const unsigned int c, const unsigned int i)
  {
    for (unsigned int j = 0; j < n_rows(); ++j)
      constrain(c, {i, j});
  }

  /** Whether grid size and constraints are equal. */
  bool operator==(const DofMask &other) const
  {
    return columns == other.columns && all_bits == other.all_bits;
  }

private:
  std::size_t index(const NodeIndex &node) const
  {
    assert(node.i < columns);
    assert(node.j < n_rows());
    return static_cast<std::size_t>(node.j) * columns + node.i;
  }

  unsigned int columns = 0;
  std::vector<std::uint8_t> all_bits;
};
} // namespace mesoslip

#endif
