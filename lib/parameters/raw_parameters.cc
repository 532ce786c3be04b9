#include "parameters/raw_parameters.h"

#include "base/errors.h"
#include "base/text.h"
#include "parameters/parameters.h"

#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

namespace mesoslip
{
namespace
{
/** Up to the first #; one behind a backslash belongs to the text, without the backslash.
 */
std::string without_comment(const std::string &line)
{
  std::string text;
  for (const char c : line)
    if (c != '#')
      text += c;
    else if (!text.empty() && text.back() == '\\')
      text.back() = '#';
    else
      break;
  return text;
}

/** A line without comment, with single blanks between words. */
std::string cleaned(const std::string &line)
{
  return boost::algorithm::trim_fill_copy(without_comment(line), " ",
                                          std::locale::classic());
}

/** Reads the lines of a .prm one by one and collects what they set. */
class Parser
{
public:
  Parser(const std::string &file, const std::string &text)
    : file_name(file)
    , lines(text)
  {
  }

  std::vector<RawParameters::Entry> entries, sections;

  void run()
  {
    std::string raw;
    while (next_line(raw))
      {
        const std::string line = cleaned(raw);
        if (line.empty())
          continue;
        if (!is_utf8(line))
          fail("the line is not UTF-8; save the file in that encoding");
        const std::string word = line.substr(0, line.find(' '));
        const std::string rest =
          line.size() > word.size() ? line.substr(word.size() + 1) : "";
        if (word == "subsection" || word == "SUBSECTION")
          enter(rest);
        else if (word == "end" || word == "END")
          leave(rest);
        else if (word == "set" || word == "SET")
          set(without_comment(raw));
        else if (word == "include" || word == "INCLUDE")
          fail("'include' is not supported; a parameter file is complete in itself");
        else
          fail(
            "'" + line.substr(0, 60) +
            "' is not understood; lines are 'set Key = value', 'subsection Name', 'end' "
            "or '# comment'");
      }
    if (!open.empty())
      throw UserError(file_name + ":" + std::to_string(open.back().second) +
                      ": the subsection '" + open.back().first + "' has no 'end'");
  }

private:
  [[noreturn]] void fail(const std::string &what) const
  {
    throw UserError(file_name + ":" + std::to_string(first_line) + ": " + what);
  }

  /** One logical line: a backslash at the end continues it. */
  bool next_line(std::string &line)
  {
    line.clear();
    first_line = last_line + 1;
    std::string piece;
    bool any = false;
    while (std::getline(lines, piece))
      {
        any = true;
        ++last_line;
        while (!piece.empty() && piece.back() == ' ')
          piece.pop_back();
        if (piece.empty() || piece.back() != '\\')
          {
            line += piece;
            return true;
          }
        line += piece.substr(0, piece.size() - 1);
      }
    return any;
  }

  std::string prefix() const
  {
    std::string path;
    for (const auto &section : open)
      path += section.first + "/";
    return path;
  }

  void check_name(const std::string &name, const char *kind) const
  {
    if (name.empty())
      fail(std::string("a ") + kind + " has no name");
    if (name.find('/') != std::string::npos)
      fail(std::string("the ") + kind + " '" + name +
           "' contains '/', which names cannot");
  }

  void enter(const std::string &name)
  {
    check_name(name, "subsection");
    const std::string path = prefix() + name;
    if (known_sections.insert(path).second)
      sections.push_back({path, "", first_line});
    open.emplace_back(name, first_line);
  }

  void leave(const std::string &rest)
  {
    if (!rest.empty())
      fail("nothing may follow 'end', found '" + rest + "'");
    if (open.empty())
      fail("'end' without an open subsection");
    open.pop_back();
  }

  void set(const std::string &raw)
  {
    const auto equals = raw.find('=');
    if (equals == std::string::npos)
      fail("'" + cleaned(raw) + "' has no '='; write 'set Key = value'");
    const std::string left = cleaned(raw.substr(0, equals));
    const std::string key  = left.size() > 4 ? left.substr(4) : "";
    check_name(key, "key");
    const std::string path     = prefix() + key;
    const auto [first, is_new] = lines_of_keys.emplace(path, first_line);
    if (!is_new)
      fail(path + " is set again; line " + std::to_string(first->second) +
           " has set it already");
    entries.push_back({path, trimmed(raw.substr(equals + 1)), first_line});
  }

  std::string file_name;
  std::istringstream lines;
  unsigned int first_line = 0;
  unsigned int last_line  = 0;
  std::vector<std::pair<std::string, unsigned int>> open;
  std::map<std::string, unsigned int> lines_of_keys;
  std::set<std::string> known_sections;
};
} // namespace

RawParameters RawParameters::parse(const std::string &text, const std::string &file)
{
  if (text.find('\0') != std::string::npos)
    throw UserError(file + " is not a text file, but a parameter file (.prm) is needed");
  Parser parser(file, plain_lines(text));
  parser.run();

  RawParameters raw;
  raw.file_name   = file;
  raw.all_entries = parser.entries;
  raw.sections    = parser.sections;
  return raw;
}

void RawParameters::override_with(const std::string &assignment)
{
  const auto equals      = assignment.find('=');
  const std::string path = trimmed(assignment.substr(0, equals));
  if (equals == std::string::npos || path.empty())
    throw UserError("--set '" + assignment + "': write --set 'Section/Key=value'");
  const Entry entry = {path, trimmed(assignment.substr(equals + 1)), 0};
  const auto old    = std::find_if(all_entries.begin(), all_entries.end(),
                                   [&](const Entry &e) { return e.path == path; });
  if (old != all_entries.end())
    *old = entry;
  else
    all_entries.push_back(entry);
}

const RawParameters::Entry *RawParameters::find(const std::string &path) const
{
  for (const Entry &entry : all_entries)
    if (entry.path == path)
      return &entry;
  return nullptr;
}

std::string RawParameters::origin(const Entry &entry) const
{
  return entry.line == 0 ? "--set '" + entry.path + "=" + entry.value + "'"
                         : file_name + ":" + std::to_string(entry.line);
}

std::string RawParameters::folder() const
{
  const std::string parent = std::filesystem::path(file_name).parent_path().string();
  return parent.empty() ? "." : parent;
}

bool Range::contains(const double x) const
{
  return (lower_exclusive ? x > lower : x >= lower) &&
         (upper_exclusive ? x < upper : x <= upper);
}

std::string Range::text() const
{
  const bool below = lower != -std::numeric_limits<double>::max();
  const bool above = upper != std::numeric_limits<double>::max();
  if (below && above)
    return std::string("in ") + (lower_exclusive ? "(" : "[") + to_text(lower) + ", " +
           to_text(upper) + (upper_exclusive ? ")" : "]");
  if (below)
    return (lower_exclusive ? "> " : ">= ") + to_text(lower);
  return above ? (upper_exclusive ? "< " : "<= ") + to_text(upper) : "";
}
} // namespace mesoslip
