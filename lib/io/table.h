#ifndef mesoslip_io_table_h
#define mesoslip_io_table_h

#include <fstream>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * A CSV file written row by row. The first line names the columns with their units,
 * "time [s]"; numbers have the fewest digits that read back unchanged. Under a DraftMark
 * the line draft_line stands before it.
 */
class TableWriter
{
public:
  /** @p columns are complete headings, such as "time [s]". */
  TableWriter(const std::string &path, const std::vector<std::string> &columns);

  /** A number for a row of texts; empty for NaN. @throws NumericalFailure for an infinite
   * one. */
  std::string cell(const double value) const;

  /** One number for each column, as cell() writes them. */
  void add_row(const std::vector<double> &values);

  /** One text for each column; quoted where needed. */
  void add_row(const std::vector<std::string> &values);

  /** Writes what is buffered and checks that it was written. @throws UserError. */
  void flush();

private:
  void write_line(const std::vector<std::string> &values);

  std::string path;
  std::size_t n_columns = 0;
  std::size_t rows      = 0; ///< added so far
  std::ofstream out;
};

/** A CSV file in memory. */
class CsvTable
{
public:
  /**
   * Reads a file with a heading line, separated by commas or semicolons. Empty lines and lines beginning with # are
   * skipped. @throws UserError naming file, line and column; also for a draft, unless
   * drafts are accepted (io/drafts.h).
   */
  static CsvTable read(const std::string &path);

  /** Headings, in the order of the file. */
  const std::vector<std::string> &columns() const
  {
    return headings;
  }

  /** Its path. */
  const std::string &file() const
  {
    return path;
  }

  /** Number of rows without the heading. */
  std::size_t n_rows() const
  {
    return cells.size();
  }

  /** Whether there is one with this heading. @throws UserError if there is one of the same name, but
   * in another unit, or in other letters. */
  bool has_column(const std::string &heading) const;

  /** A column as numbers. @throws UserError for a missing column or anything not finite.
   */
  std::vector<double> numbers(const std::string &heading) const;

  /** "rectangles.csv:12: <what>" as a UserError, for checks of what the numbers mean. */
  [[noreturn]] void fail(const std::size_t row, const std::string &what) const;

private:
  std::size_t column(const std::string &heading) const;

  std::string path;
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> cells;
  std::vector<unsigned int> lines;
  char separator = ','; ///< or a semicolon, with which numbers may have decimal commas
};
} // namespace mesoslip

#endif
