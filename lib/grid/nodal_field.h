#ifndef mesoslip_grid_nodal_field_h
#define mesoslip_grid_nodal_field_h

#include "grid/line_memory.h"

#include <boost/serialization/array_wrapper.hpp>

#include <cstddef>
#include <stdexcept>

namespace mesoslip
{
/** The place of a node in a field. */
struct NodeIndex
{
  unsigned int i = 0; ///< column
  unsigned int j = 0; ///< row
};

/**
 * A two-component nodal field stored as a structure of arrays for the row kernels:
 * every row starts on a cache line and is followed by at least one full vector of
 * zeros, so that a kernel may read and write past the last node without a mask.
 *
 * Rows are numbered locally; a field that belongs to a slab of the grid holds the
 * slab's node rows (ghost rows included).
 */
template <typename Number>
class NodalField
{
public:
  /** Doubles (floats) in 64 bytes: widest vector of the kernels. */
  static constexpr std::size_t vector_length = 64 / sizeof(Number);

  NodalField() = default;

  /** @p n_columns nodes a row, @p n_rows rows, two components, all zero. */
  NodalField(const unsigned int n_columns, const unsigned int n_rows);

  /** Copies all rows. */
  NodalField(const NodalField &other);

  /** Takes over the memory. */
  NodalField(NodalField &&) noexcept = default;

  /** Copies all rows; the size becomes that of @p other. */
  NodalField &operator=(const NodalField &other);

  /** Takes over the memory. */
  NodalField &operator=(NodalField &&) noexcept = default;

  /** Number of nodes in a row. */
  unsigned int n_columns() const
  {
    return columns;
  }

  /** Number of node rows. */
  unsigned int n_rows() const
  {
    return rows;
  }

  /** Distance between two rows of one component, in numbers. */
  std::size_t stride() const
  {
    return row_stride;
  }

  /** Component @p c (0: x, 1: y) of row @p j: n_columns() values and padding. */
  Number *row(const unsigned int c, const unsigned int j)
  {
    return data.get() + (c * rows + j) * row_stride;
  }

  /** As above, read only. */
  const Number *row(const unsigned int c, const unsigned int j) const
  {
    return data.get() + (c * rows + j) * row_stride;
  }

  /** Component @p c of one node. */
  Number &operator()(const unsigned int c, const NodeIndex &node)
  {
    return row(c, node.j)[node.i];
  }

  /** As above, read only. */
  const Number &operator()(const unsigned int c, const NodeIndex &node) const
  {
    return row(c, node.j)[node.i];
  }

  /** All values, padding included: for vector updates that treat every entry alike. */
  Number *begin()
  {
    return data.get();
  }

  /** As above, read only. */
  const Number *begin() const
  {
    return data.get();
  }

  /** Numbers from begin() on, padding included. */
  std::size_t size() const
  {
    return row_stride * rows * 2;
  }

  /** Padding included. */
  void set_zero();

  /**
   * Saves or restores extents and all values (Boost.Serialization). @throws
   * std::length_error when a field of other extents was saved
   */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    unsigned int saved_columns = columns, saved_rows = rows;
    archive &saved_columns &saved_rows;
    if (saved_columns != columns || saved_rows != rows)
      throw std::length_error("a field of other extents was saved");
    auto values = boost::serialization::make_array(begin(), size());
    archive &values;
  }

private:
  unsigned int columns   = 0;
  unsigned int rows      = 0;
  std::size_t row_stride = 0;
  LineArray<Number> data;
};

extern template class NodalField<double>;
extern template class NodalField<float>;
} // namespace mesoslip

#endif
