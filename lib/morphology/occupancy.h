#ifndef mesoslip_morphology_occupancy_h
#define mesoslip_morphology_occupancy_h

#include "morphology/rectangles.h"

#include <cstdint>
#include <vector>

namespace mesoslip
{
/**
 * One bit a cell: whether a fibre has it. Bits of a column lie side by side, because
 * fibres are tall: most questions about one are answered by a word or two a column.
 */
class Occupancy
{
public:
  /** All cells free. */
  Occupancy(const unsigned int n_columns, const unsigned int n_rows);

  /** Whether no cell of the box is taken. The box lies inside the grid. */
  bool is_free(const CellBox &box) const;

  /** Number of free cells of the box. */
  std::size_t n_free(const CellBox &box) const;

  /** Takes all cells of @p box, which lies inside the grid. */
  void mark(const CellBox &box);

  /** Number of cells taken. */
  std::size_t n_taken() const
  {
    return taken;
  }

  /** The box with @p x_gap and @p y_gap cells around it, as far as inside the grid. */
  CellBox
  widened(const CellBox &box, const unsigned int x_gap, const unsigned int y_gap) const;

private:
  template <typename Function>
  void for_each_word(const CellBox &box, const Function &function) const;

  unsigned int columns;
  unsigned int rows;
  std::size_t words_per_column;
  std::vector<std::uint64_t> words;
  std::size_t taken = 0;
};
} // namespace mesoslip

#endif
