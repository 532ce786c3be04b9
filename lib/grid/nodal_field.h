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
 * At least @p bytes of memory that begin on a cache line. All pages of a large piece are
 * asked for at once: one by one, when first written, they take twice as long.
 * @throws std::bad_alloc
 */
void *line_memory(const std::size_t bytes);
} // namespace internal

/** Allocates numbers that begin on a cache line. */
template <typename Number>
struct LineAllocator
{
  using value_type = Number; ///< for the container

  LineAllocator() = default;

  /** Allocators of other numbers are the same. */
  template <typename Other>
  LineAllocator(const LineAllocator<Other> &)
  {
  }

  /** @p n numbers. @throws std::bad_alloc */
  Number *allocate(const std::size_t n)
  {
    return static_cast<Number *>(internal::line_memory(n * sizeof(Number)));
  }

  /** What allocate() gave. */
  void deallocate(Number *memory, const std::size_t)
  {
    std::free(memory);
  }

  /** All are equal. */
  friend bool operator==(const LineAllocator &, const LineAllocator &)
  {
    return true;
  }

  /** Never. */
  friend bool operator!=(const LineAllocator &, const LineAllocator &)
  {
    return false;
  }
};

/** Numbers that begin on a cache line. */
template <typename Number>
using LineVector = std::vector<Number, LineAllocator<Number>>;

/** Numbers in the widest vector of the row kernels. */
template <typename Number>
constexpr unsigned int lanes = 64 / sizeof(Number);

/** @p n rounded up to whole vectors. */
template <typename Number>
constexpr unsigned int whole_vectors(const unsigned int n)
{
  return (n + lanes<Number> - 1) / lanes<Number> * lanes<Number>;
}

/** The place of a node in a field. */
struct NodeIndex
{
  unsigned int i = 0; ///< column
  unsigned int j = 0; ///< row
};

/**
 * Numbers on rows of nodes (or cells) with some components, two for displacements, as the
 * row kernels want them: the components of a row are arrays side by side, each of which
 * starts on a cache line and is followed by at least one full vector of zeros, so that a
 * kernel may read and write past the last node without a mask.
 *
 * There is one more row at either end, but not of points without rows, and one more column
 * on the left: there and behind the last column a multigrid cycle has the values of neighbours
 * across a periodic side, all others zeros.
 *
 * Rows are numbered locally; a field that belongs to a slab of the grid holds the
 * slab's node rows (ghost rows included).
 */
template <typename Number>
class NodalField
{
public:
  NodalField() = default;

  /** @p n_columns nodes a row, @p n_rows rows, all zero. */
  NodalField(const unsigned int n_columns,
             const unsigned int n_rows,
             const unsigned int n_components = 2)
    : NodalField(n_columns, n_rows, n_components, 1)
  {
  }

  /** One row of @p n_points points of a mesh, with none beside it, all zero. */
  static NodalField of_points(const std::size_t n_points, const unsigned int n_components)
  {
    return {static_cast<unsigned int>(n_points), 1, n_components, 0};
  }

  /** A field of the same extents, all zero. */
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

  /** Numbers a node. */
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

  /** All values, padding included: for vector updates that treat every entry alike. */
  Number *begin()
  {
    return data.data();
  }

  /** As above, read only. */
  const Number *begin() const
  {
    return data.data();
  }

  /** Numbers from begin() on, padding included. */
  std::size_t size() const
  {
    return data.size();
  }

  /** Padding included. */
  void set_zero()
  {
    std::fill(data.begin(), data.end(), Number(0));
  }

  /** Takes the numbers of a field of the same extents, ghosts included; what lies further
   *  out becomes zero. */
  template <typename Other>
  void convert_from(const NodalField<Other> &other);

  /** Fills columns -1 and n_columns() (if @p x) and rows -1 and n_rows() (if @p y), which have to be
   * there. */
  void fill_ghosts(const bool x, const bool y);

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
  unsigned int ghost_rows  = 1; ///< at either end
  std::size_t array_stride = 0;
  LineVector<Number> data;
};

extern template class NodalField<double>;
extern template class NodalField<float>;
} // namespace mesoslip

#endif
