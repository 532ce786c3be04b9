#ifndef mesoslip_localization_cell_rows_h
#define mesoslip_localization_cell_rows_h

#include "grid/nodal_field.h"

#include <algorithm>
#include <cstddef>

/**
 * Before a loop over one row of cells: the compiler vectorizes it for three instruction sets,
 * of which that of the processor is picked when the program starts.
 */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#  define MESOSLIP_CLONES \
    __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#  define MESOSLIP_CLONES
#endif

/** Before a loop that several of these functions share: it is compiled into each of them. */
#define MESOSLIP_INTO_CLONES __attribute__((always_inline)) inline

namespace mesoslip
{
/** Some numbers of each cell of a row: array c, of as many numbers as the row has cells, begins at
 * values + c stride. */
struct CellRow
{
  const double *values; ///< of the first number of all cells
  std::size_t stride;   ///< from one array to the next

  /** Number @p c of cell @p i. */
  double operator()(const unsigned int c, const std::size_t i) const
  {
    return values[c * stride + i];
  }
};

/**
 * Some numbers of each cell of a rank, all zero at first. The cells are in rows, those of a grid
 * along x, those of a mesh of a fixed length; of a row the first numbers of all cells stand side by
 * side, then the second ones, and so on, as loops over the cells want them.
 */
class CellRows
{
public:
  CellRows() = default;

  /** @p of_cells cells with @p n_numbers each in rows of @p n_in_row, of which the last may be
   * shorter. */
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

  /** Cells of a row, except perhaps the last one. */
  std::size_t n_in_row() const
  {
    return length;
  }

  /** Cells of row @p j. */
  std::size_t size(const std::size_t j) const
  {
    return std::min(length, cells - j * length);
  }

  /** Numbers from one array of a row to the next. */
  std::size_t stride() const
  {
    return distance;
  }

  /** Number @p c of the cells of row @p j. */
  double *array(const std::size_t c, const std::size_t j)
  {
    return data.data() + (j * numbers + c) * distance;
  }

  /** Number @p c of the cells of row @p j, read only. */
  const double *array(const std::size_t c, const std::size_t j) const
  {
    return data.data() + (j * numbers + c) * distance;
  }

  /** Number @p c of cell @p k. */
  double operator()(const std::size_t c, const std::size_t k) const
  {
    return array(c, k / length)[k % length];
  }

  /** Numbers that arrays of @p n take: of long ones an odd number of cache lines, as arrays at
   * distances of powers of two displace each other from the cache. */
  static std::size_t padded(const std::size_t n)
  {
    constexpr std::size_t line = lanes<double>;
    if (n < 8 * line)
      return n;
    const std::size_t lines = (n + line - 1) / line;
    return (lines + (lines % 2 == 0 ? 1 : 0)) * line;
  }

private:
  std::size_t cells    = 0; ///< their number
  std::size_t length   = 1; ///< cells of a row, except perhaps the last one
  std::size_t distance = 1; ///< from one array of a row to the next
  std::size_t numbers  = 0; ///< how many a cell has
  LineVector<double> data;  ///< row after row
};
} // namespace mesoslip

#endif
