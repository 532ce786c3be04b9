#ifndef mesoslip_elasticity_dof_mask_h
#define mesoslip_elasticity_dof_mask_h

#include "grid/nodal_field.h"

#include <cstdint>
#include <vector>

namespace mesoslip
{
/**
 * Which displacement components of which nodes of a uniform grid are held, that is have
 * prescribed values. On a periodic grid the last column (row) is the first one again;
 * holding one of the two holds both.
 */
class DofMask
{
public:
  DofMask() = default;

  /** Nothing is held. */
  DofMask(const unsigned int n_columns, const unsigned int n_rows)
    : columns(n_columns)
    , rows(n_rows)
    , bits(static_cast<std::size_t>(n_columns) * n_rows, 0)
  {
  }

  /** Both components of all nodes on the four sides. */
  static DofMask boundary(const unsigned int n_columns, const unsigned int n_rows);

  /** Of nodes. */
  unsigned int n_columns() const
  {
    return columns;
  }

  /** Of nodes. */
  unsigned int n_rows() const
  {
    return rows;
  }

  /** Component @p c (0: x, 1: y) of the node in column @p i, row @p j. */
  void hold(const unsigned int c, const unsigned int i, const unsigned int j)
  {
    bits[index(i, j)] |= static_cast<std::uint8_t>(1U << c);
  }

  /** Component @p c of @p node. */
  void hold(const unsigned int c, const NodeIndex &node)
  {
    hold(c, node.i, node.j);
  }

  /** Whether component @p c of @p node is held. */
  bool is_held(const unsigned int c, const NodeIndex &node) const
  {
    return is_held(c, node.i, node.j);
  }

  /** Component @p c of node (@p i, @p j) may move again. */
  void release(const unsigned int c, const unsigned int i, const unsigned int j)
  {
    bits[index(i, j)] &= static_cast<std::uint8_t>(~(1U << c));
  }

  /** Whether component @p c of node (@p i, @p j) is held. */
  bool is_held(const unsigned int c, const unsigned int i, const unsigned int j) const
  {
    return (bits[index(i, j)] >> c & 1U) != 0;
  }

  /** Bit c is set if component c is held. */
  std::uint8_t held(const unsigned int i, const unsigned int j) const
  {
    return bits[index(i, j)];
  }

  /** A component of all nodes of a row. */
  void hold_row(const unsigned int c, const unsigned int j);

  /** A component of all nodes of a column. */
  void hold_column(const unsigned int c, const unsigned int i);

  /** Whether the same is held on grids of the same size. */
  bool operator==(const DofMask &other) const
  {
    return columns == other.columns && rows == other.rows && bits == other.bits;
  }

private:
  std::size_t index(const unsigned int i, const unsigned int j) const
  {
    return static_cast<std::size_t>(j) * columns + i;
  }

  unsigned int columns = 0;
  unsigned int rows    = 0;
  std::vector<std::uint8_t> bits;
};
} // namespace mesoslip

#endif
