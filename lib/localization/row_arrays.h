#ifndef mesoslip_localization_row_arrays_h
#define mesoslip_localization_row_arrays_h

#include "grid/line_memory.h"

#include <cstddef>

namespace mesoslip
{
/**
 * Several numbers for each cell as a structure of arrays, row after row: the arrays of
 * one row of cells lie one behind the other, so that a row kernel and its caches see
 * one row at a time. Every array begins on a cache line. All zero at first.
 */
class RowArrays
{
public:
  RowArrays() = default;

  /** All numbers zero. */
  RowArrays(const std::size_t n_rows,
            const unsigned int n_arrays,
            const std::size_t n_columns)
    : arrays(n_arrays)
    , columns(n_columns)
    , row_stride((n_columns + line - 1) / line * line)
    , n(n_rows)
  {
    // An odd number of cache lines keeps the arrays of a row off the same cache set.
    if (row_stride / line % 2 == 0)
      row_stride += line;
    data = line_zeros<double>(n * arrays * row_stride);
  }

  /** Array @p k of row @p j: n_columns() values. */
  double *operator()(const std::size_t j, const unsigned int k)
  {
    return data.get() + (j * arrays + k) * row_stride;
  }

  /** As above, read only. */
  const double *operator()(const std::size_t j, const unsigned int k) const
  {
    return data.get() + (j * arrays + k) * row_stride;
  }

  /** Rows, each of all arrays. */
  std::size_t n_rows() const
  {
    return n;
  }

  /** Numbers of an array in a row, without padding. */
  std::size_t n_columns() const
  {
    return columns;
  }

  /** Distance between the arrays of a row, in numbers. */
  std::size_t stride() const
  {
    return row_stride;
  }

private:
  /** Doubles in a cache line. */
  static constexpr std::size_t line = 8;

  unsigned int arrays    = 0;
  std::size_t columns    = 0;
  std::size_t row_stride = 0;
  std::size_t n          = 0;
  LineArray<double> data;
};
} // namespace mesoslip

#endif
