#ifndef mesoslip_grid_nodal_field_h
#define mesoslip_grid_nodal_field_h

#include "base/serialize_members.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace mesoslip
{
namespace internal
{
/**
 * Returns at least @p bytes of memory aligned to a cache line. All pages of a large piece
 * are mapped at once; mapping at the first write takes twice as long. @throws
 * std::bad_alloc
 */
void *line_memory(const std::size_t bytes);
} // namespace internal

/** Allocator of memory aligned to cache lines. */
template <typename Number>
struct LineAllocator
{
  using value_type = Number; ///< value type of the container

  LineAllocator() = default;

  /** Conversion from the allocator of another type; there is no state. */
  template <typename Other>
  LineAllocator(const LineAllocator<Other> &)
  {
  }

  /** Allocates @p n numbers. @throws std::bad_alloc */
  Number *allocate(const std::size_t n)
  {
    return static_cast<Number *>(internal::line_memory(n * sizeof(Number)));
  }

  /** Frees memory from allocate(). */
  void deallocate(Number *memory, const std::size_t)
  {
    std::free(memory);
  }

  /** True: all allocators are equal. */
  friend bool operator==(const LineAllocator &, const LineAllocator &)
  {
    return true;
  }

  /** False: all allocators are equal. */
  friend bool operator!=(const LineAllocator &, const LineAllocator &)
  {
    return false;
  }
};

/** Vector aligned to a cache line. */
template <typename Number>
using LineVector = std::vector<Number, LineAllocator<Number>>;

/** Number of values in the widest vector of the row kernels. */
template <typename Number>
constexpr unsigned int lanes = 64 / sizeof(Number);

/** @p n rounded up to a multiple of the vector length. */
template <typename Number>
constexpr unsigned int whole_vectors(const unsigned int n)
{
  return (n + lanes<Number> - 1) / lanes<Number> * lanes<Number>;
}

/** Position of a node in a field. */
struct NodeIndex
{
  unsigned int i = 0; ///< column
  unsigned int j = 0; ///< row
};

/**
 * Values at rows of nodes (or cells) with several components, two for displacements, in
 * the layout of the row kernels. The components of a row are separate arrays. Each array
 * starts on a cache line and ends with at least one full vector of zeros, so that kernels
 * may read and write past the last node without a mask.
 *
 * There is one ghost row at either end (none for fields of points without rows) and one
 * ghost column on the left. A multigrid cycle stores the neighbours across a periodic
 * side there and behind the last column; otherwise they are zero.
 *
 * Rows are numbered locally; a field of a slab of the grid has the node rows of the slab,
 * ghost rows included.
 */
template <typename Number>
class NodalField
{
public:
  NodalField() = default;

  /** Zero field with @p n_columns nodes per row and @p n_rows rows. */
  NodalField(const unsigned int n_columns,
             const unsigned int n_rows,
             const unsigned int n_components = 2)
    : NodalField(n_columns, n_rows, n_components, 1)
  {
  }

  /** Zero field with @p n_points points of a mesh in one row, without ghost rows. */
  static NodalField of_points(const std::size_t n_points, const unsigned int n_components)
  {
    return {static_cast<unsigned int>(n_points), 1, n_components, 0};
  }

  /** A zero field of the same size. */
  NodalField zeros_alike() const
  {
    return {columns, rows, components, ghost_rows};
  }

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

  /** Number of components per node. */
  unsigned int n_components() const
  {
    return components;
  }

  /** Distance between two rows of one component, in numbers. */
  std::size_t stride() const
  {
    return components * component_stride();
  }

  /** Distance between two components of a row, in numbers. */
  std::size_t component_stride() const
  {
    return array_stride;
  }

  /** Component @p c (0: x, 1: y) of row @p j (-1 to n_rows()): n_columns() values and
   *  padding. */
  template <typename Index>
  Number *row(const unsigned int c, const Index j)
  {
    return data.data() + offset(c, static_cast<int>(j));
  }

  /** As above, read only. */
  template <typename Index>
  const Number *row(const unsigned int c, const Index j) const
  {
    return data.data() + offset(c, static_cast<int>(j));
  }

  /** Component @p c of one node. */
  Number &operator()(const unsigned int c, const NodeIndex &node)
  {
    assert(node.i < columns);
    return row(c, node.j)[node.i];
  }

  /** As above, read only. */
  const Number &operator()(const unsigned int c, const NodeIndex &node) const
  {
    assert(node.i < columns);
    return row(c, node.j)[node.i];
  }

  /**
   * First value; all values are contiguous, padding included, for vector updates of all
   * entries.
   */
  Number *begin()
  {
    return data.data();
  }

  /** As above, read only. */
  const Number *begin() const
  {
    return data.data();
  }

  /** Number of values from begin() on, padding included. */
  std::size_t size() const
  {
    return data.size();
  }

  /** Sets all values to zero, padding included. */
  void set_zero()
  {
    std::fill(data.begin(), data.end(), Number(0));
  }

  /**
   * Copies the values of a field of the same size, ghosts included; padding beyond the
   * ghosts becomes zero.
   */
  template <typename Other>
  void convert_from(const NodalField<Other> &other);

  /**
   * Fills ghost columns -1 and n_columns() if @p x, and ghost rows -1 and n_rows() if
   * @p y. The field must have them.
   */
  void fill_ghosts(const bool x, const bool y);

  /**
   * Saves or restores size and all values (Boost.Serialization). @throws
   * std::length_error if the saved field has another size
   */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    unsigned int saved_columns = columns, saved_rows = rows;
    archive &saved_columns &saved_rows;
    if (saved_columns != columns || saved_rows != rows)
      throw std::length_error("a field of other extents was saved");
    serialize_array(archive, begin(), size());
  }

private:
  NodalField(const unsigned int n_columns,
             const unsigned int n_rows,
             const unsigned int n_components,
             const unsigned int ghost_rows);

  std::size_t offset(const unsigned int c, const int j) const
  {
    const unsigned int place = static_cast<unsigned int>(j) + ghost_rows;
    assert(c < components);
    assert(place < rows + 2 * ghost_rows);
    return (static_cast<std::size_t>(place) * components + c) * array_stride +
           lanes<Number>;
  }

  unsigned int components  = 0;
  unsigned int rows        = 0;
  unsigned int columns     = 0;
  unsigned int ghost_rows  = 1; ///< ghost rows at either end
  std::size_t array_stride = 0;
  LineVector<Number> data;
};

extern template class NodalField<double>;
extern template class NodalField<float>;
} // namespace mesoslip

#endif
