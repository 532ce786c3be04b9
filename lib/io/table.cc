#include "io/table.h"

#include "base/errors.h"
#include "base/files.h"
#include "base/text.h"
#include "io/drafts.h"
#include "parameters/parameters.h"

#include <deal.II/base/exceptions.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
std::string quoted_if_needed(const std::string &text)
{
  if (text.find_first_of(",\"\n\r") == std::string::npos)
    return text;
  return '"' + boost::algorithm::replace_all_copy(text, "\"", "\"\"") + '"';
}

/** The cells of a line; quoted cells may contain the separator, "" is a quote. */
std::vector<std::string>
split_line(const std::string &line, const char separator, const std::string &where)
{
  std::vector<std::string> cells(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (inside && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"')
      {
        cells.back() += '"';
        ++i;
      }
    else if (line[i] == '"')
      inside = !inside;
    else if (line[i] == separator && !inside)
      cells.emplace_back();
    else
      cells.back() += line[i];
  if (inside)
    throw UserError(where + "a quotation mark is not closed");
  for (std::string &cell : cells)
    cell = trimmed(cell);
  return cells;
}
} // namespace

TableWriter::TableWriter(const std::string &file_path,
                         const std::vector<std::string> &columns)
  : path(file_path)
  , n_columns(columns.size())
  , out(file_path, std::ios::binary | std::ios::trunc)
{
  if (!out)
    throw UserError(path + ": cannot be created (" + system_message() + ")");
  if (DraftMark::is_set())
    out << draft_line << '\n';
  write_line(columns);
}

void TableWriter::write_line(const std::vector<std::string> &values)
{
  AssertDimension(values.size(), n_columns);
  for (std::size_t i = 0; i < values.size(); ++i)
    out << (i > 0 ? "," : "") << quoted_if_needed(values[i]);
  out << '\n';
}

void TableWriter::add_row(const std::vector<std::string> &values)
{
  ++rows;
  write_line(values);
}

void TableWriter::add_row(const std::vector<double> &values)
{
  std::vector<std::string> cells;
  for (const double value : values)
    cells.push_back(cell(value));
  add_row(cells);
}

std::string TableWriter::cell(const double value) const
{
  if (std::isinf(value))
    throw NumericalFailure(
      path + ": row " + std::to_string(rows + 1) +
      " would hold an infinite number; look for an input that is far "
      "too large, and at its unit");
  return std::isnan(value) ? "" : to_text(value);
}

void TableWriter::flush()
{
  errno = 0;
  if (!out.flush())
    throw UserError(path + ": cannot be written (" + system_message() + ")");
}

CsvTable CsvTable::read(const std::string &path)
{
  CsvTable table;
  table.path             = path;
  const std::string text = plain_lines(read_file(path));
  if (text.find('\0') != std::string::npos)
    throw UserError(path + " is not a text file, but a CSV table is needed");
  if (text.rfind(draft_line, 0) == 0 && !drafts_are_accepted())
    throw UserError(path +
                    " is a draft, made with --try from what may be drafts, in which "
                    "nothing was computed; do the run that makes the result");

  std::istringstream in(text);
  std::string line;
  for (unsigned int number = 1; std::getline(in, line); ++number)
    {
      line = trimmed(line);
      if (line.empty() || line.front() == '#')
        continue;
      const std::string where = path + ":" + std::to_string(number) + ": ";
      // Languages with a decimal comma use semicolons as separators.
      if (table.headings.empty())
        table.separator =
          line.find(',') == std::string::npos && line.find(';') != std::string::npos
            ? ';'
            : ',';
      auto cells = split_line(line, table.separator, where);
      if (table.headings.empty())
        table.headings = std::move(cells);
      else if (cells.size() != table.headings.size())
        throw UserError(where + std::to_string(cells.size()) +
                        " values, but the heading has " +
                        std::to_string(table.headings.size()) + " columns");
      else
        {
          table.cells.push_back(std::move(cells));
          table.lines.push_back(number);
        }
    }
  if (table.headings.empty())
    throw UserError(path + " is empty, but a table with a heading line is needed");
  return table;
}

bool CsvTable::has_column(const std::string &heading) const
{
  if (std::find(headings.begin(), headings.end(), heading) != headings.end())
    return true;
  const auto name = [](const std::string &text) {
    return boost::algorithm::to_lower_copy(trimmed(text.substr(0, text.find('['))));
  };
  for (const std::string &other : headings)
    if (name(other) == name(heading))
      throw UserError(path + ": the column '" + other + "' has to be called '" + heading +
                      "', with its numbers in that unit; convert them, or rename it");
  return false;
}

std::size_t CsvTable::column(const std::string &heading) const
{
  const auto found = std::find(headings.begin(), headings.end(), heading);
  if (found == headings.end())
    throw UserError(path + ": there is no column '" + heading +
                    "'; the heading line has " + to_text(headings) +
                    (headings.front().find('\t') == std::string::npos
                       ? ""
                       : "; columns are separated by commas or semicolons, not tabs"));
  if (std::find(found + 1, headings.end(), heading) != headings.end())
    throw UserError(path + ": two columns are called '" + heading +
                    "'; rename or remove one of them");
  return static_cast<std::size_t>(found - headings.begin());
}

std::vector<double> CsvTable::numbers(const std::string &heading) const
{
  const std::size_t index = column(heading);
  std::vector<double> values(cells.size());
  for (std::size_t row = 0; row < cells.size(); ++row)
    {
      std::string text = cells[row][index];
      if (separator == ';')
        std::replace(text.begin(), text.end(), ',', '.');
      if (!parse_number(text, values[row]))
        fail(row, "column '" + heading + "' holds '" + cells[row][index] +
                    "', which is not a finite number");
      if (!has_usable_size(values[row]))
        fail(row, "column '" + heading + "' holds '" + cells[row][index] + "'; " +
                    usable_sizes);
    }
  return values;
}

void CsvTable::fail(const std::size_t row, const std::string &what) const
{
  throw UserError(path + ":" + std::to_string(lines.at(row)) + ": " + what);
}
} // namespace mesoslip
