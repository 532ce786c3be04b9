#ifndef mesoslip_io_grid_table_h
#define mesoslip_io_grid_table_h

#include "io/table.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** What a CSV table says for each pair of values of two of its columns. */
struct GridTable
{
  std::vector<double> first;  ///< all its values, in ascending order
  std::vector<double> second; ///< likewise; a single 0 where there is no such column
  std::vector<double> values; ///< [first][second]
};

/**
 * The column @p value of @p table over its columns @p first and, where there is one, @p second, whose rows may come
 * in any order. Headings are as "slip rate [m/s]". @throws UserError without rows, for a pair that is there twice
 * and for one that is not
 */
GridTable grid_table(const CsvTable &table,
                     const std::string &first,
                     const std::string &second,
                     const std::string &value);
} // namespace mesoslip

#endif
