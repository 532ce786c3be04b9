#ifndef mesoslip_io_grid_table_h
#define mesoslip_io_grid_table_h

#include "io/table.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** A function of two variables on a grid, from three columns of a CSV table. */
struct GridTable
{
  std::vector<double> first;  ///< distinct values of the first column, ascending
  std::vector<double> second; ///< distinct, ascending; a single 0 without the column
  std::vector<double> values; ///< [first][second]
};

/**
 * The column @p value of @p table over its columns @p first and, if it exists,
 * @p second; rows may have any order. Headings are as "slip rate [m/s]".
 * @throws UserError for a table without rows, and for a repeated or missing pair
 */
GridTable grid_table(const CsvTable &table,
                     const std::string &first,
                     const std::string &second,
                     const std::string &value);
} // namespace mesoslip

#endif
