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
 * the line draft_line comes first.
 */
class TableWriter
{
public:
  /** @p columns are complete headings, such as "time [s]". */
  TableWriter(const std::string &path, const std::vector<std::string> &columns);

  /** A number as text for a row; empty for NaN.
   * @throws NumericalFailure for an infinite one. */
  std::string cell(const double value) const;

  /** Adds a row of numbers, one per column, formatted by cell(). */
  void add_row(const std::vector<double> &values);

  /** Adds a row of texts, one per column; quoted where needed. */
  void add_row(const std::vector<std::string> &values);

  /** Writes buffers and checks for success.
   * @throws UserError. */
  void flush();

private:
  void write_line(const std::vector<std::string> &values);

  std::string path;
  std::size_t n_columns = 0;
  std::size_t rows      = 0; ///< rows added so far
  std::ofstream out;
};

/** A CSV file in memory. */
class CsvTable
{
public:
  /**
   * Reads a file with a heading line, separated by commas or semicolons. Empty lines and
   * lines beginning with # are skipped.
   * @throws UserError naming file, line and column; also for a draft, unless drafts are
   * accepted (io/drafts.h).
   */
  static CsvTable read(const std::string &path);

  /** Headings, in the order of the file. */
  const std::vector<std::string> &columns() const
  {
    return headings;
  }

  /** Path of the file. */
  const std::string &file() const
  {
    return path;
  }

  /** Number of rows without the heading. */
  std::size_t n_rows() const
  {
    return cells.size();
  }

  /** Whether there is a column with this heading.
   * @throws UserError if a column has the same name with another unit or other
   * capitals */
  bool has_column(const std::string &heading) const;

  /** A column as numbers.
   * @throws UserError for a missing column or values that are not finite. */
  std::vector<double> numbers(const std::string &heading) const;

  /** Throws the UserError "rectangles.csv:12: <what>", for checks on the meaning of the
   * numbers. */
  [[noreturn]] void fail(const std::size_t row, const std::string &what) const;

private:
  std::size_t column(const std::string &heading) const;

  std::string path;
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> cells;
  std::vector<unsigned int> lines;
  char separator = ','; ///< or a semicolon, which allows decimal commas
};
} // namespace mesoslip

#endif
