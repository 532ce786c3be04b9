#ifndef mesoslip_localization_cell_rows_h
#define mesoslip_localization_cell_rows_h

#include "grid/nodal_field.h"

#include <algorithm>
#include <cstddef>

/**
 * Put before a loop over one row of cells: the compiler vectorizes it for three
 * instruction sets, and the program selects the variant for the processor at start.
 */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#  define MESOSLIP_CLONES \
    __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#  define MESOSLIP_CLONES
#endif

/** Put before a loop that several MESOSLIP_CLONES functions share: it is inlined into
 * each of them. */
#define MESOSLIP_INTO_CLONES __attribute__((always_inline)) inline

namespace mesoslip
{
/** Numbers of the cells of a row: array c (one number per cell) begins at values + c
 * stride. */
struct CellRow
{
  const double *values; ///< first array of the row
  std::size_t stride;   ///< distance between arrays

  /** Number @p c of cell @p i. */
  double operator()(const unsigned int c, const std::size_t i) const
  {
    return values[c * stride + i];
  }
};

/**
 * Numbers of the cells of a rank, initially zero. Cells are grouped in rows: on a grid
 * along x, on a mesh of a fixed length. Layout [row][number][cell], so loops over cells
 * are contiguous.
 */
class CellRows
{
public:
  CellRows() = default;

  /** @p of_cells cells with @p n_numbers each, in rows of @p n_in_row; the last row may
   * be shorter. */
  CellRows(const std::size_t of_cells,
           const std::size_t n_in_row,
           const std::size_t n_numbers)
    : cells(of_cells)
    , length(std::max<std::size_t>(n_in_row, 1))
    , distance(padded(length))
    , numbers(n_numbers)
    , data(n_rows() * distance * numbers, 0.)
  {
  }

  /** Number of cells. */
  std::size_t n_cells() const
  {
    return cells;
  }

  /** Number of rows. */
  std::size_t n_rows() const
  {
    return (cells + length - 1) / length;
  }

  /** Cells per row; the last row may be shorter. */
  std::size_t n_in_row() const
  {
    return length;
  }

  /** Cells of row @p j. */
  std::size_t size(const std::size_t j) const
  {
    return std::min(length, cells - j * length);
  }

  /** Distance between two arrays of a row. */
  std::size_t stride() const
  {
    return distance;
  }

  /** Array of number @p c of the cells of row @p j. */
  double *array(const std::size_t c, const std::size_t j)
  {
    return data.data() + (j * numbers + c) * distance;
  }

  /** Array of number @p c of the cells of row @p j, read only. */
  const double *array(const std::size_t c, const std::size_t j) const
  {
    return data.data() + (j * numbers + c) * distance;
  }

  /** Number @p c of cell @p k. */
  double operator()(const std::size_t c, const std::size_t k) const
  {
    return array(c, k / length)[k % length];
  }

  /** Padded length of an array of @p n numbers: long arrays get an odd number of cache
   * lines, since distances of powers of two cause cache conflicts. */
  static std::size_t padded(const std::size_t n)
  {
    constexpr std::size_t line = lanes<double>;
    if (n < 8 * line)
      return n;
    const std::size_t lines = (n + line - 1) / line;
    return (lines + (lines % 2 == 0 ? 1 : 0)) * line;
  }

private:
  std::size_t cells    = 0; ///< number of cells
  std::size_t length   = 1; ///< cells per row; the last row may be shorter
  std::size_t distance = 1; ///< distance between arrays of a row
  std::size_t numbers  = 0; ///< numbers per cell
  LineVector<double> data;  ///< row after row
};
} // namespace mesoslip

#endif
