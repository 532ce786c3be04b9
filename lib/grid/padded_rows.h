#ifndef mesoslip_grid_padded_rows_h
#define mesoslip_grid_padded_rows_h

#include "grid/line_memory.h"

#include <cstddef>

namespace mesoslip
{
/** Numbers in the widest vector of the row kernels. */
template <typename Number>
constexpr unsigned int lanes = 64 / sizeof(Number);

/** @p n rounded up to whole vectors. */
template <typename Number>
constexpr unsigned int whole_vectors(const unsigned int n)
{
  return (n + lanes<Number> - 1) / lanes<Number> * lanes<Number>;
}

/**
 * Rows -1, ..., n_rows of several arrays of numbers, zero at first. Column 0 of every row
 * starts a cache line; columns -1 and up to one vector past the last whole one may be
 * read and written, too: they take the values of neighbours across a periodic side and
 * are zero otherwise.
 */
template <typename Number>
class PaddedRows
{
public:
  PaddedRows() = default;

  /** All numbers zero, ghosts and padding included. */
  PaddedRows(const unsigned int n_arrays,
             const unsigned int n_rows,
             const unsigned int n_columns);

  /** Without the ghost rows. */
  unsigned int n_rows() const
  {
    return rows;
  }

  /** Without ghosts and padding. */
  unsigned int n_columns() const
  {
    return columns;
  }

  /** Distance between the same row of two arrays, in numbers. */
  std::size_t array_stride() const
  {
    return stride;
  }

  /** Row @p j (-1 to n_rows()) of array @p k. The arrays of a row lie side by side. */
  template <typename Index>
  Number *row(const unsigned int k, const Index j)
  {
    return data.get() + offset(k, static_cast<int>(j));
  }

  /** As above, read only. */
  template <typename Index>
  const Number *row(const unsigned int k, const Index j) const
  {
    return data.get() + offset(k, static_cast<int>(j));
  }

  /** Ghosts and padding included. */
  void set_zero();

  /** Takes the numbers of an object of the same extents, ghosts included; what lies
   *  further out becomes zero. */
  template <typename Other>
  void convert_from(const PaddedRows<Other> &other);

  /** Fills column -1 and n_columns() (if @p x) and rows -1 and n_rows() (if @p y). */
  void fill_ghosts(const bool x, const bool y);

private:
  std::size_t size() const
  {
    return (static_cast<std::size_t>(rows) + 2) * arrays * stride;
  }

  std::size_t offset(const unsigned int k, const int j) const
  {
    return (static_cast<std::size_t>(j + 1) * arrays + k) * stride + lanes<Number>;
  }

  unsigned int arrays  = 0;
  unsigned int rows    = 0;
  unsigned int columns = 0;
  std::size_t stride   = 0;
  LineArray<Number> data;
};

extern template class PaddedRows<float>;
extern template class PaddedRows<double>;
} // namespace mesoslip

#endif
